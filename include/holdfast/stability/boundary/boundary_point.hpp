#pragma once

#include "holdfast/control/gains.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/interval.hpp"

namespace holdfast {

/// Where a characteristic root crosses as the gains cross a boundary curve.
enum class BoundaryCurve {
  plus_one,  ///< sampled loop: real root λ = +1 (divergence)
  minus_one,  ///< sampled loop: real root λ = −1 (flip: the force alternates from sample to sample)
  complex_pair,    ///< sampled loop: pair λ = e^{±iθ} (oscillation)
  zero,            ///< continuous loop: real root s = 0
  imaginary_pair,  ///< continuous loop: pair s = ±iω
};

/// Which of the two gains varies while the other is held.
enum class FreeGain {
  proportional,  ///< P
  differential,  ///< D
};

namespace detail {

/// The one of two gains that is free.
template <class Scalar>
const Scalar& gain_of(const PdGains<Scalar>& gains, FreeGain free) {
  return free == FreeGain::differential ? gains.differential : gains.proportional;
}

/// The gains with another value of the free one.
template <class Scalar>
PdGains<Scalar> with_gain(PdGains<Scalar> gains, FreeGain free, const Scalar& value) {
  (free == FreeGain::differential ? gains.differential : gains.proportional) = value;
  return gains;
}

/// @throws InvalidParameter for a held gain that is not finite
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
  BoundaryCurve curve;  ///< which root crosses
  Scalar angle;  ///< θ (rad) of the sampled loop's root, 0 … π; ω (rad/s) for the continuous loop
  PdGains<Scalar> gains;  ///< P (N/m), finite; D (N s/m), ∓∞ at the ends of a vertical line
};

/// @throws InvalidParameter unless range.lower < range.upper, both finite, of P (N/m)
inline void validate_proportional(const Interval<double>& range) {
  require_finite("lower end of the proportional gains", range.lower, "N/m");
  require_positive("width of the range of proportional gains", range.upper - range.lower, "N/m");
}

/// A rectangle of the gain plane, its edges included.
struct GainWindow {
  Interval<double> proportional;  ///< P (N/m), finite, lower < upper
  Interval<double> differential;  ///< D (N s/m), likewise

  /// Extent in P (N/m).
  double width() const { return proportional.upper - proportional.lower; }
  /// Extent in D (N s/m).
  double height() const { return differential.upper - differential.lower; }

  /// N²s/m².
  double area() const { return width() * height(); }

  /// True within the edges or on them; 10⁻¹² of the size is granted to round-off.
  template <class Scalar>
  bool contains(const PdGains<Scalar>& gains) const {
    const Scalar p_slack(1e-12 * width()), d_slack(1e-12 * height());
    return gains.proportional >= Scalar(proportional.lower) - p_slack &&
           gains.proportional <= Scalar(proportional.upper) + p_slack &&
           gains.differential >= Scalar(differential.lower) - d_slack &&
           gains.differential <= Scalar(differential.upper) + d_slack;
  }
};

/// @throws InvalidParameter unless lower < upper in both ranges, all finite
inline void validate(const GainWindow& window) {
  validate_proportional(window.proportional);
  require_finite("lower end of the differential gains", window.differential.lower, "N s/m");
  require_positive("width of the range of differential gains", window.height(), "N s/m");
}

/// Special points of the boundary in the plane of P (across) and D (up).
enum class BoundaryFeatureKind {
  vertical_tangent,    ///< dP/dθ = 0: a stable interval of D opens or closes here
  horizontal_tangent,  ///< dD/dθ = 0: a stable interval of P opens or closes here
  cusp,                ///< dP/dθ = dD/dθ = 0: a double pair, the curve turns back on itself
  crossing,            ///< two curves, or the curve of pairs with itself
  end,                 ///< the curve of pairs ends on a line: a double root λ = ±1 (s = 0)
};

/// A root, or pair, on the boundary of stability.
template <class Scalar>
struct BoundaryRoot {
  BoundaryCurve curve;  ///< on which it lies
  Scalar angle;         ///< θ (rad) 0 … π, or ω (rad/s) for the continuous loop
};

/// One special point of the boundary. The two roots are the same but for crossings and ends.
template <class Scalar>
struct BoundaryFeature {
  BoundaryFeatureKind kind;     ///< tells what the two roots are
  BoundaryRoot<Scalar> first;   ///< the pair, of two pairs the slower one; of two lines λ = +1
  BoundaryRoot<Scalar> second;  ///< the line, or the faster pair; of two lines λ = −1
  PdGains<Scalar> gains;        ///< P (N/m) and D (N s/m), finite
  Scalar residual;  ///< larger |p(x)| of the two roots, over the sum of the moduli of its terms
  /// Whether a tangent of the other kind lies so near that the two are nearly a cusp, where a small
  /// change of the loop swaps them, and stable intervals appear or vanish.
  bool nearly_cusp = false;
};

}  // namespace holdfast
