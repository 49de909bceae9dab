#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "holdfast/core/types.hpp"

namespace holdfast {

/// Tangent vectors, the columns of a matrix: infinitesimal deviations from a state of 5 numbers.
template <class Number, int Columns>
using TangentBasis =
    Eigen::Matrix<Number, 5, Columns, Columns == 1 ? Eigen::ColMajor : Eigen::RowMajor>;

/// Flags of tangent vectors: true until a map makes the vector zero or dependent on earlier ones.
using Alive = std::array<bool, 5>;

/// Two properties of R in a factorisation B = Q R: its squared diagonal and the norm of R⁻¹.
template <class Number, int Columns>
struct Stretches {
  Vector<Number, Columns> squares;  ///< R_ii², 0 for a dependent column; 1 if the flag was false
  Number inverse;  ///< ‖R⁻¹‖_F² (Frobenius norm) of the columns whose flags remain true
};

namespace detail {

/// The squared norm ‖(D N)⁻¹‖_F² for a unit upper triangular N and a diagonal D.
/// @param inverse_squares  1 / D_i²
template <class Number, std::size_t Columns>
Number inverse_square_norm(const Number (&unit_upper)[Columns][Columns],
                           const Number (&inverse_squares)[Columns]) {
  Number sum(0);
  for (std::size_t j = 0; j < Columns; ++j) {
    Number column[Columns], size(1);  // column j of N⁻¹ from its diagonal upwards
    for (std::size_t i = j; i-- > 0;) {
      column[i] = -unit_upper[i][j];
      for (std::size_t k = i + 1; k < j; ++k) column[i] -= unit_upper[i][k] * column[k];
      size += column[i] * column[i];
    }
    sum += size * inverse_squares[j];
  }
  return sum;
}

}  // namespace detail

/// Orthonormalises the columns of B in place, B = Q R, by the modified Gram–Schmidt process.
///
/// R is computed as D N, with D diagonal and N unit upper triangular; only D needs square roots.
/// The relative error of R and the deviation of Q from orthogonality are about round-off times
/// ‖B‖ ‖R⁻¹‖. Source: Å. Björck, BIT 7 (1967).
/// @param basis  matrix B, replaced by Q; columns whose flags are false at the end are set to 0
/// @param alive  flags of the columns; set to false for the first column that has a false flag or
///               is a linear combination of earlier columns, and for all later columns
/// @return R_ii² and ‖R⁻¹‖_F²
template <class Number, int Columns>
Stretches<Number, Columns> orthonormalise(TangentBasis<Number, Columns>& basis, Alive& alive) {
  Stretches<Number, Columns> result;
  constexpr auto count = static_cast<std::size_t>(Columns);
  Number inverse_squares[count], unit_upper[count][count];
  for (int i = 0; i < Columns; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Number square = basis.col(i).squaredNorm();
    result.squares[i] = alive[k] ? square : Number(1);
    alive[k] = alive[k] && (i == 0 || alive[k - 1]) && square > Number(0);
    inverse_squares[i] = alive[k] ? Number(1) / square : Number(0);
    for (int j = i + 1; j < Columns; ++j) {
      unit_upper[i][j] = basis.col(i).dot(basis.col(j)) * inverse_squares[i];
      basis.col(j) -= unit_upper[i][j] * basis.col(i);
    }
  }
  for (int i = 0; i < Columns; ++i) basis.col(i) *= std::sqrt(inverse_squares[i]);
  result.inverse = detail::inverse_square_norm(unit_upper, inverse_squares);
  return result;
}

/// Orthonormalises the columns of B in place, B = Q R, by the classical Gram–Schmidt process with
/// reorthogonalisation.
/// @param basis  matrix B, replaced by Q; a linear combination of earlier columns becomes 0
/// @return the upper triangular matrix R of B = Q R
inline Eigen::MatrixXd orthonormalise(Eigen::MatrixXd& basis) {
  Eigen::MatrixXd upper = Eigen::MatrixXd::Zero(basis.cols(), basis.cols());
  for (Eigen::Index i = 0; i < basis.cols(); ++i) {
    auto column = basis.col(i);
    const double round_off = 8.0 * std::numeric_limits<double>::epsilon() * column.norm();
    for (int turn = 0; turn < 2; ++turn) {
      const Eigen::VectorXd along = basis.leftCols(i).transpose() * column;
      column -= basis.leftCols(i) * along;
      upper.col(i).head(i) += along;
    }
    upper(i, i) = column.norm();
    if (upper(i, i) > round_off)
      column /= upper(i, i);
    else
      column.setZero();
  }
  return upper;
}

}  // namespace holdfast
