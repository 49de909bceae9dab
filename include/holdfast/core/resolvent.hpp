#pragma once

#include <array>
#include <cmath>

#include "holdfast/core/polynomial.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// The resolvent of a square matrix as polynomials: (xI − M)⁻¹ = adjugate(x) / determinant(x).
///
///     determinant(x) = det(xI − M) = d₀ + d₁ x + … + xᴺ
///     adjugate(x)    = adj(xI − M) = A₀ + A₁ x + … + A_{N−1} x^{N−1}
template <class Scalar, int Size>
struct Resolvent {
  Polynomial<Scalar, Size> determinant;
  std::array<Matrix<Scalar, Size>, Size> adjugate;

  /// The polynomial row · adj(xI − M) · column, of degree N − 1.
  Polynomial<Scalar, Size - 1> between(const RowVector<Scalar, Size>& row,
                                       const Vector<Scalar, Size>& column) const {
    Polynomial<Scalar, Size - 1> result;
    for (int k = 0; k < Size; ++k) {
      result[k] = (row * adjugate[static_cast<std::size_t>(k)] * column).value();
    }
    return result;
  }
};

namespace detail {

/// Powers of two t_i for which row i and column i of diag(t)⁻¹ M diag(t) have about the same size.
///
/// Displacements and velocities differ by the size of a frequency; without this the recurrence
/// below loses that ratio, to the power of the dimension, to cancellation. Powers of two round
/// nothing. Source: B. N. Parlett, C. Reinsch, Balancing a matrix, Numer. Math. 13 (1969).
template <class Scalar, int Size>
Vector<Scalar, Size> balancing(const Matrix<Scalar, Size>& matrix) {
  using std::abs;
  using std::exp2;
  using std::log2;
  using std::round;
  Vector<Scalar, Size> factors = Vector<Scalar, Size>::Ones();
  for (int sweep = 0; sweep < 4; ++sweep) {
    for (int i = 0; i < Size; ++i) {
      Scalar row(0), column(0);
      for (int j = 0; j < Size; ++j) {
        if (j == i) continue;
        row += abs(matrix(i, j)) * factors[j] / factors[i];
        column += abs(matrix(j, i)) * factors[i] / factors[j];
      }
      if (row > Scalar(0) && column > Scalar(0)) {
        factors[i] *= exp2(round(log2(row / column) / Scalar(2)));
      } else if (row > Scalar(0)) {
        factors[i] *= exp2(round(log2(row)));  // nothing depends on i: its unit is free
      }
    }
  }
  return factors;
}

}  // namespace detail

/// Resolvent polynomials by the Faddeev–LeVerrier recurrence on the balanced matrix, N matrix
/// products.
///
///     A_{N−1} = I,   d_{k} = −tr(M A_k) / (N − k),   A_{k−1} = M A_k + d_k I
///
/// Source: D. K. Faddeev, V. N. Faddeeva, Computational Methods of Linear Algebra, 1963, §47.
template <class Scalar, int Size>
Resolvent<Scalar, Size> resolvent(const Matrix<Scalar, Size>& unbalanced) {
  const Vector<Scalar, Size> factors = detail::balancing(unbalanced);
  const Vector<Scalar, Size> inverse_factors = factors.cwiseInverse();
  const Matrix<Scalar, Size> matrix =
      inverse_factors.asDiagonal() * unbalanced * factors.asDiagonal();
  Resolvent<Scalar, Size> result;
  const Matrix<Scalar, Size> identity = Matrix<Scalar, Size>::Identity();
  result.determinant[Size] = Scalar(1);
  result.adjugate[Size - 1] = identity;
  for (int k = Size - 1; k >= 0; --k) {
    const Matrix<Scalar, Size> product = matrix * result.adjugate[static_cast<std::size_t>(k)];
    result.determinant[k] = -product.trace() / Scalar(Size - k);
    if (k > 0) {
      result.adjugate[static_cast<std::size_t>(k - 1)] = product + result.determinant[k] * identity;
    }
  }
  for (auto& coefficient : result.adjugate) {
    coefficient = factors.asDiagonal() * coefficient * inverse_factors.asDiagonal();
  }
  return result;
}

}  // namespace holdfast
