#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <vector>

#include "holdfast/core/types.hpp"

namespace holdfast {

/// Coefficients of p(x) = c₀ + c₁ x + … + c_n xⁿ, constant term first.
template <class Scalar, int Degree>
using Polynomial = Vector<Scalar, Degree + 1>;

/// p(x) by Horner's rule: `degree` multiply-adds. `Point` may be complex where the coefficients are
/// real.
template <class Coefficients, class Point>
Point evaluate(const Eigen::MatrixBase<Coefficients>& polynomial, const Point& x) {
  Point value = Point(polynomial[polynomial.size() - 1]);
  for (Eigen::Index k = polynomial.size() - 2; k >= 0; --k)
    value = value * x + Point(polynomial[k]);
  return value;
}

/// Product of two polynomials; the degrees add.
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

/// p′(x); a constant has none.
template <class Scalar, int Size>
Vector<Scalar, Size - 1> derivative(const Vector<Scalar, Size>& polynomial) {
  Vector<Scalar, Size - 1> result;
  for (int k = 1; k < Size; ++k) result[k - 1] = Scalar(k) * polynomial[k];
  return result;
}

namespace detail {

/// a b without the standard's care for infinities, which costs several times the product.
template <class Scalar>
std::complex<Scalar> plain_product(const std::complex<Scalar>& a, const std::complex<Scalar>& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// 1 / z, likewise; the roots are scaled to moduli about one.
template <class Scalar>
std::complex<Scalar> inverse(const std::complex<Scalar>& z) {
  return std::conj(z) / std::norm(z);
}

/// p(x) / p′(x) and whether p(x) is down to its rounding error.
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

/// Moves all approximations once, Gauss–Seidel fashion; true when none moved any more.
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

/// Starting points of moduli about that of the roots, spread so that no symmetry can hold them.
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
/// Coefficients at either end that are at most `negligible` times the largest are dropped: leading
/// ones are roots at infinity, which do not return; trailing ones are roots at zero, which do. The
/// rest is scaled to roots of geometric mean one and iterated until each value is down to its
/// rounding error. Any number type with the elementary functions will do. A polynomial without a
/// root (constant, or all zero) returns none. Source: O. Aberth, Iteration methods for finding all
/// zeros of a polynomial simultaneously, 1973.
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

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template std::vector<std::complex<double>> roots(
    const Eigen::MatrixBase<Polynomial<double, 2>>&, double);
extern template std::vector<std::complex<double>> roots(
    const Eigen::MatrixBase<Polynomial<double, 4>>&, double);
extern template std::vector<std::complex<double>> roots(
    const Eigen::MatrixBase<Polynomial<double, 5>>&, double);
#endif

}  // namespace holdfast
