#pragma once

#include <cstdlib>
#include <limits>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

namespace detail {

/// The exponent k of the power 4ᵏ nearest to a ratio ≥ 0 (on a logarithmic scale), within ±`most`.
template <class Scalar>
int nearest_power_of_four(Scalar ratio, int most) {
  int power = 0;
  for (; ratio >= Scalar(2) && power < most; ratio /= Scalar(4)) ++power;
  for (; ratio <= Scalar(0.5) && power > -most; ratio *= Scalar(4)) --power;
  return power;
}

}  // namespace detail

/// Powers of two t_i that balance a matrix M: row i and column i of diag(t)⁻¹ M diag(t) are of
/// similar size.
///
/// The errors of the matrix exponential and of the QR algorithm are proportional to the matrix
/// norm. Balancing reduces this norm where entries differ much in size, for instance by their
/// units. Powers of two cause no rounding. The number type needs the four operations and a
/// comparison. Source: B. N. Parlett, C. Reinsch, Balancing a matrix, Numer. Math. 13 (1969).
/// @throws InvalidParameter where the matrix is empty or not square
template <class Scalar, int Size>
Vector<Scalar, Size> balancing(const Matrix<Scalar, Size>& matrix) {
  // The limit prevents overflow of the factors for entries near the largest number.
  constexpr int most = std::numeric_limits<Scalar>::max_exponent / 5;
  require_positive("rows of a square matrix", static_cast<double>(matrix.rows()), "");
  require_size("columns of a square matrix", matrix.cols(), matrix.rows());
  const auto size = static_cast<int>(matrix.rows());
  const Matrix<Scalar, Size> moduli = matrix.cwiseAbs();
  Vector<Scalar, Size> factors = Vector<Scalar, Size>::Ones(size);
  Vector<int, Size> exponents = Vector<int, Size>::Zero(size);
  for (int sweep = 0; sweep < 4; ++sweep) {
    for (int i = 0; i < size; ++i) {
      Scalar row(0), column(0);
      for (int j = 0; j < size; ++j) {
        if (j == i) continue;
        row += moduli(i, j) * factors[j] / factors[i];
        column += moduli(j, i) * factors[i] / factors[j];
      }
      if (!(row > Scalar(0))) continue;
      // For a zero column any factor will do.
      const Scalar ratio = column > Scalar(0) ? Scalar(row / column) : Scalar(row * row);
      const int change = detail::nearest_power_of_four(ratio, 2 * most + 1);
      if (std::abs(exponents[i] + change) > most) continue;
      exponents[i] += change;
      for (int k = 0; k < change; ++k) factors[i] *= Scalar(2);
      for (int k = 0; k > change; --k) factors[i] /= Scalar(2);
    }
  }
  return factors;
}

/// A matrix balanced by similarity: original = diag(factors) · balanced · diag(factors)⁻¹.
template <class Scalar, int Size>
struct BalancedMatrix {
  Vector<Scalar, Size> factors;   ///< balancing factors, powers of two, one for each row
  Matrix<Scalar, Size> balanced;  ///< balanced matrix: row i and column i have similar norms

  /// Balances the matrix `original`, whose entries must be finite.
  explicit BalancedMatrix(const Matrix<Scalar, Size>& original)
      : factors(balancing(original)),
        balanced(factors.cwiseInverse().asDiagonal() * original * factors.asDiagonal()) {}

  /// The matrix function f(original), such as the exponential, computed from f(balanced):
  /// f(original) = diag(factors) · f(balanced) · diag(factors)⁻¹. @param function  f(balanced)
  Matrix<Scalar, Size> restored(const Matrix<Scalar, Size>& function) const {
    return factors.asDiagonal() * function * factors.cwiseInverse().asDiagonal();
  }
};

}  // namespace holdfast
