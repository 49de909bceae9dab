#pragma once

#include <complex>
#include <limits>

#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/balancing.hpp"
#include "holdfast/math/linalg/eigenvalues.hpp"

namespace holdfast {

namespace detail {

/// The eigenvalues of the balanced matrix by the QR algorithm. Balancing is needed, since the error
/// is relative to the largest entry and a loop's matrix mixes forces and displacements.
template <class Scalar, int Size>
Vector<std::complex<Scalar>, Size> balanced_eigenvalues(const Matrix<Scalar, Size>& matrix) {
  return eigenvalues(BalancedMatrix(matrix).balanced);
}

}  // namespace detail

/// The spectral radius ρ(M) = max |λ_i| over the eigenvalues λ_i of M; NaN if an entry is not
/// finite. The discrete system x ← M x is asymptotically stable if and only if ρ < 1.
/// @throws InvalidParameter where the matrix is empty or not square
template <class Scalar, int Size>
Scalar spectral_radius(const Matrix<Scalar, Size>& map) {
  if (!map.allFinite()) return std::numeric_limits<Scalar>::quiet_NaN();
  return detail::balanced_eigenvalues(map).cwiseAbs().maxCoeff();
}

/// The spectral abscissa α(M) = max Re λ_i over the eigenvalues λ_i of M; NaN if an entry is not
/// finite. The continuous system ẋ = M x is asymptotically stable if and only if α < 0.
/// @throws InvalidParameter where the matrix is empty or not square
template <class Scalar, int Size>
Scalar spectral_abscissa(const Matrix<Scalar, Size>& generator) {
  if (!generator.allFinite()) return std::numeric_limits<Scalar>::quiet_NaN();
  return detail::balanced_eigenvalues(generator).real().maxCoeff();
}

}  // namespace holdfast
