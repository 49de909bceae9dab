#pragma once

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/exponential.hpp"

namespace holdfast {

/// The exact step of a linear system ẋ = A x + B w over a time h with constant inputs w:
///
///     x(t + h) = transition · x(t) + input · w,
///     transition = e^{Ah},   input = ∫₀ʰ e^{As} ds B
template <class Scalar, int States, int Inputs>
struct HeldStep {
  Matrix<Scalar, States> transition;     ///< transition matrix e^{Ah}, States × States
  Matrix<Scalar, States, Inputs> input;  ///< input matrix ∫₀ʰ e^{As} ds B, States × Inputs
};

/// Computes the zero-order hold by one augmented matrix exponential (Van Loan's construction):
///
///     exp([A B; 0 0] h) = [e^{Ah}, ∫₀ʰ e^{As} ds B; 0, I]
///
/// @param a      matrix A, States × States (1/s); either size may be Eigen::Dynamic
/// @param b      matrix B, States × Inputs
/// @param period time h (s), finite, ≥ 0; h = 0 gives the identity and a zero input
/// @throws InvalidParameter where A is not square, or A and B have unequal numbers of rows
/// Source: C. F. Van Loan, Computing integrals involving the matrix exponential, IEEE TAC 23
/// (1978).
template <class Scalar, int States, int Inputs>
HeldStep<Scalar, States, Inputs> zero_order_hold(const Matrix<Scalar, States>& a,
                                                 const Matrix<Scalar, States, Inputs>& b,
                                                 const Scalar& period) {
  const Eigen::Index n = a.rows(), m = b.cols();
  require_size("columns of the state matrix", a.cols(), n);
  require_size("rows of the input matrix", b.rows(), n);
  if (period == Scalar(0)) {
    return {Matrix<Scalar, States>::Identity(n, n), Matrix<Scalar, States, Inputs>::Zero(n, m)};
  }
  constexpr int size = Inputs == Eigen::Dynamic ? Eigen::Dynamic : larger_size(States, Inputs);
  Matrix<Scalar, size> augmented = Matrix<Scalar, size>::Zero(n + m, n + m);
  augmented.template topLeftCorner<States, States>(n, n) = a * period;
  augmented.template topRightCorner<States, Inputs>(n, m) = b * period;
  const Matrix<Scalar, size> whole = exponential(augmented);
  return {whole.template topLeftCorner<States, States>(n, n),
          whole.template topRightCorner<States, Inputs>(n, m)};
}

}  // namespace holdfast
