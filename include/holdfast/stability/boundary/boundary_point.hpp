#pragma once

#include "holdfast/control/gains.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/interval.hpp"

namespace holdfast {

/// Kind of a stability boundary in the gain plane, by the characteristic root on the boundary.
enum class BoundaryCurve {
  plus_one,  ///< sampled loop: real root λ = +1 (divergence)
  minus_one,  ///< sampled loop: real root λ = −1 (flip: the force alternates from sample to sample)
  complex_pair,    ///< sampled loop: pair λ = e^{±iθ} (oscillation)
  zero,            ///< continuous loop: real root s = 0
  imaginary_pair,  ///< continuous loop: pair s = ±iω
};

/// The gain that varies while the other one is constant.
enum class FreeGain {
  proportional,  ///< proportional gain P (N/m)
  differential,  ///< differential gain D (N s/m)
};

namespace detail {

/// The value of the gain that is free to vary, P or D.
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

/// Validates the gain that is kept constant. @throws InvalidParameter where it is not finite
template <class Scalar>
void require_held(const PdGains<Scalar>& gains, FreeGain free) {
  const bool by_d = free == FreeGain::differential;
  require_finite("fixed gain", static_cast<double>(by_d ? gains.proportional : gains.differential),
                 by_d ? "N/m" : "N s/m");
}

}  // namespace detail

/// One point of the stability boundary in the plane of the gains P and D.
template <class Scalar>
struct BoundaryPoint {
  BoundaryCurve curve;  ///< kind of the root or root pair on the boundary at this point
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

  /// The extent of the window in P (N/m).
  double width() const { return proportional.upper - proportional.lower; }
  /// The extent of the window in D (N s/m).
  double height() const { return differential.upper - differential.lower; }

  /// The area of the window in the plane of P and D (N²s/m²).
  double area() const { return width() * height(); }

  /// Whether gains lie in the window or on its edges, with a slack of 10⁻¹² of the window's size.
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

/// Kind of a special point of the stability boundary, P being horizontal and D vertical.
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
  BoundaryCurve curve;  ///< kind of the boundary curve on which the root lies
  Scalar angle;         ///< θ (rad) 0 … π, or ω (rad/s) for the continuous loop
};

/// Special point of the stability boundary. Its two roots differ only at a `crossing` or an `end`.
template <class Scalar>
struct BoundaryFeature {
  BoundaryFeatureKind kind;    ///< kind of the special point
  BoundaryRoot<Scalar> first;  ///< the pair; of two pairs the slower; of two lines λ = +1
  BoundaryRoot<Scalar> second;  ///< root of the line; of two pairs the faster; of two lines λ = −1
  PdGains<Scalar> gains;        ///< P (N/m) and D (N s/m), finite
  Scalar residual;  ///< characteristic polynomial over the sum of its |terms|, at the worse root
  /// Whether a vertical and a horizontal tangent are so near to each other that they almost form a
  /// cusp: a small change of the loop swaps them, and stable intervals appear or vanish.
  bool nearly_cusp = false;
};

}  // namespace holdfast
