#pragma once

#include <array>

#include "holdfast/core/types.hpp"
#include "holdfast/math/poly/polynomial.hpp"

namespace holdfast {

/// The resolvent (xI − M)⁻¹ = adjugate(x)/determinant(x) of an N × N matrix M as polynomials in x:
///
///     determinant(x) = det(xI − M) = d₀ + d₁ x + … + xᴺ
///     adjugate(x)    = adj(xI − M) = A₀ + A₁ x + … + A_{N−1} x^{N−1}
template <class Scalar, int Size>
struct Resolvent {
  Polynomial<Scalar, Size> determinant;  ///< coefficients d₀ … d_N, d_N = 1
  std::array<Matrix<Scalar, Size>, static_cast<std::size_t>(Size)> adjugate;  ///< A₀ … A_{N−1}

  /// The coefficients of row · adj(xI − M) · column, a polynomial of degree N − 1 in x. It is the
  /// numerator of the transfer function row · (xI − M)⁻¹ · column.
  Polynomial<Scalar, Size - 1> between(const RowVector<Scalar, Size>& row,
                                       const Vector<Scalar, Size>& column) const {
    Polynomial<Scalar, Size - 1> result;
    for (int k = 0; k < Size; ++k) {
      result[k] = (row * adjugate[static_cast<std::size_t>(k)] * column).value();
    }
    return result;
  }
};

/// The resolvent of an N × N matrix by the Faddeev–LeVerrier recurrence, in N matrix products.
///
///     A_{N−1} = I,   d_k = −tr(M A_k) / (N − k),   A_{k−1} = M A_k + d_k I,   k = N − 1, …, 0
///
/// Source: D. K. Faddeev, V. N. Faddeeva, Computational Methods of Linear Algebra, 1963, §47.
template <class Scalar, int Size>
Resolvent<Scalar, Size> resolvent(const Matrix<Scalar, Size>& matrix) {
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
  return result;
}

}  // namespace holdfast
