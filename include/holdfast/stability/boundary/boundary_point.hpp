#pragma once

#include "holdfast/control/gains.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/interval.hpp"

namespace holdfast {

/// The kind of a boundary curve, by the value of the characteristic root that crosses there.
enum class BoundaryCurve {
  plus_one,  ///< sampled loop: real root λ = +1 (divergence)
  minus_one,  ///< sampled loop: real root λ = −1 (flip: the force alternates from sample to sample)
  complex_pair,    ///< sampled loop: pair λ = e^{±iθ} (oscillation)
  zero,            ///< continuous loop: real root s = 0
  imaginary_pair,  ///< continuous loop: pair s = ±iω
};

/// The gain that varies while the other one is constant.
enum class FreeGain {
  proportional,  ///< P
  differential,  ///< D
};

namespace detail {

/// The free one of two gains.
template <class Scalar>
const Scalar& gain_of(const PdGains<Scalar>& gains, FreeGain free) {
  return free == FreeGain::differential ? gains.differential : gains.proportional;
}

/// The gains with the free one replaced by a given value.
template <class Scalar>
PdGains<Scalar> with_gain(PdGains<Scalar> gains, FreeGain free, const Scalar& value) {
  (free == FreeGain::differential ? gains.differential : gains.proportional) = value;
  return gains;
}

/// Validates the constant gain. @throws InvalidParameter where it is not finite
template <class Scalar>
void require_held(const PdGains<Scalar>& gains, FreeGain free) {
  const bool by_d = free == FreeGain::differential;
  require_finite("fixed gain", static_cast<double>(by_d ? gains.proportional : gains.differential),
                 by_d ? "N/m" : "N s/m");
}

}  // namespace detail

/// One point of the boundary in the gain plane.
template <class Scalar>
struct BoundaryPoint {
  BoundaryCurve curve;  ///< root or pair that crosses here
  Scalar angle;  ///< θ (rad) of the sampled loop's root, 0 … π; ω (rad/s) for the continuous loop
  PdGains<Scalar> gains;  ///< P (N/m), finite; D (N s/m), ∓∞ at the ends of a vertical line
};

/// Validates a range of P (N/m). @throws InvalidParameter unless lower < upper, both finite
inline void validate_proportional(const Interval<double>& range) {
  require_finite("lower end of the proportional gains", range.lower, "N/m");
  require_positive("width of the range of proportional gains", range.upper - range.lower, "N/m");
}

/// A rectangle of the gain plane, its edges included.
struct GainWindow {
  Interval<double> proportional;  ///< P (N/m), finite, lower < upper
  Interval<double> differential;  ///< D (N s/m), finite, lower < upper

  /// The extent in P (N/m).
  double width() const { return proportional.upper - proportional.lower; }
  /// The extent in D (N s/m).
  double height() const { return differential.upper - differential.lower; }

  /// The area in the plane of P and D (N²s/m²).
  double area() const { return width() * height(); }

  /// Whether gains lie in the window or on its edges; round-off of 10⁻¹² of its size is allowed.
  template <class Scalar>
  bool contains(const PdGains<Scalar>& gains) const {
    const Scalar p_slack(1e-12 * width()), d_slack(1e-12 * height());
    return gains.proportional >= Scalar(proportional.lower) - p_slack &&
           gains.proportional <= Scalar(proportional.upper) + p_slack &&
           gains.differential >= Scalar(differential.lower) - d_slack &&
           gains.differential <= Scalar(differential.upper) + d_slack;
  }
};

/// Validates a window. @throws InvalidParameter unless both ranges are finite with lower < upper
inline void validate(const GainWindow& window) {
  validate_proportional(window.proportional);
  require_finite("lower end of the differential gains", window.differential.lower, "N s/m");
  require_positive("width of the range of differential gains", window.height(), "N s/m");
}

/// The special points of the boundary in the plane of P (horizontal) and D (vertical).
enum class BoundaryFeatureKind {
  vertical_tangent,    ///< dP/dθ = 0: a stable interval of D opens or closes here
  horizontal_tangent,  ///< dD/dθ = 0: a stable interval of P opens or closes here
  cusp,                ///< dP/dθ = dD/dθ = 0: a double pair, the curve turns back on itself
  crossing,            ///< crossing of two curves, or of the curve of pairs with itself
  end,                 ///< the curve of pairs ends on a line: a double root λ = ±1 (s = 0)
};

/// A root, or a pair of roots, on the boundary of stability.
template <class Scalar>
struct BoundaryRoot {
  BoundaryCurve curve;  ///< curve on which the root crosses
  Scalar angle;         ///< θ (rad) 0 … π, or ω (rad/s) for the continuous loop
};

/// One special point of the boundary. Its two roots differ at crossings and ends only.
template <class Scalar>
struct BoundaryFeature {
  BoundaryFeatureKind kind;    ///< kind of the point and so of its two roots
  BoundaryRoot<Scalar> first;  ///< root pair; the slower of two pairs; λ = +1 (s = 0) of two lines
  BoundaryRoot<Scalar> second;  ///< root of the line; the faster of two pairs; λ = −1 of two lines
  PdGains<Scalar> gains;        ///< P (N/m) and D (N s/m), finite
  Scalar residual;  ///< larger |p|/Σ|terms| at the two roots, p the characteristic polynomial
  /// Whether a tangent of the other kind is so near that the two almost form a cusp: a small change
  /// of the loop swaps them, and stable intervals appear or vanish.
  bool nearly_cusp = false;
};

}  // namespace holdfast
