#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <vector>

#include "holdfast/core/types.hpp"

namespace holdfast {

/// The coefficients c₀ … c_n of a polynomial p(x) = c₀ + c₁ x + … + c_n xⁿ, constant term first.
template <class Scalar, int Degree>
using Polynomial = Vector<Scalar, Degree + 1>;

/// The value p(x) of a polynomial by Horner's rule. x may be complex even if the coefficients are
/// real. Work: one multiply-add per degree.
template <class Coefficients, class Point>
Point evaluate(const Eigen::MatrixBase<Coefficients>& polynomial, const Point& x) {
  Point value = Point(polynomial[polynomial.size() - 1]);
  for (Eigen::Index k = polynomial.size() - 2; k >= 0; --k)
    value = value * x + Point(polynomial[k]);
  return value;
}

/// The coefficients of the product of two polynomials; the degree is the sum of their degrees.
template <class Scalar, int DegreePlusOneA, int DegreePlusOneB>
Vector<Scalar, DegreePlusOneA + DegreePlusOneB - 1> multiply(
    const Vector<Scalar, DegreePlusOneA>& a, const Vector<Scalar, DegreePlusOneB>& b) {
  Vector<Scalar, DegreePlusOneA + DegreePlusOneB - 1> product;
  product.setZero();
  for (int i = 0; i < DegreePlusOneA; ++i) {
    for (int j = 0; j < DegreePlusOneB; ++j) product[i + j] += a[i] * b[j];
  }
  return product;
}

/// The coefficients of the derivative p′(x) of a polynomial of degree 1 or more.
template <class Scalar, int Size>
Vector<Scalar, Size - 1> derivative(const Vector<Scalar, Size>& polynomial) {
  Vector<Scalar, Size - 1> result;
  for (int k = 1; k < Size; ++k) result[k - 1] = Scalar(k) * polynomial[k];
  return result;
}

/// The coefficients of p(x + h) in powers of x (Taylor shift), with h = `by`.
template <class Coefficients>
Coefficients shifted(Coefficients p, const typename Coefficients::Scalar& by) {
  for (Eigen::Index start = 0; start + 1 < p.size(); ++start)
    for (Eigen::Index k = p.size() - 2; k >= start; --k) p[k] += by * p[k + 1];
  return p;
}

/// The coefficients of p(u x) in powers of x, with the scale factor u = `unit`.
template <class Coefficients>
Coefficients rescaled(Coefficients p, const typename Coefficients::Scalar& unit) {
  typename Coefficients::Scalar power(1);
  for (Eigen::Index k = 0; k < p.size(); ++k, power *= unit) p[k] *= power;
  return p;
}

namespace detail {

/// The product a b by the plain formula, faster than std::complex's, which also treats infinities.
template <class Scalar>
std::complex<Scalar> plain_product(const std::complex<Scalar>& a, const std::complex<Scalar>& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// The reciprocal 1/z by the plain formula, for moduli near one; infinities are not treated.
template <class Scalar>
std::complex<Scalar> inverse(const std::complex<Scalar>& z) {
  return std::conj(z) / std::norm(z);
}

/// The Newton step p(x)/p′(x), with a flag whether p(x) is within its rounding error.
template <class Scalar>
struct NewtonStep {
  std::complex<Scalar> ratio;
  bool converged;
};

template <class Scalar>
NewtonStep<Scalar> newton_step(const std::vector<Scalar>& coefficients,
                               const std::complex<Scalar>& x) {
  std::complex<Scalar> value(0), slope(0);
  Scalar magnitude(0);
  const Scalar modulus = std::sqrt(std::norm(x));
  for (std::size_t k = coefficients.size(); k-- > 0;) {
    slope = plain_product(slope, x) + value;
    value = plain_product(value, x) + coefficients[k];
    magnitude = magnitude * modulus + std::abs(coefficients[k]);
  }
  const Scalar rounding = std::numeric_limits<Scalar>::epsilon() * magnitude;
  return {plain_product(value, inverse(slope)), std::norm(value) <= rounding * rounding};
}

/// Applies one Aberth step to each root in turn. @return whether all roots have converged
template <class Scalar>
bool aberth_sweep(const std::vector<Scalar>& coefficients,
                  std::vector<std::complex<Scalar>>& roots) {
  bool settled = true;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const auto newton = newton_step(coefficients, roots[i]);
    std::complex<Scalar> repulsion(0);
    for (std::size_t j = 0; j < roots.size(); ++j) {
      if (j != i) repulsion += inverse(std::complex<Scalar>(roots[i] - roots[j]));
    }
    const std::complex<Scalar> correction =
        plain_product(newton.ratio, inverse(Scalar(1) - plain_product(newton.ratio, repulsion)));
    const bool finite = std::isfinite(correction.real()) && std::isfinite(correction.imag());
    if (finite) roots[i] -= correction;
    settled = settled && (newton.converged || !finite);
  }
  return settled;
}

/// The starting points for roots of moduli near one: on the unit circle, no two conjugate.
template <class Scalar>
std::vector<std::complex<Scalar>> spread_circle(std::size_t count) {
  std::vector<std::complex<Scalar>> points;
  for (std::size_t k = 0; k < count; ++k) {
    const Scalar angle = Scalar(2) * pi<Scalar> * Scalar(static_cast<double>(k)) /
                             Scalar(static_cast<double>(count)) +
                         Scalar(0.4);
    points.push_back(std::polar(Scalar(1), angle));
  }
  return points;
}

}  // namespace detail

/// All roots of a real polynomial of low degree, by the Aberth–Ehrlich iteration.
///
/// Highest and lowest coefficients are treated as zero if their modulus is at most `negligible` ≥ 0
/// times the largest modulus. Each zero highest coefficient means a root at ∞, which is left out;
/// each zero lowest one means a root 0, which is returned. The iteration ends when the polynomial
/// is zero within rounding at every root, or after 200 sweeps. The result is empty for a constant.
/// Source: O. Aberth, Iteration methods for finding all zeros of a polynomial simultaneously, 1973.
template <class Coefficients>
std::vector<std::complex<typename Coefficients::Scalar>> roots(
    const Eigen::MatrixBase<Coefficients>& polynomial,
    typename Coefficients::Scalar negligible = typename Coefficients::Scalar(0)) {
  using Scalar = typename Coefficients::Scalar;
  const Scalar threshold = negligible * polynomial.cwiseAbs().maxCoeff();
  Eigen::Index last = polynomial.size() - 1, first = 0;
  while (last > 0 && std::abs(polynomial[last]) <= threshold) --last;
  while (first < last && std::abs(polynomial[first]) <= threshold) ++first;
  std::vector<std::complex<Scalar>> result(static_cast<std::size_t>(first),
                                           std::complex<Scalar>(0));
  if (last == first) return result;

  const Scalar unit = std::pow(std::abs(polynomial[first] / polynomial[last]),
                               Scalar(1) / Scalar(static_cast<double>(last - first)));
  std::vector<Scalar> scaled;
  Scalar power(1);
  for (Eigen::Index k = first; k <= last; ++k, power *= unit)
    scaled.push_back(polynomial[k] * power);
  auto found = detail::spread_circle<Scalar>(scaled.size() - 1);
  for (int sweep = 0; sweep < 200 && !detail::aberth_sweep(scaled, found); ++sweep) {
  }
  for (const std::complex<Scalar>& root : found) result.push_back(unit * root);
  return result;
}

/// The positive real roots of a real polynomial of low degree, ascending, each as often as its
/// multiplicity. Round-off may split a double root into a complex pair near the real axis.
/// @param polynomial  coefficients, constant term first
/// @param split       largest ratio |Im x/Re x| of a pair x, x̄ that counts as a double root Re x
template <class Coefficients>
std::vector<typename Coefficients::Scalar> positive_roots(
    const Eigen::MatrixBase<Coefficients>& polynomial, double split = 1e-5) {
  using Scalar = typename Coefficients::Scalar;
  std::vector<Scalar> result;
  for (const auto& root : roots(polynomial)) {
    const bool real = std::abs(root.imag()) <= Scalar(split) * std::abs(root.real());
    if (root.real() > Scalar(0) && real) result.push_back(root.real());
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// The number of roots with positive real part, found by computing all roots. For a polynomial from
/// in_half_plane() it is the number of roots |λ| > 1 of the original polynomial.
/// @param polynomial  coefficients, constant term first
template <class Coefficients>
int unstable_roots(const Eigen::MatrixBase<Coefficients>& polynomial) {
  using Scalar = typename Coefficients::Scalar;
  int count = 0;
  for (const auto& root : roots(polynomial)) count += root.real() > Scalar(0) ? 1 : 0;
  return count;
}

/// The coefficients of the quotient p(x)/(x − root), without remainder; the last entry is 0.
template <class Scalar, int Size>
Vector<Scalar, Size> without_root(const Vector<Scalar, Size>& polynomial, const Scalar& root) {
  Vector<Scalar, Size> quotient = Vector<Scalar, Size>::Zero();
  for (int k = Size - 2; k >= 0; --k) quotient[k] = polynomial[k + 1] + root * quotient[k + 1];
  return quotient;
}

namespace detail {

/// The coefficients of the even (parity 0) or odd (parity 1) part of a(iy), in powers of Y = y².
template <class Scalar, int Size>
Vector<Scalar, 3> parity_part(const Vector<Scalar, Size>& a, int parity) {
  static_assert(Size == 5 || Size == 6, "a must have 5 or 6 coefficients (4 or 5 roots)");
  Vector<Scalar, 3> part = Vector<Scalar, 3>::Zero();
  Scalar sign(1);
  for (int k = parity; k < Size; k += 2, sign = -sign) part[k / 2] = sign * a[k];
  return part;
}

/// The geometric mean (|a₀| / |a_n|)^{1/n} of the moduli of all roots w; 1 if this mean is 0 or not
/// finite. In this unit the roots are of order one.
template <class Scalar, int Size>
Scalar mean_root_modulus(const Vector<Scalar, Size>& a) {
  const Scalar modulus = std::pow(std::abs(a[0] / a[Size - 1]), Scalar(1) / Scalar(Size - 1));
  return std::isfinite(modulus) && modulus > Scalar(0) ? modulus : Scalar(1);
}

/// Replaces coefficients at round-off level by zeros. They are compared with w in units of `unit`;
/// the limit is 1e−14 of the largest. For the first and the last coefficient it is 1e−12, since
/// with fast sampling both are small differences of large numbers.
template <class Scalar, int Size>
Vector<Scalar, Size> without_round_off(Vector<Scalar, Size> a, const Scalar& unit) {
  const Vector<Scalar, Size> size = rescaled(a, unit).cwiseAbs();
  const Scalar largest = size.maxCoeff();
  for (int k = 0; k < Size; ++k) {
    const bool at_end = k == 0 || k == Size - 1;
    if (size[k] <= Scalar(at_end ? 1e-12 : 1e-14) * largest) a[k] = Scalar(0);
  }
  return a;
}

}  // namespace detail

/// Even and odd part of a polynomial a(x) of degree 4 or 5 on the imaginary axis x = iy, y real:
/// a(iy) = even(Y) + iy odd(Y) with Y = y². Both parts are real if the coefficients of a are.
template <class Scalar>
struct ParityParts {
  Vector<Scalar, 3> even;  ///< coefficients of Y⁰, Y¹, Y² in even(Y)
  Vector<Scalar, 3> odd;  ///< coefficients of Y⁰, Y¹, Y² in odd(Y); of Y²: 0 if a has degree 4

  /// @param a     polynomial of degree 4 or 5, constant coefficient first
  /// @param unit  scale factor u > 0 of y: the polynomial a(i u y) is split instead of a(i y)
  template <int Size>
  ParityParts(const Vector<Scalar, Size>& a, const Scalar& unit)
      : even(detail::parity_part<Scalar, Size>(rescaled(a, unit), 0)),
        odd(detail::parity_part<Scalar, Size>(rescaled(a, unit), 1)) {}
};

/// The Möbius–Zhukovsky transform q(w) of a polynomial p(μ) of degree n, μ = λ − 1:
///
///     λ = (1 + w) / (1 − w),   μ = 2w / (1 − w),   q(w) = (1 − w)ⁿ p(2w / (1 − w))
///
/// The disc |λ| < 1 becomes the half-plane Re w < 0; hence all |λ| < 1 if q is a Hurwitz
/// polynomial. A root λ = +1 gives q₀ = 0, a root λ = −1 (w = ∞) gives q_n = 0, and a complex pair
/// |λ| = 1 gives the Hurwitz determinant H_{n−1} = 0. Source: Kollár 2022, §4.1, for n = 4.
/// @param in_powers_of_mu  coefficients of p, constant term first
/// @return coefficients of q, constant term first; q has the degree of p
template <class Scalar, int Size>
Vector<Scalar, Size> in_half_plane(const Vector<Scalar, Size>& in_powers_of_mu) {
  Vector<Scalar, Size> result = Vector<Scalar, Size>::Zero();
  // Horner's rule in the homogeneous pair (2w, 1 − w): result ← result · 2w + p_k (1 − w)^{n−k}.
  Vector<Scalar, Size> power = Vector<Scalar, Size>::Unit(0);
  for (int k = Size - 1; k >= 0; --k) {
    for (int j = Size - 1; j > 0; --j) result[j] = Scalar(2) * result[j - 1];
    result[0] = Scalar(0);
    result += in_powers_of_mu[k] * power;
    for (int j = Size - 1; j > 0; --j) power[j] -= power[j - 1];
  }
  return result;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template std::vector<std::complex<double>> roots(
    const Eigen::MatrixBase<Polynomial<double, 2>>&, double);
extern template std::vector<std::complex<double>> roots(
    const Eigen::MatrixBase<Polynomial<double, 4>>&, double);
extern template std::vector<std::complex<double>> roots(
    const Eigen::MatrixBase<Polynomial<double, 5>>&, double);
#endif

}  // namespace holdfast
