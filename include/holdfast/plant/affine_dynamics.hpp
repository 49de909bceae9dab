#pragma once

#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/balancing.hpp"

namespace holdfast {

/// The equations of motion ẋ = A x + drift + b u + c F(t) of a plant of order N in one mode of the
/// contact, under the command u (N) and the excitation F (N).
/// @tparam States  N; Eigen::Dynamic where it is known at run time only
template <int States>
struct AffineDynamicsOf {
  Matrix<double, States> state;    ///< state matrix A, N × N
  Vector<double, States> command;  ///< input b, N × 1 per newton of u; zero where u has no effect
  Vector<double, States> force;    ///< input c, N × 1 per newton of the excitation F
  /// The drift, a constant part of ẋ, N × 1; empty by default where N is known at run time only.
  Vector<double, States> drift = Vector<double, States>::Zero(States < 0 ? 0 : States);
};

/// The affine dynamics of the plant of two masses (order 4).
using AffineDynamics = AffineDynamicsOf<4>;

/// The maximum-row-sum norm ‖A‖ (1/s) of a state matrix A after balancing (`BalancedMatrix`). For a
/// time h (s), ‖(A h)ⁿ‖ ≤ (‖A‖ h)ⁿ. The units of the states have little effect on this norm.
template <class Scalar, int States>
Scalar balanced_norm(const Matrix<Scalar, States>& a) {
  return BalancedMatrix<Scalar, States>(a).balanced.cwiseAbs().rowwise().sum().maxCoeff();
}

}  // namespace holdfast
