#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "holdfast/core/types.hpp"

namespace holdfast {

namespace detail {

/// Householder's reflection H = I − τ v vᵀ that takes a column x to β e₁, |β| = ‖x‖.
///
/// It goes column by column: of small matrices twice as fast as by blocks, and compiled in a
/// twentieth of the time. Source: A. S. Householder, J. ACM 5 (1958).
/// @tparam Column  of x and v
template <class Column>
class Reflection {
 public:
  using Scalar = typename Column::Scalar;

  /// @param column  x, of one number at least, finite
  explicit Reflection(const Column& column) : direction_(column), first_(column[0]) {
    const Scalar below = column.tail(column.size() - 1).squaredNorm();
    if (!(below > std::numeric_limits<Scalar>::min())) return;
    const Scalar length = std::sqrt(first_ * first_ + below);
    first_ = first_ < Scalar(0) ? length : -length;  // away from x₀: nothing cancels in v₀
    direction_[0] -= first_;
    factor_ = -Scalar(1) / (first_ * direction_[0]);
  }

  /// β.
  Scalar first() const { return first_; }

  /// The columns of M from `column` on ← H M, in the last rows.
  template <class Square>
  void reflect_columns(Square& matrix, Eigen::Index column) const {
    if (factor_ == Scalar(0)) return;
    for (Eigen::Index j = column; j < matrix.cols(); ++j) {
      auto part = matrix.col(j).tail(direction_.size());
      part -= (factor_ * direction_.dot(part)) * direction_;
    }
  }

  /// M ← M H, in the last columns.
  template <class Square>
  void reflect_rows(Square& matrix) const {
    if (factor_ == Scalar(0)) return;
    const Eigen::Index before = matrix.cols() - direction_.size();
    Vector<Scalar, Square::RowsAtCompileTime> along =
        Vector<Scalar, Square::RowsAtCompileTime>::Zero(matrix.rows());
    for (Eigen::Index i = 0; i < direction_.size(); ++i)
      along += direction_[i] * matrix.col(before + i);
    for (Eigen::Index i = 0; i < direction_.size(); ++i)
      matrix.col(before + i) -= (factor_ * direction_[i]) * along;
  }

 private:
  Column direction_;           // v
  Scalar first_, factor_ = 0;  // β, τ; τ = 0: H = I
};

/// The lower part of a column of a matrix, of bounded length where the matrix is.
template <class Any>
using LowerPart =
    Eigen::Matrix<typename Any::Scalar, Eigen::Dynamic, 1, 0, Any::MaxRowsAtCompileTime, 1>;

}  // namespace detail

/// A ← R = QᵀA with R upper triangular, and B ← QᵀB, of orthogonal Q.
///
/// Backward stable, of matrices of any rank; |R_ii| need not fall. Work: 2 n m² for A of n × m and
/// 4 n m c for c columns of B.
/// @param matrix  A, finite, at least as many rows as columns
/// @param others  B, as many rows as A
template <class Tall, class Others>
void reflect_to_triangle(Tall& matrix, Others& others) {
  const Eigen::Index rows = matrix.rows();
  for (Eigen::Index k = 0; k < matrix.cols() && k + 1 < rows; ++k) {
    const detail::Reflection<detail::LowerPart<Tall>> reflection(matrix.col(k).tail(rows - k));
    reflection.reflect_columns(matrix, k + 1);
    reflection.reflect_columns(others, 0);
    matrix(k, k) = reflection.first();
    matrix.col(k).tail(rows - k - 1).setZero();
  }
}

/// A ← R as above. @return Q, with A = Q R
template <class Square>
Square orthogonal_factor(Square& matrix) {
  Square transposed = Square::Identity(matrix.rows(), matrix.rows());
  reflect_to_triangle(matrix, transposed);
  return transposed.transpose();
}

/// M = Q H Qᵀ with H zero below the diagonal beside the main one, and Q orthogonal.
/// @tparam Square  a square matrix of fixed, bounded or dynamic size
template <class Square>
struct HessenbergForm {
  Square form;   ///< H
  Square basis;  ///< Q; I where it is not wanted

  /// @param matrix      M, finite
  /// @param with_basis  whether Q is wanted, a third of the work
  explicit HessenbergForm(const Square& matrix, bool with_basis = true)
      : form(matrix), basis(Square::Identity(matrix.rows(), matrix.rows())) {
    const Eigen::Index rows = matrix.rows();
    for (Eigen::Index k = 0; k + 2 < rows; ++k) {
      const detail::Reflection<detail::LowerPart<Square>> reflection(
          form.col(k).tail(rows - k - 1));
      reflection.reflect_columns(form, k + 1);
      form(k + 1, k) = reflection.first();
      form.col(k).tail(rows - k - 2).setZero();
      reflection.reflect_rows(form);
      if (with_basis) reflection.reflect_rows(basis);
    }
  }
};

}  // namespace holdfast
