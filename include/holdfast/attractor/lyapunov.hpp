#pragma once

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/batch_means.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/stepper.hpp"

namespace holdfast {

/// Lyapunov spectrum of a sequence of tangent maps, by QR at every step.
///
///     M_j Q_j = Q_{j+1} R_{j+1},   λ_i = (1/n) Σ_j ln |(R_j)_ii|   (natural logarithm per step)
///
/// A tangent map of rank r < Size annihilates Size − r directions: those exponents are exactly −∞,
/// and no logarithm of round-off is taken. The rank is that to working precision: a direction that
/// one step contracts by more than about 10¹⁵ against the others counts as annihilated. Source:
/// Kollár 2022, Eq. (16), whose Gram–Schmidt steps are this QR with a worse conditioning; G.
/// Benettin et al., Meccanica 15 (1980).
template <class Scalar, int Size>
class LyapunovSpectrum {
 public:
  /// @param initial_basis  Q₀, orthogonal; the exponents are those of the space that its leading
  /// columns
  ///                       reach, so that maps with an invariant coordinate axis need another than
  ///                       the identity
  explicit LyapunovSpectrum(
      const Matrix<Scalar, Size>& initial_basis = Matrix<Scalar, Size>::Identity())
      : basis_(initial_basis) {}

  /// Rank of a map to working precision; find it once where the same map is pushed many times.
  static int rank_of(const Matrix<Scalar, Size>& tangent) {
    return static_cast<int>(Eigen::FullPivLU<Matrix<Scalar, Size>>(tangent).rank());
  }

  /// Takes one step with the tangent map `tangent` of known rank.
  void push(const Matrix<Scalar, Size>& tangent, int rank) {
    const Matrix<Scalar, Size> stretched = tangent * basis_;
    const Eigen::HouseholderQR<Matrix<Scalar, Size>> qr(stretched);
    basis_ = qr.householderQ();
    finite_ = std::min(finite_, rank);
    for (int i = 0; i < finite_; ++i) {
      const Scalar stretch = std::abs(qr.matrixQR()(i, i));
      if (stretch == Scalar(0)) {
        finite_ = i;
        break;
      }
      logarithms_[static_cast<std::size_t>(i)].push(std::log(stretch));
    }
    ++steps_;
  }

  void push(const Matrix<Scalar, Size>& tangent) { push(tangent, rank_of(tangent)); }

  /// λ₁ … λ_Size per step, in the order of the QR (descending once converged); −∞ where exact.
  Vector<Scalar, Size> exponents() const {
    return read([](const auto& series) { return series.mean(); },
                -std::numeric_limits<Scalar>::infinity());
  }

  /// Standard errors by batch means; 0 for an exact −∞, NaN while there are too few steps.
  Vector<Scalar, Size> standard_errors() const {
    return read([](const auto& series) { return series.standard_error(); }, Scalar(0));
  }

  std::int64_t steps() const { return steps_; }

 private:
  template <class Read>
  Vector<Scalar, Size> read(Read of_series, Scalar where_annihilated) const {
    Vector<Scalar, Size> result = Vector<Scalar, Size>::Constant(where_annihilated);
    for (int i = 0; i < finite_; ++i)
      result[i] = of_series(logarithms_[static_cast<std::size_t>(i)]);
    return result;
  }

  Matrix<Scalar, Size> basis_;
  std::array<BatchMeans<Scalar>, Size> logarithms_{};
  int finite_ = Size;  // number of exponents that are not −∞
  std::int64_t steps_ = 0;
};

/// Observer of a trajectory that accumulates its Lyapunov spectrum: S where the force is
/// transmitted, S* in the backlash.
///
/// The consistent tangent comes from the loop of the motion itself. Kollár 2022 prints S and S*
/// with δ = τ beside a trajectory with δ = 0; passing the loop of δ = τ here gives the exponents of
/// Table 2.
class LyapunovObserver {
 public:
  LyapunovObserver(const SampledLoop<double>& tangent_loop, const PdGains<double>& gains)
      : engaged_(tangent_loop.engaged_map(gains)),
        backlash_(tangent_loop.backlash_map()),
        engaged_rank_(LyapunovSpectrum<double, 5>::rank_of(engaged_)),
        backlash_rank_(LyapunovSpectrum<double, 5>::rank_of(backlash_)) {}

  void operator()(const MotionSample<double>& sample) {
    if (sample.engaged) {
      spectrum_.push(engaged_, engaged_rank_);
    } else {
      spectrum_.push(backlash_, backlash_rank_);
    }
  }

  const LyapunovSpectrum<double, 5>& spectrum() const { return spectrum_; }

 private:
  Matrix<double, 5> engaged_;
  Matrix<double, 5> backlash_;
  int engaged_rank_;
  int backlash_rank_;
  LyapunovSpectrum<double, 5> spectrum_;
};

}  // namespace holdfast
