#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

#include "holdfast/chaos/block_spectrum.hpp"
#include "holdfast/chaos/classification.hpp"
#include "holdfast/chaos/itinerary_blocks.hpp"
#include "holdfast/chaos/lyapunov_spectrum.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/sampled_motion.hpp"

namespace holdfast {

/// The settings of a run that averages Lyapunov exponents along a motion.
struct LyapunovRun {
  std::int64_t samples;      ///< number of samples averaged after the discarded ones, ≥ 1
  std::int64_t discard = 0;  ///< samples left out while motion and tangent vectors settle, ≥ 0
  LyapunovScope scope = LyapunovScope::all;  ///< exponents to be computed
};

/// Validates the settings of a run. @throws InvalidParameter where a field is not admissible
inline void validate(const LyapunovRun& run) {
  require_within("samples of the Lyapunov run", static_cast<double>(run.samples), "", 1, 9e15);
  require_within("discarded samples", static_cast<double>(run.discard), "", 0, 9e15);
}

/// The Lyapunov exponents of a motion, natural logarithm per sample, averaged over the samples
/// after the tangent vectors have settled (settled_means()).
struct LyapunovResult {
  /// Whether the state became infinite or NaN. The exponents are then averages up to that sample,
  /// or NaN if it was one of the discarded samples.
  bool diverged;
  /// The exponents λ₁ … λ₅ in the order of the QR factorisation; −∞ for a direction in which
  /// deviations become exactly zero. λ₂ … λ₅ are NaN where only λ₁ was computed.
  Vector<double, 5> exponents;
  /// The standard errors of the exponents, including a remaining bias of the first samples
  /// (settled_means()); 0 for −∞, NaN with fewer than four complete batches.
  Vector<double, 5> standard_errors;
  std::int64_t samples;       ///< number of samples averaged
  std::int64_t settling = 0;  ///< samples left out in addition to LyapunovRun::discard

  /// Whether the 99 % interval of λ₁ excludes zero, so that its sign is known.
  bool sign_is_known() const {
    if (exponents[0] == -std::numeric_limits<double>::infinity()) return true;
    if (!std::isfinite(exponents[0]) || !std::isfinite(standard_errors[0])) return false;
    const ExponentEstimate first = exponent_estimate(exponents[0], standard_errors[0]);
    return first.positive() || first.negative();
  }
};

namespace detail {

/// The result of a Lyapunov run, from the five leading exponents of a spectrum.
/// @tparam Size  ≥ 5
template <int Size>
LyapunovResult lyapunov_result(bool diverged, const LyapunovSpectrum<double, Size>& spectrum,
                               const LyapunovRun& run) {
  const SettledMeans<Size> settled = spectrum.settled();
  LyapunovResult result{diverged, settled.means.template head<5>(),
                        settled.standard_errors.template head<5>(), settled.steps,
                        settled.left_out};
  if (run.scope == LyapunovScope::largest) {
    result.exponents.tail<4>().setConstant(std::numeric_limits<double>::quiet_NaN());
    result.standard_errors.tail<4>().setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return result;
}

/// Averages the exponents of one motion: discards the first samples, then continues until the
/// samples are used up or the motion diverges.
/// @param pause  called every 2¹² samples
/// @tparam Lyapunov  type with sense(), advance() and state() of the motion, and with restart() and
///                   spectrum() of the exponents
template <class Lyapunov>
LyapunovResult run_average(Lyapunov& motion, const LyapunovRun& run,
                           const std::function<void()>& pause) {
  constexpr std::int64_t samples_between_pauses = 1 << 12;
  bool diverged = false;
  const auto advance = [&](std::int64_t samples) {
    for (std::int64_t taken = 0; taken < samples && !diverged; ++taken) {
      if (pause && taken % samples_between_pauses == 0) pause();
      motion.sense();
      diverged = !std::isfinite(motion.state().sum());
      if (diverged) return;
      motion.advance();
    }
  };
  advance(run.discard);
  motion.restart();
  advance(run.samples);
  return lyapunov_result(diverged, motion.spectrum(), run);
}

}  // namespace detail

/// An observer for run_trajectory() that accumulates the Lyapunov spectrum. The tangent map of a
/// sample is S where the force is transmitted, S* in the backlash.
///
/// S and S* should belong to the loop of the motion. To reproduce Table 2 of Kollár 2022, however,
/// pass a loop whose processing delay δ is one sampling period, while the motion has δ = 0.
/// @tparam Scalar  number type of the loop, `double`
template <class Scalar>
class LyapunovObserver {
 public:
  /// @param tangent_loop  loop whose maps S (drive engaged) and S* (in the backlash) are used
  /// @param gains         P (N/m) and D (N s/m) of the motion
  LyapunovObserver(const SampledLoop<Scalar>& tangent_loop, const PdGains<Scalar>& gains)
      : LyapunovObserver(std::make_shared<const ItineraryBlocks>(tangent_loop, gains)) {}

