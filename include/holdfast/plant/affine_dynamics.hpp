#pragma once

#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/balancing.hpp"

namespace holdfast {

/// ż = A z + drift + b u + c F(t): the motion while the contact does not change.
struct AffineDynamics {
  Matrix<double, 4> state;    ///< A, 4 × 4
  Vector<double, 4> command;  ///< b, 4 × 1 per newton of u; zero where u is not transmitted
  Vector<double, 4> force;    ///< c, 4 × 1 per newton of F
  Vector<double, 4> drift = Vector<double, 4>::Zero();  ///< 4 × 1
};

/// ‖A‖ in the balanced coordinates (1/s, largest row sum): the size of A that the powers of A h
/// show, whatever the units of the state.
template <class Scalar>
Scalar balanced_norm(const Matrix<Scalar, 4>& a) {
  return BalancedMatrix<Scalar, 4>(a).balanced.cwiseAbs().rowwise().sum().maxCoeff();
}

}  // namespace holdfast
