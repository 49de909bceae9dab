#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "holdfast/core/types.hpp"
#include "holdfast/math/enclosure/enclosed_exponential.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"

namespace holdfast {

namespace detail {

/// An upper bound of the exact value of a sum that was computed as x ≥ 0. The sum has up to ten
/// terms, each a product of up to four moduli; at most 20 roundings occurred.
inline double above_roundings(double x) { return rounded_up(x * (1.0 + 0x1.0p-48)); }

/// An approximation of |z| within a few rounding errors; up to 1.5 |z| if |z|² would underflow.
inline double rounded_modulus(const std::complex<double>& z) {
  const double x = std::abs(z.real()), y = std::abs(z.imag());
  const double most = std::max(x, y);
  return most < 1e-140 ? x + y : std::sqrt(x * x + y * y);
}

}  // namespace detail

/// A complex number proved to lie in a disc (complex interval arithmetic). The disc is given by its
/// centre and radius. Unlike a rectangle, a disc does not widen when it is multiplied by e^{iθ}.
///
/// Every operation gives a disc that contains the exact result for all numbers in the discs of its
/// arguments. The radius is infinite after an overflow or a division by a number that may be 0.
class ComplexEnclosure {
 public:
  /// Constructs the exact number 0.
  ComplexEnclosure() = default;
  /// Encloses a double exactly; implicit, so that doubles may be used in formulas.
  ComplexEnclosure(double exact) : centre_(exact) {}  // NOLINT(google-explicit-constructor)
  /// Constructs a disc. A centre that is not finite, or a negative or NaN radius, gives radius ∞.
  ComplexEnclosure(const std::complex<double>& centre, double radius)
      : centre_(centre), radius_(radius) {
    const bool known = std::isfinite(centre.real()) && std::isfinite(centre.imag());
    if (known && radius >= 0.0) return;
    centre_ = 0.0;
    radius_ = std::numeric_limits<double>::infinity();
  }
  /// Encloses all x + iy with x and y in two intervals; without y: y = 0, an implicit conversion.
  ComplexEnclosure(const Enclosure& x, const Enclosure& y = {})  // NOLINT(google-explicit-*)
      : ComplexEnclosure({x.middle(), y.middle()}, (Enclosure(x.radius()) + y.radius()).upper()) {}

  /// The centre of the disc.
  const std::complex<double>& middle() const { return centre_; }
  /// An upper bound of the distance of any number in the disc from the centre.
  double radius() const { return radius_; }
  /// An upper bound of the modulus of any number in the disc.
  double magnitude() const {
    return detail::above_roundings(detail::rounded_modulus(centre_) + radius_);
  }
  /// A lower bound of the modulus of any number in the disc.
  double least_modulus() const {
    const double modulus = detail::rounded_modulus(centre_);
    const double below = modulus * (1.0 - 0x1.0p-48) - detail::above_roundings(radius_);
    // Valid only where squares neither underflow nor overflow.
    return modulus > 2e-140 && modulus < 1e150 && below > 0.0 ? below : 0.0;
  }
  /// An interval that encloses the real part of the number.
  Enclosure real() const { return centre_.real() + Enclosure(-radius_, radius_); }
  /// An interval that encloses the imaginary part of the number.
  Enclosure imaginary() const { return centre_.imag() + Enclosure(-radius_, radius_); }

  /// The negative of this number; the disc does not widen.
  ComplexEnclosure operator-() const { return {-centre_, radius_}; }
  /// This number times the imaginary unit i; the disc does not widen.
  ComplexEnclosure times_i() const { return {{-centre_.imag(), centre_.real()}, radius_}; }
  /// Adds the complex number b.
  ComplexEnclosure& operator+=(const ComplexEnclosure& b) { return *this = *this + b; }
  /// Multiplies by the complex number b.
  ComplexEnclosure& operator*=(const ComplexEnclosure& b) { return *this = *this * b; }