  /// @param blocks  products of the maps S and S* of a loop over blocks of samples
  /// @param scope   exponents to be computed
  explicit LyapunovObserver(std::shared_ptr<const ItineraryBlocks> blocks,
                            LyapunovScope scope = LyapunovScope::all)
      : engine_(std::move(blocks), scope) {}

  /// Adds the contact of the next sample; nothing else of the sample is used.
  void operator()(const MotionSample<Scalar>& sample) { push(sample.engaged); }
  /// Adds the next sample. @param engaged  whether the drive transmits at that sample
  void push(bool engaged) {
    open_ = followed_by(open_, engaged);
    if (!is_whole(open_)) return;
    engine_.push(open_);
    open_ = empty_block;
  }

  /// The Lyapunov spectrum since the last restart, equal to the result of a QR step per sample.
  LyapunovSpectrum<Scalar, 5> spectrum() const { return engine_.spectrum(open_); }
  /// Restarts the averages; only the directions of the tangent vectors are kept.
  void restart() {
    engine_.restart(open_);
    open_ = empty_block;
  }

 private:
  BlockSpectrum<Scalar> engine_;
  ItineraryBlock open_ = empty_block;
};

namespace detail {

/// A motion of the sampled loop with its Lyapunov exponents, as required by run_average().
/// @tparam Exponents  LyapunovObserver or ModalSpectrum
template <class Motion, class Exponents>
class SampledLyapunov : public Exponents {
 public:
  SampledLyapunov(Motion& motion, const Exponents& exponents)
      : Exponents(exponents), motion_(motion) {}

  void sense() { engaged_ = motion_.sense().engaged; }
  void advance() {
    Exponents::push(engaged_);
    motion_.advance();
  }
  const auto& state() const { return motion_.state(); }

 private:
  Motion& motion_;
  bool engaged_ = false;
};

/// The Lyapunov exponents of a motion from its present state over a run.
template <class Motion, class Exponents>
LyapunovResult run_sampled(Motion& motion, const Exponents& exponents, const LyapunovRun& run,
                           const std::function<void()>& pause) {
  SampledLyapunov<Motion, Exponents> lyapunov(motion, exponents);
  return run_average(lyapunov, run, pause);
}

}  // namespace detail

/// The Lyapunov exponents of the sampled loop with backlash along a motion from its present state.
///
///     auto blocks = std::make_shared<const ItineraryBlocks>(loop, gains);
///     const LyapunovResult result = run_lyapunov(motion, blocks, {1000000, 1000});
///
/// @param motion  a SampledMotion of `double`, not of a SIMD pack; advanced to the end of the run
/// @param blocks  products of the tangent maps S and S* of the motion's loop; not null
/// @param run     numbers of samples to discard and to average; exponents to be computed
/// @param pause   called every 2¹² samples; may throw to end the run
/// @throws InvalidParameter where `run` is not admissible or there are no blocks
template <class Motion>
LyapunovResult run_lyapunov(Motion& motion, const std::shared_ptr<const ItineraryBlocks>& blocks,
                            const LyapunovRun& run, const std::function<void()>& pause = {}) {
  validate(run);
  require_within("number of itinerary blocks", blocks ? 1.0 : 0.0, "", 1, 1);
  return detail::run_sampled(motion, LyapunovObserver<double>(blocks, run.scope), run, pause);
}

}  // namespace holdfast
