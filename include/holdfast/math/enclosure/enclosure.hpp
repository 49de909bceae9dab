#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "holdfast/core/types.hpp"

namespace holdfast {

namespace detail {

/// A bound of half the distance from a double x to its neighbours: the largest error of a sum,
/// product, quotient or root that is rounded to x. The bound is valid for x = 0 too. It is never
/// subnormal, since operations on subnormal numbers are many times slower. Source: S. M. Rump, P.
/// Zimmermann, S. Boldo, G. Melquiond, Computing predecessor and successor in rounding to nearest,
/// BIT 49 (2009), Algorithm 1.
inline double rounding_of(double x) {
  constexpr double unit = 0x1.0000000000001p-53, least = 0x1p-900;
  return unit * std::abs(x) + least;
}
/// A lower bound of all numbers that round to x; −∞ where x is not a number.
inline double rounded_down(double x) {
  const double below = x - rounding_of(x);
  return below == below ? below : -std::numeric_limits<double>::infinity();
}
/// An upper bound of all numbers that round to x; ∞ where x is not a number.
inline double rounded_up(double x) {
  const double above = x + rounding_of(x);
  return above == above ? above : std::numeric_limits<double>::infinity();
}

}  // namespace detail

/// A real number that is proved to lie in an interval, for interval arithmetic in `double`.
///
/// Every operation gives an interval that contains the exact result for all numbers in the argument
/// intervals. Bounds are rounded outward. They are valid if the processor rounds to nearest, its
/// default mode, with or without fused multiply-adds. Division by a number that may be 0 gives
/// (−∞, ∞); a bound that overflows is ±∞. There is no operator `<`, since an inequality that is not
/// proved need not be false. The class can be the number type of Eigen's matrices and of templates
/// without comparisons. Source: IEEE 1788-2015 for the set that each operation encloses.
class Enclosure {
 public:
  /// Constructs the exact number 0.
  Enclosure() = default;
  /// Encloses a double exactly; implicit, so that doubles may be used in formulas.
  Enclosure(double exact) : Enclosure(exact, exact) {}  // NOLINT(google-explicit-constructor)
  /// Constructs the interval [lower, upper]; (−∞, ∞) if lower > upper or one is NaN.
  Enclosure(double lower, double upper) : lower_(lower), upper_(upper) {
    if (!(lower <= upper)) *this = unknown();
  }

  /// An interval that contains all decimal numbers whose nearest double is `nearest`; [0, 0] for 0.
  static Enclosure of_decimal(double nearest) {
    if (nearest == 0.0) return {};
    return {detail::rounded_down(nearest), detail::rounded_up(nearest)};
  }
  /// An interval that contains all decimal numbers whose nearest double is in [from, to].
  static Enclosure of_decimals(double from, double to) {
    return {of_decimal(from).lower(), of_decimal(to).upper()};
  }
  /// The interval (−∞, ∞) of a number about which nothing is known.
  static Enclosure unknown() {
    Enclosure all;
    all.lower_ = -std::numeric_limits<double>::infinity();
    all.upper_ = std::numeric_limits<double>::infinity();
    return all;
  }

  /// A lower bound of the number.
  double lower() const { return lower_; }
  /// An upper bound of the number.
  double upper() const { return upper_; }
  /// A double in the interval, near the midpoint; ±∞ if one bound is ±∞, 0 if both are infinite.
  double middle() const {
    const double half = 0.5 * lower_ + 0.5 * upper_;
    return half == half ? std::clamp(half, lower_, upper_) : 0.0;
  }
  /// An upper bound of the distance of any number in the interval from middle().
  double radius() const {
    const double centre = middle();
    return detail::rounded_up(std::max(upper_ - centre, centre - lower_));
  }
  /// An upper bound of the modulus of any number in the interval.
  double magnitude() const { return std::max(std::abs(lower_), std::abs(upper_)); }
  /// Whether x is in the interval.
  bool contains(double x) const { return lower_ <= x && x <= upper_; }
  /// The double middle(), for messages and plausibility checks only.
  explicit operator double() const { return middle(); }

