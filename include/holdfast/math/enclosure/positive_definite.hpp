#pragma once

#include "holdfast/core/types.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"

namespace holdfast {

/// Whether every symmetric matrix in an interval matrix is proved to be positive definite: all
/// pivots of Gaussian elimination without exchanges are > 0. `false` means only that the proof
/// failed. Work: N³/3 operations.
/// @param matrix  interval matrix, N × N; only its lower triangle is used
template <int Size>
bool is_positive_definite(Matrix<Enclosure, Size> matrix) {
  const Eigen::Index n = matrix.rows();
  for (Eigen::Index k = 0; k < n; ++k) {
    const Enclosure pivot = matrix(k, k);
    if (!pivot.is_positive()) return false;
    for (Eigen::Index i = k + 1; i < n; ++i) {
      const Enclosure factor = matrix(i, k) / pivot;
      for (Eigen::Index j = k + 1; j <= i; ++j) matrix(i, j) -= factor * matrix(j, k);
    }
  }
  return true;
}

}  // namespace holdfast
