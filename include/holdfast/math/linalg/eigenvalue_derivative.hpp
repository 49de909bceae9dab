#pragma once

#include <cmath>
#include <complex>
#include <limits>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/elimination.hpp"

namespace holdfast {

/// How an eigenvalue of M moves with M, λ′ = tr(R M′)/tr R for the resolvent R = (νI − M)⁻¹ at a ν
/// next to it, where R is all but the projector on its eigenvectors; of several that coincide, the
/// mean. To about 10⁻⁸ of itself in `double`.
/// @param matrix  M, n × n
/// @param rate    M′, n × n, per unit of whatever varies
/// @param value   the eigenvalue λ
/// @return        λ′; NaN or infinite for λ = 0, where no ν lies next to it
/// @throws InvalidParameter where the matrix is not square, or its rate of another size
/// Work: the inverse of one complex matrix.
template <class Scalar>
std::complex<Scalar> eigenvalue_derivative(const Matrix<Scalar, Eigen::Dynamic>& matrix,
                                           const Matrix<Scalar, Eigen::Dynamic>& rate,
                                           const std::complex<Scalar>& value) {
  using Complex = std::complex<Scalar>;
  require_size("columns of a square matrix", matrix.cols(), matrix.rows());
  require_size("rows of the rate of a matrix", rate.rows(), matrix.rows());
  require_size("columns of the rate of a matrix", rate.cols(), matrix.rows());
  Matrix<Complex, Eigen::Dynamic> shifted = -matrix.template cast<Complex>();
  shifted.diagonal().array() +=
      value * (Scalar(1) + std::sqrt(std::numeric_limits<Scalar>::epsilon()));
  const Matrix<Complex, Eigen::Dynamic> resolvent = eliminated(
      shifted, Matrix<Complex, Eigen::Dynamic>(shifted.Identity(shifted.rows(), shifted.cols())));
  return resolvent.transpose().cwiseProduct(rate.template cast<Complex>()).sum() /
         resolvent.trace();
}

}  // namespace holdfast
