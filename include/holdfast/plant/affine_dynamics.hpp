#pragma once

#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/balancing.hpp"

namespace holdfast {

/// The equations of motion ẋ = A x + drift + b u + c F(t) of a plant of order N as long as the
/// contact does not change.
/// @tparam States  N; Eigen::Dynamic where it is known at run time only
template <int States>
struct AffineDynamicsOf {
  Matrix<double, States> state;    ///< A, N × N
  Vector<double, States> command;  ///< b, N × 1 per newton of u; zero where u has no effect
  Vector<double, States> force;    ///< c, N × 1 per newton of F
  /// The drift, N × 1; empty by default where N is known at run time only.
  Vector<double, States> drift = Vector<double, States>::Zero(States < 0 ? 0 : States);
};

/// The affine dynamics of the two masses.
using AffineDynamics = AffineDynamicsOf<4>;

/// The norm ‖A‖ in balanced coordinates (1/s, largest row sum). It describes the growth of the
/// powers of A h, whatever the units of the state.
template <class Scalar, int States>
Scalar balanced_norm(const Matrix<Scalar, States>& a) {
  return BalancedMatrix<Scalar, States>(a).balanced.cwiseAbs().rowwise().sum().maxCoeff();
}

}  // namespace holdfast
