#pragma once

#include "holdfast/control/gains.hpp"
#include "holdfast/core/errors.hpp"

namespace holdfast {

/// Where a characteristic root crosses as the gains cross a boundary curve.
enum class BoundaryCurve {
  plus_one,  ///< sampled loop: real root λ = +1 (divergence)
  minus_one,  ///< sampled loop: real root λ = −1 (flip: the force alternates from sample to sample)
  complex_pair,    ///< sampled loop: pair λ = e^{±iθ} (oscillation)
  zero,            ///< continuous loop: real root s = 0
  imaginary_pair,  ///< continuous loop: pair s = ±iω
};

/// One point of the boundary in the gain plane.
template <class Scalar>
struct BoundaryPoint {
  BoundaryCurve curve;  ///< which root crosses
  Scalar angle;  ///< θ (rad) of the sampled loop's root, 0 … π; ω (rad/s) for the continuous loop
  PdGains<Scalar> gains;  ///< P (N/m), finite; D (N s/m), ∓∞ at the ends of a vertical line
};

/// A range of proportional gains, N/m.
struct ProportionalRange {
  double lower;  ///< P (N/m), finite
  double upper;  ///< P (N/m), finite, > lower
};

/// @throws InvalidParameter unless range.lower < range.upper, both finite
inline void validate(const ProportionalRange& range) {
  require_finite("lower end of the proportional gains", range.lower, "N/m");
  require_positive("width of the range of proportional gains", range.upper - range.lower, "N/m");
}

}  // namespace holdfast
