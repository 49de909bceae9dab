#pragma once

#include <limits>

#include "holdfast/core/types.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"
#include "holdfast/math/linalg/balancing.hpp"

namespace holdfast {

namespace detail {

/// An upper bound of the norm ‖M‖∞ of every matrix in an enclosure.
template <int Rows, int Columns>
double norm_bound(const Matrix<Enclosure, Rows, Columns>& matrix) {
  double norm = 0.0;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Enclosure sum;
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) sum += matrix(i, j).magnitude();
    norm = sum.upper() > norm ? sum.upper() : norm;  // a NaN does not arise
  }
  return norm;
}

/// The interval matrix, order × order, with every entry equal to [−bound, bound].
template <int Size>
Matrix<Enclosure, Size> ball(Eigen::Index order, double bound) {
  return Matrix<Enclosure, Size>::Constant(order, order, Enclosure(-bound, bound));
}

/// The exponential e^X of every enclosed matrix with ‖X‖∞ ≤ 1/2: Taylor polynomial and remainder,
///
///     ‖e^X − Σ_{k ≤ m} Xᵏ/k!‖ ≤ ‖X‖^{m+1}/(m+1)! / (1 − ‖X‖/(m+2))
///
/// @param norm   bound of ‖X‖
/// @param terms  degree m of the polynomial
template <int Size>
Matrix<Enclosure, Size> exponential_series(const Matrix<Enclosure, Size>& matrix, double norm,
                                           int terms) {
  const Eigen::Index n = matrix.rows();
  // Horner's rule: I + X (I + X/2 (I + X/3 …)).
  const Matrix<Enclosure, Size> identity = Matrix<Enclosure, Size>::Identity(n, n);
  Matrix<Enclosure, Size> sum = identity;
  for (int k = terms; k > 0; --k) sum = identity + (matrix * sum).eval() / Enclosure(double(k));
  Enclosure rest(1.0);
  for (int k = 1; k <= terms + 1; ++k) rest *= Enclosure(norm) / Enclosure(double(k));
  rest /= Enclosure(1.0) - Enclosure(norm) / Enclosure(double(terms + 2));
  return sum + ball<Size>(n, rest.upper());
}

/// The exponential e^M, from the series of M/2^s (norm ≤ 1/2) by s squarings; `norm` bounds ‖M‖.
template <int Size>
Matrix<Enclosure, Size> exponential_by_squarings(Matrix<Enclosure, Size> matrix, double norm) {
  int squarings = 0;
  for (; norm > 0.5; norm *= 0.5, ++squarings) matrix *= Enclosure(0.5);
  constexpr int terms = 20;  // the last terms are below the rounding error of the first
  Matrix<Enclosure, Size> power = exponential_series(matrix, norm, terms);
  for (; squarings > 0; --squarings) power = (power * power).eval();
  return power;
}

}  // namespace detail

/// An interval matrix that encloses e^M for all matrices M in an interval matrix. Taylor's series
/// of the balanced M/2ˢ is squared s times; each squaring widens it. Work: 20 + s matrix products.
/// @param matrix  square interval matrix; if ‖M‖∞ may be ≥ 10⁶, all entries returned are (−∞, ∞)
template <int Size>
Matrix<Enclosure, Size> exponential(const Matrix<Enclosure, Size>& matrix) {
  if (!(detail::norm_bound(matrix) < 1e6))
    return detail::ball<Size>(matrix.rows(), std::numeric_limits<double>::infinity());
  const Matrix<double, Size> sizes =
      matrix.unaryExpr([](const Enclosure& entry) { return entry.magnitude(); });
  const Vector<Enclosure, Size> scales = balancing(sizes).template cast<Enclosure>();
  const Vector<Enclosure, Size> inverse =
      scales.unaryExpr([](const Enclosure& scale) { return Enclosure(1.0 / scale.middle()); });
  const Matrix<Enclosure, Size> balanced = inverse.asDiagonal() * matrix * scales.asDiagonal();
  const double norm = detail::norm_bound(balanced);
  return scales.asDiagonal() * detail::exponential_by_squarings<Size>(balanced, norm) *
         inverse.asDiagonal();
}

}  // namespace holdfast
