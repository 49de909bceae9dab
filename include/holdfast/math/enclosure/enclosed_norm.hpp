#pragma once

#include "holdfast/core/types.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"
#include "holdfast/math/enclosure/positive_definite.hpp"

namespace holdfast {

namespace detail {

/// An approximation, in doubles, of the largest eigenvalue of a symmetric matrix FᵀF ≠ 0: the
/// Rayleigh quotient of a column of a high power of the matrix.
template <int Size>
double largest_eigenvalue_near(const Matrix<double, Size>& form) {
  Matrix<double, Size> power = form / form.trace();
  double change = 1.0;
  for (int turn = 0; turn < 40 && change > 1e-14; ++turn) {
    Matrix<double, Size> next = power * power;
    next /= next.trace();
    change = (next - power).norm();
    power = next;
  }
  Eigen::Index largest = 0;
  power.colwise().squaredNorm().maxCoeff(&largest);
  const Vector<double, Size> direction = power.col(largest);
  return direction.dot(form * direction) / direction.squaredNorm();
}

}  // namespace detail

/// An upper bound of the spectral norms ‖M‖₂ of all matrices M in an interval matrix. It is the sum
/// of a bound σ of ‖M₀‖₂ (M₀: midpoints) and the Frobenius norm of the radii. σ > ‖M₀‖₂ is proved
/// by Gaussian elimination, which shows that σ² I − M₀ᵀM₀ is positive definite.
/// @param matrix  interval matrix, N × N
/// @return the bound; ∞ if the proof fails
template <int Size>
double spectral_norm_bound(const Matrix<Enclosure, Size>& matrix) {
  const Matrix<double, Size> middle = matrix.template cast<double>();
  Enclosure rest;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      rest += square(Enclosure(matrix(i, j).radius()));
  rest = sqrt(rest);
  const Matrix<double, Size> form = middle.transpose() * middle;
  if (form.isZero(0.0)) return rest.upper();
  const Matrix<Enclosure, Size> exact = middle.template cast<Enclosure>();
  const Matrix<Enclosure, Size> enclosed = exact.transpose() * exact;
  const Matrix<Enclosure, Size> identity =
      Matrix<Enclosure, Size>::Identity(matrix.rows(), matrix.cols());
  const double squared = detail::largest_eigenvalue_near<Size>(form);
  for (double more = 1e-13; more < 2.0; more *= 10.0) {
    const Enclosure bound(squared * (1.0 + more));
    if (is_positive_definite<Size>(identity * bound - enclosed))
      return (sqrt(bound) + rest).upper();
  }
  return Enclosure::unknown().upper();
}

}  // namespace holdfast
