#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "holdfast/core/types.hpp"

namespace holdfast {

namespace detail {

/// At least half the distance to the neighbours of a double, and of 0: what a sum, product,
/// quotient or root, rounded to the nearest double, is wrong by at most.
/// Source: S. M. Rump, P. Zimmermann, S. Boldo, G. Melquiond, Computing predecessor and successor
/// in rounding to nearest, BIT 49 (2009), Algorithm 1.
inline double rounding_of(double x) {
  constexpr double unit = 0x1.0000000000001p-53, least = std::numeric_limits<double>::denorm_min();
  return unit * std::abs(x) + least;
}
/// Not above any number that rounds to x; −∞ where x is no number.
inline double rounded_down(double x) {
  const double below = x - rounding_of(x);
  return below == below ? below : -std::numeric_limits<double>::infinity();
}
/// Not below any number that rounds to x; ∞ where x is no number.
inline double rounded_up(double x) {
  const double above = x + rounding_of(x);
  return above == above ? above : std::numeric_limits<double>::infinity();
}

}  // namespace detail

/// A real number of which it is proved that lower ≤ x ≤ upper: interval arithmetic on doubles.
///
/// Every operation gives an enclosure of the operation's result on all numbers that its arguments
/// may be; bounds are rounded outward by one neighbour, in any rounding of the processor's that is
/// to nearest, and with or without contracted multiply-adds. What divides by 0, or overflows, ends
/// at ±∞. There is no `<`: what is not proved is not false. It is a number type of Eigen's matrices
/// and of the library's templates that need no order.
/// Source: IEEE 1788-2015 for the set that each operation encloses; the note of `rounding_of`.
class Enclosure {
 public:
  /// 0.
  Enclosure() = default;
  /// That double itself; implicit, as in formulas a double is such a number.
  Enclosure(double exact) : Enclosure(exact, exact) {}  // NOLINT(google-explicit-constructor)
  /// Between two doubles, lower ≤ upper; a NaN: nothing is known.
  Enclosure(double lower, double upper) : lower_(lower), upper_(upper) {
    if (!(lower <= upper)) *this = unknown();
  }

  /// The decimal number to which a double is nearest, whatever its further digits; 0 is exact.
  static Enclosure of_decimal(double nearest) {
    if (nearest == 0.0) return {};
    return {detail::rounded_down(nearest), detail::rounded_up(nearest)};
  }
  /// (−∞, ∞).
  static Enclosure unknown() {
    Enclosure all;
    all.lower_ = -std::numeric_limits<double>::infinity();
    all.upper_ = std::numeric_limits<double>::infinity();
    return all;
  }

  /// Not above the number.
  double lower() const { return lower_; }
  /// Not below the number.
  double upper() const { return upper_; }
  /// A double inside, next to the middle where both bounds are finite.
  double middle() const {
    const double half = 0.5 * lower_ + 0.5 * upper_;
    return half == half ? std::clamp(half, lower_, upper_) : 0.0;
  }
  /// At least the distance of every number inside from the middle.
  double radius() const {
    const double centre = middle();
    return detail::rounded_up(std::max(upper_ - centre, centre - lower_));
  }
  /// At least the modulus of every number inside.
  double magnitude() const { return std::max(std::abs(lower_), std::abs(upper_)); }
  /// Whether the number may be x.
  bool contains(double x) const { return lower_ <= x && x <= upper_; }
  /// The middle, for messages and checks of plausibility.
  explicit operator double() const { return middle(); }

  /// Whether it is proved that the number is > 0.
  bool is_positive() const { return lower_ > 0.0; }
  /// Whether it is proved that the number is < 0.
  bool is_negative() const { return upper_ < 0.0; }

  /// −a, exact.
  Enclosure operator-() const { return {-upper_, -lower_}; }
  /// a + b.
  Enclosure& operator+=(const Enclosure& b) { return *this = *this + b; }
  /// a − b.
  Enclosure& operator-=(const Enclosure& b) { return *this = *this - b; }
  /// a b.
  Enclosure& operator*=(const Enclosure& b) { return *this = *this * b; }
  /// a / b.
  Enclosure& operator/=(const Enclosure& b) { return *this = *this / b; }

  /// a + b.
  friend Enclosure operator+(const Enclosure& a, const Enclosure& b) {
    return {detail::rounded_down(a.lower_ + b.lower_), detail::rounded_up(a.upper_ + b.upper_)};
  }
  /// a − b.
  friend Enclosure operator-(const Enclosure& a, const Enclosure& b) { return a + (-b); }
  /// a b.
  friend Enclosure operator*(const Enclosure& a, const Enclosure& b) {
    return hull_of(a.lower_ * b.lower_, a.lower_ * b.upper_, a.upper_ * b.lower_,
                   a.upper_ * b.upper_);
  }
  /// a / b; unknown where b may be 0.
  friend Enclosure operator/(const Enclosure& a, const Enclosure& b) {
    if (b.contains(0.0)) return unknown();
    return hull_of(a.lower_ / b.lower_, a.lower_ / b.upper_, a.upper_ / b.lower_,
                   a.upper_ / b.upper_);
  }
  /// Whether the bounds are the same; two equal enclosures may be of different numbers.
  friend bool operator==(const Enclosure& a, const Enclosure& b) {
    return a.lower_ == b.lower_ && a.upper_ == b.upper_;
  }
  /// Other bounds.
  friend bool operator!=(const Enclosure& a, const Enclosure& b) { return !(a == b); }

  /// x².
  friend Enclosure square(const Enclosure& a) {
    const double most = a.magnitude();
    const double least = a.contains(0.0) ? 0.0 : std::min(std::abs(a.lower_), std::abs(a.upper_));
    return {std::max(detail::rounded_down(least * least), 0.0), detail::rounded_up(most * most)};
  }
  /// √a of what is not negative in a; unknown where all of it is.
  friend Enclosure sqrt(const Enclosure& a) {
    if (a.upper_ < 0.0) return unknown();
    const double least = std::sqrt(std::max(a.lower_, 0.0));
    return {std::max(detail::rounded_down(least), 0.0), detail::rounded_up(std::sqrt(a.upper_))};
  }
  /// |a|.
  friend Enclosure abs(const Enclosure& a) {
    if (a.contains(0.0)) return {0.0, a.magnitude()};
    return a.lower_ > 0.0 ? a : -a;
  }
  /// The numbers that are in both; nothing is known where that is none, for then a premiss is
  /// wrong.
  friend Enclosure intersection(const Enclosure& a, const Enclosure& b) {
    return {std::max(a.lower_, b.lower_), std::min(a.upper_, b.upper_)};
  }

 private:
  /// 0 · ∞ has no bound.
  static Enclosure hull_of(double a, double b, double c, double d) {
    if (!(a == a && b == b && c == c && d == d)) return unknown();
    return {detail::rounded_down(std::min({a, b, c, d})),
            detail::rounded_up(std::max({a, b, c, d}))};
  }

  double lower_ = 0.0, upper_ = 0.0;
};

/// π lies between two neighbours.
template <>
inline const Enclosure pi<Enclosure> = Enclosure(0x1.921fb54442d18p+1, 0x1.921fb54442d19p+1);

}  // namespace holdfast
