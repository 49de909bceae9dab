#pragma once

#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/balancing.hpp"

namespace holdfast {

/// ẋ = A x + drift + b u + c F(t): the motion of a plant of order N while the contact does not
/// change.
/// @tparam States  N; Eigen::Dynamic where it is known at run time alone
template <int States>
struct AffineDynamicsOf {
  Matrix<double, States> state;    ///< A, N × N
  Vector<double, States> command;  ///< b, N × 1 per newton of u; zero where u has no effect
  Vector<double, States> force;    ///< c, N × 1 per newton of F
  /// N × 1; of no size at all unless given, where N is known at run time alone
  Vector<double, States> drift = Vector<double, States>::Zero(States < 0 ? 0 : States);
};

/// The affine dynamics of the two masses.
using AffineDynamics = AffineDynamicsOf<4>;

/// ‖A‖ in the balanced coordinates (1/s, largest row sum): the size of A that the powers of A h
/// show, in any units of the state.
template <class Scalar, int States>
Scalar balanced_norm(const Matrix<Scalar, States>& a) {
  return BalancedMatrix<Scalar, States>(a).balanced.cwiseAbs().rowwise().sum().maxCoeff();
}

}  // namespace holdfast
