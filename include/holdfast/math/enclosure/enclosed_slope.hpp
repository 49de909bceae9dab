#pragma once

#include "holdfast/math/enclosure/enclosed_angle.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"

namespace holdfast {

/// A function of one variable on an interval: enclosures of its values and of its derivative there.
/// Operations follow the rules of differentiation. A number type of Eigen's matrices.
struct EnclosedSlope {
  Enclosure value;  ///< f on the whole interval
  Enclosure slope;  ///< f′ on the whole interval

  /// The number 0.
  EnclosedSlope() = default;
  /// A constant; implicit, so that numbers may be used in formulas.
  EnclosedSlope(double constant) : value(constant) {}  // NOLINT(google-explicit-constructor)
  /// @param values  f
  /// @param slopes  f′
  EnclosedSlope(const Enclosure& values, const Enclosure& slopes) : value(values), slope(slopes) {}

  /// The middle of the values, for messages and plausibility checks.
  explicit operator double() const { return value.middle(); }

  /// The negative −f.
  EnclosedSlope operator-() const { return {-value, -slope}; }
  /// Adds g.
  EnclosedSlope& operator+=(const EnclosedSlope& g) { return *this = *this + g; }
  /// Subtracts g.
  EnclosedSlope& operator-=(const EnclosedSlope& g) { return *this = *this - g; }
  /// Multiplies by g.
  EnclosedSlope& operator*=(const EnclosedSlope& g) { return *this = *this * g; }

  /// The sum f + g.
  friend EnclosedSlope operator+(const EnclosedSlope& f, const EnclosedSlope& g) {
    return {f.value + g.value, f.slope + g.slope};
  }
  /// The difference f − g.
  friend EnclosedSlope operator-(const EnclosedSlope& f, const EnclosedSlope& g) {
    return {f.value - g.value, f.slope - g.slope};
  }
  /// The product f g: (f g)′ = f′ g + f g′.
  friend EnclosedSlope operator*(const EnclosedSlope& f, const EnclosedSlope& g) {
    return {f.value * g.value, f.slope * g.value + f.value * g.slope};
  }
  /// The quotient f/g: (f/g)′ = (f′ − (f/g) g′)/g; unknown where g may be 0.
  friend EnclosedSlope operator/(const EnclosedSlope& f, const EnclosedSlope& g) {
    const Enclosure quotient = f.value / g.value;
    return {quotient, (f.slope - quotient * g.slope) / g.value};
  }
};

/// The root √f, f > 0; its derivative is unknown where f may be 0.
inline EnclosedSlope sqrt(const EnclosedSlope& f) {
  const Enclosure root = sqrt(f.value);
  return {root, f.slope / (Enclosure(2.0) * root)};
}
/// The cosine of f.
inline EnclosedSlope cos(const EnclosedSlope& f) {
  return {cos(f.value), -(sin(f.value) * f.slope)};
}
/// The sine of f.
inline EnclosedSlope sin(const EnclosedSlope& f) { return {sin(f.value), cos(f.value) * f.slope}; }

/// The quotient sin(f)/f, −2.4 < f < 2.4, else unknown: 1 − f²/6 (1 − f²/20 (…)), whose derivative
/// is −f/3 times a number between 1 − f²/10 and 1.
inline EnclosedSlope sinc(const EnclosedSlope& f) {
  if (!(f.value.magnitude() < 2.4)) return {Enclosure::unknown(), Enclosure::unknown()};
  const Enclosure squared = square(f.value);
  const Enclosure bend((Enclosure(1.0) - squared / Enclosure(10.0)).lower(), 1.0);
  return {detail::nested_series(squared, 2.0), -(f.value / Enclosure(3.0) * bend * f.slope)};
}

}  // namespace holdfast
