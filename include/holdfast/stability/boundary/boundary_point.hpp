#pragma once

#include "holdfast/control/gains.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/interval.hpp"

namespace holdfast {

/// Kind of a curve of the stability boundary in the plane of P and D. For gains on this curve the
/// loop has the stated characteristic root.
enum class BoundaryCurve {
  plus_one,        ///< sampled loop: real root λ = +1 (divergence)
  minus_one,       ///< sampled loop: real root λ = −1 (motion alternating from sample to sample)
  complex_pair,    ///< sampled loop: pair λ = e^{±iθ} (oscillation)
  zero,            ///< continuous loop: real root s = 0
  imaginary_pair,  ///< continuous loop: pair s = ±iω
};

/// The gain that varies while the other gain is fixed.
enum class FreeGain {
  proportional,  ///< proportional gain P (N/m)
  differential,  ///< differential gain D (N s/m)
};

namespace detail {

template <class Scalar>
const Scalar& gain_of(const PdGains<Scalar>& gains, FreeGain free) {
  return free == FreeGain::differential ? gains.differential : gains.proportional;
}

template <class Scalar>
PdGains<Scalar> with_gain(PdGains<Scalar> gains, FreeGain free, const Scalar& value) {
  (free == FreeGain::differential ? gains.differential : gains.proportional) = value;
  return gains;
}

/// Validates the fixed gain. @throws InvalidParameter where the fixed gain is not finite
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
  BoundaryCurve curve;  ///< kind of the boundary curve on which the point lies
  Scalar angle;  ///< θ (rad), 0 … π, of the root e^{±iθ}; continuous loop: ω (rad/s) of ±iω
  PdGains<Scalar> gains;  ///< P (N/m), finite; D (N s/m), −∞ and ∞ at the ends of a vertical line
};

/// Validates a range of P (N/m). @throws InvalidParameter unless lower < upper, both finite
inline void validate_proportional(const Interval<double>& range) {
  require_finite("lower end of the proportional gains", range.lower, "N/m");
  require_positive("width of the range of proportional gains", range.upper - range.lower, "N/m");
}

/// Rectangle in the plane of the gains P and D, its edges included.
struct GainWindow {
  Interval<double> proportional;  ///< P (N/m), finite, lower < upper
  Interval<double> differential;  ///< D (N s/m), finite, lower < upper

  /// The width of the window in P (N/m).
  double width() const { return proportional.upper - proportional.lower; }
  /// The height of the window in D (N s/m).
  double height() const { return differential.upper - differential.lower; }

  /// The area of the window in the plane of P and D (N²s/m²).
  double area() const { return width() * height(); }

  /// Whether gains are in the window or on its edges, with a tolerance of 10⁻¹² of its size.
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

/// Kind of a special point of the stability boundary, drawn with P horizontal and D vertical.
enum class BoundaryFeatureKind {
  vertical_tangent,    ///< dP/dθ = 0: a stable interval of D may appear or vanish as P varies
  horizontal_tangent,  ///< dD/dθ = 0: a stable interval of P may appear or vanish as D varies
  cusp,                ///< dP/dθ = dD/dθ = 0: double root pair; the curve reverses its direction
  crossing,            ///< crossing of two curves, or of the curve of root pairs with itself
  end,  ///< end of the curve of root pairs, where a pair becomes a double root λ = ±1 or s = 0
};

/// A root or root pair on the unit circle (continuous loop: on the imaginary axis).
template <class Scalar>
struct BoundaryRoot {
  BoundaryCurve curve;  ///< kind of the root and of the boundary curve that belongs to it
  Scalar angle;  ///< θ (rad), 0 … π, of the root e^{±iθ}; continuous loop: ω (rad/s) of ±iω
};

/// Special point of the stability boundary; at tangents and cusps `first` equals `second`.
template <class Scalar>
struct BoundaryFeature {
  BoundaryFeatureKind kind;     ///< kind of the special point
  BoundaryRoot<Scalar> first;   ///< pair, of two the one of smaller angle; λ = 1 of two real roots
  BoundaryRoot<Scalar> second;  ///< real root, or pair of larger angle; λ = −1 of two real roots
  PdGains<Scalar> gains;        ///< P (N/m) and D (N s/m), finite
  Scalar residual;  ///< error estimate: larger |p|/Σ |terms of p| of the polynomial p at both roots
};

}  // namespace holdfast
