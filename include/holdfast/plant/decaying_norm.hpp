#pragma once

#include <Eigen/Cholesky>
#include <limits>

#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/balancing.hpp"
#include "holdfast/math/linalg/elimination.hpp"

namespace holdfast {

/// A norm ‖x‖² = xᵀW x that decreases along ẋ = A x, so that ‖e^{At}‖ ≤ 1; W solves
///
///     AᵀW + W A = −I     in balanced coordinates
///
/// A stable plant ẋ = A x + b u + c F of any order has ‖x(t)‖ ≤ ‖x(0)‖ + ∫ ‖b u + c F‖ ds. If A is
/// not stable, no such norm exists. In this case, and where a check against rounding fails, every
/// value is infinite.
///
/// W is the sum Σ MᵏᵀQ Mᵏ, computed by doubling, for the Cayley transform M = (p + A)(p − A)⁻¹ and
/// Q = 2 p (p − A)⁻ᵀ (p − A)⁻¹ with a number p > 0. Two checks guard the bound against rounding: W
/// has a Cholesky factor, and the norm of the equation's residual is below 1/2. Work: about 15
/// products N × N. Source: R. A. Smith, Matrix equation XA + BX = C, SIAM J. Appl. Math. 16 (1968).
/// @tparam States  N; Eigen::Dynamic where it is known at run time only
template <int States>
class DecayingNorm {
 public:
  /// Computes W. @param a  matrix A, N × N (1/s), finite; unless A is stable, exists() is false
  explicit DecayingNorm(const Matrix<double, States>& a) {
    const BalancedMatrix<double, States> similar(a);
    const Matrix<double, States> identity = Matrix<double, States>::Identity(a.rows(), a.cols());
    const Matrix<double, States> weight = solution_of(similar.balanced, identity);
    const Matrix<double, States> left =
        similar.balanced.transpose() * weight + weight * similar.balanced + identity;
    if (!(left.cwiseAbs().rowwise().sum().maxCoeff() < 0.5)) return;
    const Eigen::LLT<Matrix<double, States>> factor(weight);
    if (factor.info() != Eigen::Success) return;
    const Matrix<double, States> lower = factor.matrixL();
    factor_ = similar.factors.cwiseInverse().asDiagonal() * lower;
    exists_ = true;
  }

  /// Whether the norm was found; A is then stable.
  bool exists() const { return exists_; }

  /// The norm ‖x‖ of a state x (N × 1); infinite unless exists().
  double operator()(const Vector<double, States>& state) const {
    if (!exists_) return std::numeric_limits<double>::infinity();
    return (factor_.transpose() * state).norm();
  }

  /// The dual norm of a functional ℓ (N × 1): largest ℓᵀx over ‖x‖ = 1; infinite unless exists().
  double dual(const Vector<double, States>& functional) const {
    if (!exists_) return std::numeric_limits<double>::infinity();
    return factor_.template triangularView<Eigen::Lower>().solve(functional).norm();
  }

 private:
  static Matrix<double, States> solution_of(const Matrix<double, States>& a,
                                            const Matrix<double, States>& identity) {
    const double shift = a.cwiseAbs().rowwise().sum().maxCoeff();
    const Matrix<double, States> inverse =
        eliminated(Matrix<double, States>(shift * identity - a), identity);
    Matrix<double, States> power = inverse * (shift * identity + a);
    Matrix<double, States> sum = 2.0 * shift * inverse.transpose() * inverse;
    for (int doubling = 0; doubling < 40 && power.allFinite(); ++doubling) {
      sum += (power.transpose() * sum * power).eval();
      power = (power * power).eval();
      if (power.cwiseAbs().maxCoeff() < 1e-20) break;
    }
    return sum;
  }

  Matrix<double, States> factor_;  // L with W = L Lᵀ, lower triangular
  bool exists_ = false;
};

}  // namespace holdfast
