#pragma once

#include <cmath>
#include <complex>
#include <limits>
#include <utility>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

namespace detail {

/// The size |x| by which pivots are compared, for ordered numbers.
template <class Scalar>
Scalar pivot_size(const Scalar& x) {
  return x < Scalar(0) ? Scalar(-x) : x;
}

/// The squared modulus |z|², by which complex pivots are compared without a square root.
template <class Scalar>
Scalar pivot_size(const std::complex<Scalar>& z) {
  return std::norm(z);
}

}  // namespace detail

/// The solution X of M X = B by Gaussian elimination with row exchanges. The entries may be real or
/// complex, or of any type with the four operations and a comparison, such as dual numbers.
///
/// The function is for small systems and compiles faster than Eigen's decompositions. Work: n³/3 +
/// n² c multiply-adds.
/// @param matrix  matrix M, n × n; if it is singular, the result is not finite
/// @param right   right side B, n × c
/// @throws InvalidParameter where the sizes disagree
template <class Square, class Columns>
Columns eliminated(Square matrix, Columns right) {
  using Scalar = typename Square::Scalar;
  const Eigen::Index n = matrix.rows(), columns = right.cols();
  require_size("columns of a square matrix", matrix.cols(), n);
  require_size("rows of the right-hand side", right.rows(), n);
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::Index pivot = k;
    for (Eigen::Index i = k + 1; i < n; ++i) {
      if (detail::pivot_size(matrix(i, k)) > detail::pivot_size(matrix(pivot, k))) pivot = i;
    }
    for (Eigen::Index j = k; j < n && pivot != k; ++j) std::swap(matrix(k, j), matrix(pivot, j));
    for (Eigen::Index j = 0; j < columns && pivot != k; ++j)
      std::swap(right(k, j), right(pivot, j));
    const Scalar inverse = Scalar(1) / matrix(k, k);
    for (Eigen::Index i = k + 1; i < n; ++i) matrix(i, k) *= inverse;
    for (Eigen::Index j = k + 1; j < n; ++j) {
      for (Eigen::Index i = k + 1; i < n; ++i) matrix(i, j) -= matrix(i, k) * matrix(k, j);
    }
    for (Eigen::Index j = 0; j < columns; ++j) {
      for (Eigen::Index i = k + 1; i < n; ++i) right(i, j) -= matrix(i, k) * right(k, j);
    }
  }
  for (Eigen::Index j = 0; j < columns; ++j) {
    for (Eigen::Index k = n - 1; k >= 0; --k) {
      right(k, j) /= matrix(k, k);
      for (Eigen::Index i = 0; i < k; ++i) right(i, j) -= matrix(i, k) * right(k, j);
    }
  }
  return right;
}

/// The derivative λ′ = tr(R M′)/tr R of an eigenvalue λ of a matrix M with respect to a parameter.
/// R = (νI − M)⁻¹ is the resolvent at ν = λ (1 + √ε); ε is the number type's relative precision. R
/// is almost a multiple of the projector on the eigenvectors of λ. For a multiple eigenvalue the
/// result is the mean of the derivatives. Relative accuracy: 10⁻⁸ in `double`. Work: one inverse.
/// @param matrix  matrix M, n × n
/// @param rate    derivative M′ of M with respect to the parameter, n × n
/// @param value   eigenvalue λ ≠ 0
/// @return        derivative λ′; NaN, infinite or meaningless for λ = 0
/// @throws InvalidParameter where M is not square, or M′ has another size
template <class Scalar>
std::complex<Scalar> eigenvalue_derivative(const Matrix<Scalar, Eigen::Dynamic>& matrix,
                                           const Matrix<Scalar, Eigen::Dynamic>& rate,
                                           const std::complex<Scalar>& value) {
  using Complex = std::complex<Scalar>;
  require_size("columns of a square matrix", matrix.cols(), matrix.rows());
  require_size("rows of the derivative of a matrix", rate.rows(), matrix.rows());
  require_size("columns of the derivative of a matrix", rate.cols(), matrix.rows());
  Matrix<Complex, Eigen::Dynamic> shifted = -matrix.template cast<Complex>();
  shifted.diagonal().array() +=
      value * (Scalar(1) + std::sqrt(std::numeric_limits<Scalar>::epsilon()));
  const Matrix<Complex, Eigen::Dynamic> resolvent = eliminated(
      shifted, Matrix<Complex, Eigen::Dynamic>(shifted.Identity(shifted.rows(), shifted.cols())));
  return resolvent.transpose().cwiseProduct(rate.template cast<Complex>()).sum() /
         resolvent.trace();
}

}  // namespace holdfast
