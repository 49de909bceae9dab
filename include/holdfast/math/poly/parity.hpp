#pragma once

#include <cmath>

#include "holdfast/math/poly/polynomial.hpp"

namespace holdfast {

namespace detail {

/// Coefficients of the even (parity 0) or odd (parity 1) part of a(iy) as a polynomial in Y = y².
template <class Scalar, int Size>
Vector<Scalar, 3> parity_part(const Vector<Scalar, Size>& a, int parity) {
  static_assert(Size == 5 || Size == 6, "the loop has 4 (continuous) or 5 (sampled) roots");
  Vector<Scalar, 3> part = Vector<Scalar, 3>::Zero();
  Scalar sign(1);
  for (int k = parity; k < Size; k += 2, sign = -sign) part[k / 2] = sign * a[k];
  return part;
}

/// Mean modulus of the roots, (|a₀| / |a_n|)^{1/n}: the unit in which w is of order one. 1 where it
/// has none.
template <class Scalar, int Size>
Scalar mean_root_modulus(const Vector<Scalar, Size>& a) {
  const Scalar modulus = std::pow(std::abs(a[0] / a[Size - 1]), Scalar(1) / Scalar(Size - 1));
  return std::isfinite(modulus) && modulus > Scalar(0) ? modulus : Scalar(1);
}

/// Coefficients of a(unit · w).
template <class Scalar, int Size>
Vector<Scalar, Size> rescaled(Vector<Scalar, Size> a, const Scalar& unit) {
  Scalar power(1);
  for (int k = 0; k < Size; ++k, power *= unit) a[k] *= power;
  return a;
}

/// The same polynomial with zeros for coefficients that are only round-off, w being measured in
/// `unit`: first and last below 1e−12 of the largest, which are small differences of large numbers
/// when sampling is fast, others below 1e−14.
template <class Scalar, int Size>
Vector<Scalar, Size> without_round_off(Vector<Scalar, Size> a, const Scalar& unit) {
  const Vector<Scalar, Size> size = rescaled<Scalar, Size>(a, unit).cwiseAbs();
  const Scalar largest = size.maxCoeff();
  for (int k = 0; k < Size; ++k) {
    const bool at_end = k == 0 || k == Size - 1;
    if (size[k] <= Scalar(at_end ? 1e-12 : 1e-14) * largest) a[k] = Scalar(0);
  }
  return a;
}

}  // namespace detail

/// A polynomial on the imaginary axis, a(iy) = even(Y) + iy odd(Y) with Y = y²; each part of degree
/// ≤ 2.
template <class Scalar>
struct ParityParts {
  Vector<Scalar, 3> even;  ///< a_e: coefficients of Y⁰, Y¹, Y²
  Vector<Scalar, 3> odd;   ///< a_o: likewise, of degree ≤ 1 in Y where a has degree 4

  /// @param a     degree 4 or 5, constant coefficient first
  /// @param unit  the modulus of w in which y is measured
  template <int Size>
  ParityParts(const Vector<Scalar, Size>& a, const Scalar& unit)
      : even(detail::parity_part<Scalar, Size>(detail::rescaled<Scalar, Size>(a, unit), 0)),
        odd(detail::parity_part<Scalar, Size>(detail::rescaled<Scalar, Size>(a, unit), 1)) {}
};

}  // namespace holdfast
