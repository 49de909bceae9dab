#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "holdfast/chaos/lyapunov_run.hpp"
#include "holdfast/chaos/lyapunov_spectrum.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/gram_schmidt.hpp"
#include "holdfast/math/stats/batch_sums.hpp"
#include "holdfast/motion/modal/modal_deviations.hpp"
#include "holdfast/motion/modal/modal_motion.hpp"
#include "holdfast/motion/modal/natural_motions.hpp"
#include "holdfast/plant/plant_poles.hpp"

namespace holdfast {

/// Computes the five leading Lyapunov exponents of a ModalLoop, whose conductor is given by its
/// modes, from five tangent vectors. These are orthonormalised at every sample.
///
/// With a single mode the fifth exponent is −∞ if there is no processing delay or the drive was in
/// the backlash at a sample. Work per sample: 130 multiply-adds per NaturalMotion.
template <class Scalar = double>
class ModalSpectrum {
 public:
  /// @param loop  loop for which plant_poles() finds all poles (modal_motion() is not nullopt)
  explicit ModalSpectrum(const ModalLoop& loop)
      : ModalSpectrum(NaturalMotions(loop, plant_poles(loop.modes, loop.absorber)), loop.gains,
                      loop.sampling.processing_delay > 0.0) {}

  /// @param motions  natural motions of conductor and absorber in the loop
  /// @param gains    controller gains P (N/m) and D (N s/m)
  /// @param late     whether the loop has a processing delay δ > 0
  ModalSpectrum(const NaturalMotions& motions, const PdGains<double>& gains, bool late)
      : deviations_(motions, gains) {
    const Eigen::Index order = deviations_.order();
    finite_ = std::min<Eigen::Index>(leading, late ? order : order - 1);
    deviations_.begin(detail::oblique_basis<Scalar, Eigen::Dynamic>(order).leftCols(finite_));
  }

  /// Adds the next sample. @param engaged  whether the drive transmits its force at that sample
  void push(bool engaged) {
    deviations_.advance(engaged);
    Matrix<Scalar, Eigen::Dynamic> basis = deviations_.columns();
    // In the backlash no force is decided: one direction is lost, whatever the delay.
    if (!engaged) finite_ = std::min(finite_, deviations_.order() - 1);
    const Matrix<Scalar, Eigen::Dynamic> upper = orthonormalise(basis);
    Vector<Scalar, leading> logarithms = Vector<Scalar, leading>::Zero();
    for (Eigen::Index i = 0; i < finite_; ++i) {
      if (upper(i, i) == 0.0) {
        finite_ = i;
        break;
      }
      logarithms[i] = std::log(upper(i, i));
    }
    deviations_.begin(basis.leftCols(finite_));
    sums_.add(logarithms, 1);
  }

  /// Adds the next sample, as an observer of run_trajectory(); only `engaged` is used.
  void operator()(const MotionSample<double>& sample) { push(sample.engaged); }

  /// Restarts the averages; keeps tangent vectors and the number of exponents that are −∞.
  void restart() { sums_ = BatchSums<Scalar, leading>(1); }

  /// The Lyapunov spectrum over all samples since the last restart, natural logarithm per sample.
  LyapunovSpectrum<Scalar, 5> spectrum() const {
    return LyapunovSpectrum<Scalar, 5>({Matrix<Scalar, leading>::Identity(), sums_,
                                        Vector<Scalar, leading>::Zero(),
                                        static_cast<int>(finite_)});
  }

 private:
  static constexpr int leading = 5;

  ModalDeviations deviations_;
  Eigen::Index finite_;
  BatchSums<Scalar, leading> sums_{1};
};

/// Computes the five leading Lyapunov exponents, natural logarithm per sample, by running a motion
/// of a conductor given by its modes.
/// @param motion  a ModalMotion; it is advanced from its present state to the end of the run
/// @param loop    the loop of the motion
/// @param run     numbers of samples to discard and to average; `scope`: all five or the first one
/// @param pause   function called every 2¹² samples, if set; it may throw to end the run
/// @throws InvalidParameter where a number in `run` is out of its range
template <class Motion>
LyapunovResult run_lyapunov(Motion& motion, const ModalLoop& loop, const LyapunovRun& run,
                            const std::function<void()>& pause = {}) {
  validate(run);
  return detail::run_sampled(motion, ModalSpectrum(loop), run, pause);
}

}  // namespace holdfast
