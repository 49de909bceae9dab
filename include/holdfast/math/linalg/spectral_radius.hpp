#pragma once

#include <complex>
#include <limits>

#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/balancing.hpp"
#include "holdfast/math/linalg/eigenvalues.hpp"

namespace holdfast {

namespace detail {

/// The eigenvalues of the balanced matrix by the QR algorithm. Balancing matters since the error is
/// relative to the largest entry and a loop's matrix mixes forces and displacements.
template <class Scalar, int Size>
Vector<std::complex<Scalar>, Size> balanced_eigenvalues(const Matrix<Scalar, Size>& matrix) {
  return eigenvalues(BalancedMatrix(matrix).balanced);
}

}  // namespace detail

/// The spectral radius ρ(M) = max |λ_i|; a discrete loop is asymptotically stable ⇔ ρ < 1. The
/// result is NaN for a matrix that is not finite.
/// @throws InvalidParameter where the matrix is empty or not square
template <class Scalar, int Size>
Scalar spectral_radius(const Matrix<Scalar, Size>& map) {
  if (!map.allFinite()) return std::numeric_limits<Scalar>::quiet_NaN();
  return detail::balanced_eigenvalues(map).cwiseAbs().maxCoeff();
}

/// The spectral abscissa α(M) = max Re λ_i; a continuous loop is asymptotically stable ⇔ α < 0. The
/// result is NaN for a matrix that is not finite.
/// @throws InvalidParameter where the matrix is empty or not square
template <class Scalar, int Size>
Scalar spectral_abscissa(const Matrix<Scalar, Size>& generator) {
  if (!generator.allFinite()) return std::numeric_limits<Scalar>::quiet_NaN();
  return detail::balanced_eigenvalues(generator).real().maxCoeff();
}

}  // namespace holdfast
