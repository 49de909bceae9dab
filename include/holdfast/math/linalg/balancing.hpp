#pragma once

#include <cmath>
#include <limits>

#include "holdfast/core/types.hpp"

namespace holdfast {

/// Powers of two t_i for which row i and column i of diag(t)⁻¹ M diag(t) have about the same size.
///
/// Displacements and velocities differ by the size of a frequency. Scaling and squaring as well as
/// the QR algorithm err by a fraction of the matrix norm, which balancing brings close to the
/// spectral radius. Powers of two round nothing.
/// Source: B. N. Parlett, C. Reinsch, Balancing a matrix, Numer. Math. 13 (1969).
template <class Scalar, int Size>
Vector<Scalar, Size> balancing(const Matrix<Scalar, Size>& matrix) {
  using std::abs;
  using std::exp2;
  using std::log2;
  using std::round;
  // Entries at the end of the range of numbers would carry the factors beyond it.
  const Scalar most = exp2(Scalar(std::numeric_limits<Scalar>::max_exponent) / Scalar(5));
  const auto size = static_cast<int>(matrix.rows());
  Vector<Scalar, Size> factors = Vector<Scalar, Size>::Ones(size);
  for (int sweep = 0; sweep < 4; ++sweep) {
    for (int i = 0; i < size; ++i) {
      Scalar row(0), column(0);
      for (int j = 0; j < size; ++j) {
        if (j == i) continue;
        row += abs(matrix(i, j)) * factors[j] / factors[i];
        column += abs(matrix(j, i)) * factors[i] / factors[j];
      }
      Scalar factor = factors[i];
      if (row > Scalar(0) && column > Scalar(0)) {
        factor *= exp2(round(log2(row / column) / Scalar(2)));
      } else if (row > Scalar(0)) {
        factor *= exp2(round(log2(row)));  // nothing depends on i: its unit is free
      }
      if (factor <= most && factor >= Scalar(1) / most) factors[i] = factor;
    }
  }
  return factors;
}

/// A matrix balanced by a diagonal similarity: original = diag(factors) · balanced ·
/// diag(factors)⁻¹.
template <class Scalar, int Size>
struct BalancedMatrix {
  Vector<Scalar, Size> factors;   ///< powers of two
  Matrix<Scalar, Size> balanced;  ///< row i and column i of about the same size

  /// Balances `original`, whose entries must be finite.
  explicit BalancedMatrix(const Matrix<Scalar, Size>& original)
      : factors(balancing(original)),
        balanced(factors.cwiseInverse().asDiagonal() * original * factors.asDiagonal()) {}

  /// What a function of the balanced matrix is for the original: diag(factors) · f ·
  /// diag(factors)⁻¹.
  Matrix<Scalar, Size> restored(const Matrix<Scalar, Size>& function) const {
    return factors.asDiagonal() * function * factors.cwiseInverse().asDiagonal();
  }
};

}  // namespace holdfast