  /// The sum a + b.
  friend ComplexEnclosure operator+(const ComplexEnclosure& a, const ComplexEnclosure& b) {
    const std::complex<double> sum = a.centre_ + b.centre_;
    return {sum, detail::above_roundings(a.radius_ + b.radius_ + unit * size(sum))};
  }
  /// The difference a − b.
  friend ComplexEnclosure operator-(const ComplexEnclosure& a, const ComplexEnclosure& b) {
    return a + (-b);
  }
  /// The product a b; the radius includes the rounding error of the product of the centres.
  friend ComplexEnclosure operator*(const ComplexEnclosure& a, const ComplexEnclosure& b) {
    const std::complex<double>&x = a.centre_, &y = b.centre_;
    const double of_x = detail::rounded_modulus(x), of_y = detail::rounded_modulus(y);
    const double radius = of_x * b.radius_ + of_y * a.radius_ + a.radius_ * b.radius_ +
                          2.5 * unit * (size(x) * size(y));
    return {{x.real() * y.real() - x.imag() * y.imag(), x.real() * y.imag() + x.imag() * y.real()},
            detail::above_roundings(radius) + least};
  }
  /// The quotient a / b; the radius is infinite if b may be 0.
  friend ComplexEnclosure operator/(const ComplexEnclosure& a, const ComplexEnclosure& b) {
    return a * inverse(b);
  }

  /// The complex conjugate of a; the disc does not widen.
  friend ComplexEnclosure conj(const ComplexEnclosure& a) {
    return {std::conj(a.centre_), a.radius_};
  }
  /// The reciprocal 1/a; radius ∞ if a may be 0. With a's centre c the result has the centre
  /// y ≈ 1/c and, as radius, a bound of |1/x − y| = |1 − x y|/|x| for all numbers x in a.
  friend ComplexEnclosure inverse(const ComplexEnclosure& a) {
    const double squared = std::norm(a.centre_);
    const ComplexEnclosure near(std::conj(a.centre_) / squared, 0.0);
    const ComplexEnclosure missing = ComplexEnclosure(1.0) - a * near;
    const Enclosure radius = Enclosure(missing.magnitude()) / a.least_modulus();
    return {near.centre_, radius.upper()};
  }

 private:
  static constexpr double unit = 0x1.0p-53;     // relative rounding error of a double
  static constexpr double least = 0x1.0p-1060;  // above the underflow error of products

  static double size(const std::complex<double>& z) {
    return std::abs(z.real()) + std::abs(z.imag());
  }

  std::complex<double> centre_ = 0.0;
  double radius_ = 0.0;
};

/// A disc that encloses e^z for all numbers z in a disc.
/// @param z  disc with centre x + iy. The result has the radius ∞ if the radius of z is ≥ 1 or
///           |x| + |y| ≥ 10⁶
inline ComplexEnclosure exponential(const ComplexEnclosure& z) {
  const double x = z.middle().real(), y = z.middle().imag();
  Matrix<Enclosure, 2> turning;
  turning << x, -y, y, x;
  const Matrix<Enclosure, 2> power = exponential(turning);
  // |e^w − 1| ≤ |w|/(1 − |w|).
  const Enclosure left = Enclosure(1.0) - z.radius();
  const Enclosure around = left.is_positive() ? z.radius() / left : Enclosure::unknown();
  return ComplexEnclosure(power(0, 0), power(1, 0)) * ComplexEnclosure({1.0, 0.0}, around.upper());
}

/// A disc that encloses the powers zⁿ of all numbers z in a disc.
/// @param z      disc
/// @param count  exponent n ≥ 0
inline ComplexEnclosure power(ComplexEnclosure z, int count) {
  ComplexEnclosure result(1.0);
  for (; count > 0; count /= 2) {
    if (count % 2 == 1) result *= z;
    if (count > 1) z *= z;
  }
  return result;
}

}  // namespace holdfast
