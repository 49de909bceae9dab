#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "holdfast/core/types.hpp"

namespace holdfast {

namespace detail {

/// The Householder reflection H = I − τ v vᵀ of the last rows of a matrix. It maps the entries of
/// one column in these rows to β e₁, where |β| is the Euclidean norm of these entries.
///
/// The reflection is applied column by column. For small matrices this is faster than Eigen's
/// blocks, compiles in a twentieth of the time, and avoids the SIMD packets that GCC 12 reports as
/// reads out of bounds. Source: A. S. Householder, J. ACM 5 (1958).
template <class Any>
class Reflection {
 public:
  using Scalar = typename Any::Scalar;

  /// Constructs the reflection of a column. @param first  first of the reflected rows
  Reflection(Any& matrix, Eigen::Index first, Eigen::Index column)
      : first_(first), direction_(matrix.rows() - first) {
    Scalar below(0);
    for (Eigen::Index i = 0; i < direction_.size(); ++i) direction_[i] = matrix(first + i, column);
    for (Eigen::Index i = 1; i < direction_.size(); ++i) below += direction_[i] * direction_[i];
    for (Eigen::Index i = 1; i < direction_.size(); ++i) matrix(first + i, column) = 0;
    if (!(below > std::numeric_limits<Scalar>::min())) return;
    const Scalar length = std::sqrt(direction_[0] * direction_[0] + below);
    // The sign opposite to x₀ avoids cancellation in v₀.
    matrix(first, column) = direction_[0] < Scalar(0) ? length : -length;
    direction_[0] -= matrix(first, column);
    factor_ = -Scalar(1) / (matrix(first, column) * direction_[0]);
  }

  /// Replaces a matrix M by H M in column `column` and all later columns.
  template <class Square>
  void reflect_columns(Square& matrix, Eigen::Index column) const {
    if (factor_ == Scalar(0)) return;
    for (Eigen::Index j = column; j < matrix.cols(); ++j) {
      Scalar along(0);
      for (Eigen::Index i = 0; i < direction_.size(); ++i)
        along += direction_[i] * matrix(first_ + i, j);
      along *= factor_;
      for (Eigen::Index i = 0; i < direction_.size(); ++i)
        matrix(first_ + i, j) -= along * direction_[i];
    }
  }

  /// Replaces a matrix M by M H; M has as many columns as the reflected matrix has rows.
  template <class Square>
  void reflect_rows(Square& matrix) const {
    using Column = Vector<Scalar, Square::RowsAtCompileTime>;
    if (factor_ == Scalar(0)) return;
    Column along = Column::Zero(matrix.rows());
    for (Eigen::Index i = 0; i < direction_.size(); ++i)
      along += direction_[i] * matrix.col(first_ + i);
    for (Eigen::Index i = 0; i < direction_.size(); ++i)
      matrix.col(first_ + i) -= (factor_ * direction_[i]) * along;
  }

 private:
  Eigen::Index first_;
  Eigen::Matrix<Scalar, Eigen::Dynamic, 1, 0, Any::MaxRowsAtCompileTime, 1> direction_;  // v
  Scalar factor_ = 0;  // τ; 0: H = I
};

}  // namespace detail

/// Replaces a matrix A by the upper triangular R = QᵀA, and B by QᵀB, with Q orthogonal.
///
/// The method, Householder reflections without column pivoting, is backward stable for matrices of
/// any rank. Work: 2 n m² + 4 n m c operations.
/// @param matrix  matrix A, n × m with n ≥ m, finite; replaced by R
/// @param others  matrix B, n × c; replaced by QᵀB
template <class Tall, class Others>
void reflect_to_triangle(Tall& matrix, Others& others) {
  for (Eigen::Index k = 0; k < matrix.cols() && k + 1 < matrix.rows(); ++k) {
    const detail::Reflection<Tall> reflection(matrix, k, k);
    reflection.reflect_columns(matrix, k + 1);
    reflection.reflect_columns(others, 0);
  }
}

/// Replaces a square matrix A by the upper triangular R of A = Q R. @return orthogonal matrix Q
template <class Square>
Square orthogonal_factor(Square& matrix) {
  Square transposed = Square::Identity(matrix.rows(), matrix.rows());
  reflect_to_triangle(matrix, transposed);
  return transposed.transpose();
}

/// The Hessenberg form M = Q H Qᵀ of a matrix M, with H zero below the subdiagonal, Q orthogonal.
/// @tparam Square  type of M, a square matrix of fixed, bounded or dynamic size
template <class Square>
struct HessenbergForm {
  Square form;   ///< Hessenberg matrix H
  Square basis;  ///< orthogonal matrix Q; the unit matrix if Q was not requested

  /// @param matrix      matrix M, finite
  /// @param with_basis  whether Q is computed too; without Q the work is about a third less
  explicit HessenbergForm(const Square& matrix, bool with_basis = true)
      : form(matrix), basis(Square::Identity(matrix.rows(), matrix.rows())) {
    for (Eigen::Index k = 0; k + 2 < matrix.rows(); ++k) {
      const detail::Reflection<Square> reflection(form, k + 1, k);
      reflection.reflect_columns(form, k + 1);
      reflection.reflect_rows(form);
      if (with_basis) reflection.reflect_rows(basis);
    }
  }
};

}  // namespace holdfast
