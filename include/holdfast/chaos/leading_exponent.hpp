#pragma once

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "holdfast/chaos/classification.hpp"
#include "holdfast/chaos/lyapunov_spectrum.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// The largest Lyapunov exponent of a sequence of tangent maps, with a 95 % interval that holds
/// also where the sums are bounded.
///
/// First `settle` turns the basis into the directions of the exponents, and nothing is summed; a
/// mean that began before would carry the turning as a share of order 1/n. Then `push` sums
/// s_n = Σ ln |R_jj|. Two things bound the error of s_n/n:
///
///  - the scatter of batch means, which a chaotic motion has;
///  - s_n − n λ of a motion that is not chaotic (a linear loop with complex multipliers, a closed
///    orbit) does not wander but turns within bounds. Then its batch means scatter by what is cut
///    off at their ends, and hardly at all where the batches are whole turns; the error is at most
///    the width of those bounds over n. The width is read off the last 1/32 of the steps, where a
///    wandering sum moves by much less than its standard error.
///
/// The interval is the larger of the two, see `exponent_estimate`.
template <int Size>
class LeadingExponent {
 public:
  /// Begins without a map. The first argument is how many maps will be pushed after settling, ≥ 64;
  /// the second their size, where that is known at run time alone.
  /// @throws InvalidParameter for fewer
  explicit LeadingExponent(std::int64_t expected_steps, Eigen::Index size = Size < 0 ? 0 : Size)
      : basis_(Matrix<double, Size>::Identity(size, size)),
        spectrum_(basis_),
        watched_from_(expected_steps - expected_steps / 32) {
    require_within("number of steps", static_cast<double>(expected_steps), "", 64.0, 1e15);
    sums_.reserve(static_cast<std::size_t>(std::min<std::int64_t>(expected_steps / 32, most_sums)));
  }

  /// Turns the basis by one map of the transient; call before the first push.
  void settle(const Matrix<double, Size>& tangent) {
    const Matrix<double, Size> stretched = tangent * basis_;
    basis_ = Eigen::HouseholderQR<Matrix<double, Size>>(stretched).householderQ();
  }

  /// Takes in one map.
  void push(const Matrix<double, Size>& tangent) {
    if (spectrum_.steps() == 0) spectrum_ = LyapunovSpectrum<double, Size>(basis_);
    spectrum_.push(tangent, rank_of(tangent));
    if (spectrum_.steps() < watched_from_ || sums_.size() >= most_sums) return;
    sums_.push_back(spectrum_.exponents() * static_cast<double>(spectrum_.steps()));
  }

  /// All exponents over the maps pushed, with standard errors by batch means alone.
  const LyapunovSpectrum<double, Size>& spectrum() const { return spectrum_; }

  /// The largest exponent; only after at least 64 maps.
  ExponentEstimate indicators() const {
    Eigen::Index which = 0;
    const double value = spectrum_.exponents().maxCoeff(&which);
    const double steps = static_cast<double>(spectrum_.steps());
    return exponent_estimate(value, spectrum_.standard_errors()[which],
                             bounds_width(which, value) / steps);
  }

 private:
  static constexpr std::size_t most_sums = 4096;

  static int rank_of(const Matrix<double, Size>& tangent) {
    if constexpr (Size == 1) {
      return tangent(0, 0) == 0.0 ? 0 : 1;
    } else {
      return LyapunovSpectrum<double, Size>::rank_of(tangent);
    }
  }

  /// max − min of s_n − n λ over the watched steps.
  double bounds_width(Eigen::Index which, double value) const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t n = 0; n < sums_.size(); ++n) {
      const double deviation = sums_[n][which] - static_cast<double>(n) * value;
      low = std::min(low, deviation);
      high = std::max(high, deviation);
    }
    return std::isfinite(high - low) ? high - low : 0.0;
  }

  Matrix<double, Size> basis_;
  LyapunovSpectrum<double, Size> spectrum_;
  std::int64_t watched_from_;
  std::vector<Vector<double, Size>> sums_;
};

}  // namespace holdfast
