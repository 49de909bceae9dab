#pragma once

#include <unsupported/Eigen/MatrixFunctions>

#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/balancing.hpp"

namespace holdfast {

/// e^M for any number type that adds, multiplies and compares: dual numbers of an automatic
/// differentiation among them, for which Eigen's Padé approximants are not made.
///
/// Scaling and squaring: e^M = (e^{M/2^s})^{2^s} with ‖M/2^s‖ ≤ 1/2, where 15 terms of the series
/// leave (1/2)^16/16! < 10⁻¹⁷; an entry that is not finite makes the result so. For `double` alone,
/// `zero_order_hold` is quicker.
template <class Scalar, int Size>
Matrix<Scalar, Size> exponential(const Matrix<Scalar, Size>& matrix) {
  Scalar norm = matrix.cwiseAbs().rowwise().sum().maxCoeff();
  int squarings = 0;
  Scalar factor(1);
  for (; norm > Scalar(0.5) && squarings < 1100; norm /= Scalar(2), factor /= Scalar(2))
    ++squarings;
  const Matrix<Scalar, Size> scaled = matrix * factor;
  const Matrix<Scalar, Size> identity = Matrix<Scalar, Size>::Identity();
  Matrix<Scalar, Size> sum = identity;
  for (int term = 15; term >= 1; --term) sum = identity + scaled * sum / Scalar(term);  // Horner
  for (; squarings > 0; --squarings) sum = (sum * sum).eval();
  return sum;
}

namespace detail {

/// e^M by scaling and squaring of the balanced matrix.
///
/// Displacements and velocities differ by the size of a frequency, so that the norm of M exceeds
/// its eigenvalues by that factor; the squarings that the norm asks for would cost as many digits.
template <class Scalar, int Size>
Matrix<Scalar, Size> balanced_exponential(const Matrix<Scalar, Size>& matrix) {
  const BalancedMatrix<Scalar, Size> similar(matrix);
  return similar.restored(similar.balanced.exp());
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template Matrix<double, 5> balanced_exponential(const Matrix<double, 5>&);
extern template Matrix<double, 6> balanced_exponential(const Matrix<double, 6>&);
#endif

}  // namespace detail

}  // namespace holdfast
