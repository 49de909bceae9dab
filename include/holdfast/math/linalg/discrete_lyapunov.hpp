#pragma once

#include <limits>
#include <optional>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// A quadratic form that a linear map M decreases: V = Σ_l (Mˡ)ᵀ Mˡ. It solves the discrete
/// Lyapunov equation V − MᵀV M = I, so that eᵀVe falls by ‖e‖² from a vector e to M e.
///
/// Each step doubles the number of terms, V ← V + PᵀV P, P ← P², starting from P = M (R. A. Smith,
/// Matrix equation XA + BX = C, SIAM J. Appl. Math. 16 (1968)). As a check, V − MᵀV M must differ
/// from I by less than a half, including rounding.
/// @param map     matrix M, n × n
/// @param enough  limit of the equation's error ‖Mˡ‖²_F below which the sum may end after l terms
/// @return form V; none where M does not contract, or so slowly that rounding hides the contraction
/// @throws InvalidParameter where M is not square
/// Work: 3 n³ multiply-adds per doubling; the number of doublings is log₂ of the number of steps in
/// which Mˡ decays.
template <class Scalar>
std::optional<Matrix<Scalar, Eigen::Dynamic>> discrete_lyapunov(
    const Matrix<Scalar, Eigen::Dynamic>& map, double enough = 0.0) {
  using Square = Matrix<Scalar, Eigen::Dynamic>;
  constexpr int most_doublings = 48;
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const Eigen::Index n = map.rows();
  require_size("columns of a square matrix", map.cols(), n);
  const Square identity = Square::Identity(n, n);
  Square measure = identity, power = map;
  for (int count = 0; count < most_doublings; ++count) {
    const Square more = power.transpose() * (measure * power);
    measure += more;
    if (!measure.allFinite()) return std::nullopt;
    if (more.norm() <= 0.125 * epsilon * measure.norm()) break;
    power = Square(power * power);
    if (power.squaredNorm() < enough) break;
  }
  const Square left = measure - map.transpose() * (measure * map) - identity;  // is to be nothing
  const double rounding =
      4.0 * static_cast<double>(n) * epsilon * measure.norm() * (1.0 + map.squaredNorm());
  if (!(left.norm() + rounding < 0.5)) return std::nullopt;
  return Square(0.5 * (measure + measure.transpose()));
}

}  // namespace holdfast