  /// Whether the number is proved to be > 0.
  bool is_positive() const { return lower_ > 0.0; }
  /// Whether the number is proved to be < 0.
  bool is_negative() const { return upper_ < 0.0; }

  /// The negative of this number; the interval does not widen.
  Enclosure operator-() const { return {-upper_, -lower_}; }
  /// Adds the number b.
  Enclosure& operator+=(const Enclosure& b) { return *this = *this + b; }
  /// Subtracts the number b.
  Enclosure& operator-=(const Enclosure& b) { return *this = *this - b; }
  /// Multiplies by the number b.
  Enclosure& operator*=(const Enclosure& b) { return *this = *this * b; }
  /// Divides by the number b; the result is (−∞, ∞) if b may be 0.
  Enclosure& operator/=(const Enclosure& b) { return *this = *this / b; }

  /// The sum a + b.
  friend Enclosure operator+(const Enclosure& a, const Enclosure& b) {
    return {detail::rounded_down(a.lower_ + b.lower_), detail::rounded_up(a.upper_ + b.upper_)};
  }
  /// The difference a − b.
  friend Enclosure operator-(const Enclosure& a, const Enclosure& b) { return a + (-b); }
  /// The product a b.
  friend Enclosure operator*(const Enclosure& a, const Enclosure& b) {
    return hull_of(a.lower_ * b.lower_, a.lower_ * b.upper_, a.upper_ * b.lower_,
                   a.upper_ * b.upper_);
  }
  /// The quotient a / b; (−∞, ∞) if b may be 0.
  friend Enclosure operator/(const Enclosure& a, const Enclosure& b) {
    if (b.contains(0.0)) return unknown();
    return hull_of(a.lower_ / b.lower_, a.lower_ / b.upper_, a.upper_ / b.lower_,
                   a.upper_ / b.upper_);
  }
  /// Whether the bounds are equal; the two enclosed numbers may still differ.
  friend bool operator==(const Enclosure& a, const Enclosure& b) {
    return a.lower_ == b.lower_ && a.upper_ == b.upper_;
  }
  /// Whether the bounds differ.
  friend bool operator!=(const Enclosure& a, const Enclosure& b) { return !(a == b); }

  /// The square a².
  friend Enclosure square(const Enclosure& a) {
    const double most = a.magnitude();
    const double least = a.contains(0.0) ? 0.0 : std::min(std::abs(a.lower_), std::abs(a.upper_));
    return {std::max(detail::rounded_down(least * least), 0.0), detail::rounded_up(most * most)};
  }
  /// The square root of the numbers ≥ 0 in a; (−∞, ∞) if all numbers in a are negative.
  friend Enclosure sqrt(const Enclosure& a) {
    if (a.upper_ < 0.0) return unknown();
    const double least = std::sqrt(std::max(a.lower_, 0.0));
    return {std::max(detail::rounded_down(least), 0.0), detail::rounded_up(std::sqrt(a.upper_))};
  }
  /// The absolute value |a|.
  friend Enclosure abs(const Enclosure& a) {
    if (a.contains(0.0)) return {0.0, a.magnitude()};
    return a.lower_ > 0.0 ? a : -a;
  }
  /// The intersection of two intervals that enclose the same number. If it is empty, one of them
  /// must be wrong, and the result is (−∞, ∞).
  friend Enclosure intersection(const Enclosure& a, const Enclosure& b) {
    return {std::max(a.lower_, b.lower_), std::min(a.upper_, b.upper_)};
  }

 private:
  /// The interval spanned by four products or quotients of bounds; (−∞, ∞) if one of them is NaN.
  static Enclosure hull_of(double a, double b, double c, double d) {
    const double sum = a + b + (c + d);
    if (!(sum == sum)) return unknown();  // one is 0 · ∞, or both infinities are among them
    return {detail::rounded_down(std::min(std::min(a, b), std::min(c, d))),
            detail::rounded_up(std::max(std::max(a, b), std::max(c, d)))};
  }

  double lower_ = 0.0, upper_ = 0.0;
};

/// The number π, enclosed by two neighbouring doubles.
template <>
inline const Enclosure pi<Enclosure> = Enclosure(0x1.921fb54442d18p+1, 0x1.921fb54442d19p+1);

}  // namespace holdfast
