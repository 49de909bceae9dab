#pragma once

#include "holdfast/math/enclosure/enclosed_angle.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"

namespace holdfast {

/// Intervals that enclose a function f and its derivative f′ for all arguments in an interval.
/// Operations apply the rules of differentiation. Eigen's matrices can have entries of this type.
struct EnclosedSlope {
  Enclosure value;  ///< enclosure of f on the whole interval
  Enclosure slope;  ///< enclosure of f′ on the whole interval

  /// Constructs the constant function 0.
  EnclosedSlope() = default;
  /// Constructs a constant function; implicit, so that numbers may be used in formulas.
  EnclosedSlope(double constant) : value(constant) {}  // NOLINT(google-explicit-constructor)
  /// @param values  interval that encloses all values of f
  /// @param slopes  interval that encloses all values of f′
  EnclosedSlope(const Enclosure& values, const Enclosure& slopes) : value(values), slope(slopes) {}

  /// The middle of the enclosure of f, for messages and plausibility checks.
  explicit operator double() const { return value.middle(); }

  /// The function −f.
  EnclosedSlope operator-() const { return {-value, -slope}; }
  /// Adds the function g.
  EnclosedSlope& operator+=(const EnclosedSlope& g) { return *this = *this + g; }
  /// Subtracts the function g.
  EnclosedSlope& operator-=(const EnclosedSlope& g) { return *this = *this - g; }
  /// Multiplies by the function g.
  EnclosedSlope& operator*=(const EnclosedSlope& g) { return *this = *this * g; }

  /// The sum of two functions, f + g.
  friend EnclosedSlope operator+(const EnclosedSlope& f, const EnclosedSlope& g) {
    return {f.value + g.value, f.slope + g.slope};
  }
  /// The difference of two functions, f − g.
  friend EnclosedSlope operator-(const EnclosedSlope& f, const EnclosedSlope& g) {
    return {f.value - g.value, f.slope - g.slope};
  }
  /// The product of two functions, f g, with (f g)′ = f′ g + f g′.
  friend EnclosedSlope operator*(const EnclosedSlope& f, const EnclosedSlope& g) {
    return {f.value * g.value, f.slope * g.value + f.value * g.slope};
  }
  /// The quotient f/g, with (f/g)′ = (f′ − (f/g) g′)/g; both are (−∞, ∞) if g may be 0.
  friend EnclosedSlope operator/(const EnclosedSlope& f, const EnclosedSlope& g) {
    const Enclosure quotient = f.value / g.value;
    return {quotient, (f.slope - quotient * g.slope) / g.value};
  }
};

/// The square root √f of a function f ≥ 0; the derivative is (−∞, ∞) if f may be 0.
inline EnclosedSlope sqrt(const EnclosedSlope& f) {
  const Enclosure root = sqrt(f.value);
  return {root, f.slope / (Enclosure(2.0) * root)};
}
/// The cosine of a function f.
inline EnclosedSlope cos(const EnclosedSlope& f) {
  return {cos(f.value), -(sin(f.value) * f.slope)};
}
/// The sine of a function f.
inline EnclosedSlope sin(const EnclosedSlope& f) { return {sin(f.value), cos(f.value) * f.slope}; }

/// The function sin(f)/f, equal to 1 at f = 0; value and slope are (−∞, ∞) unless |f| < 2.4 is
/// proved. Its derivative with respect to f is −f/3 times a number between 1 − f²/10 and 1.
inline EnclosedSlope sinc(const EnclosedSlope& f) {
  if (!(f.value.magnitude() < 2.4)) return {Enclosure::unknown(), Enclosure::unknown()};
  const Enclosure squared = square(f.value);
  const Enclosure bend((Enclosure(1.0) - squared / Enclosure(10.0)).lower(), 1.0);
  return {detail::nested_series(squared, 2.0), -(f.value / Enclosure(3.0) * bend * f.slope)};
}

}  // namespace holdfast
