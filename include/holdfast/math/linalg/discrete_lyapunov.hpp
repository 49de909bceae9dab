#pragma once

#include <limits>
#include <optional>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// The solution V = Σ_{l ≥ 0} (Mˡ)ᵀ Mˡ of the discrete Lyapunov equation V − MᵀV M = I. The
/// Lyapunov function eᵀVe decreases by ‖e‖² in each step e ← M e.
///
/// Each step doubles the number of terms, V ← V + PᵀV P, P ← P², starting from V = I, P = M (R. A.
/// Smith, Matrix equation XA + BX = C, SIAM J. Appl. Math. 16 (1968)). V is returned only if the
/// Frobenius norm of the residual V − MᵀV M − I, plus a bound of its round-off, is less than ½.
/// @param map     matrix M, n × n
/// @param enough  admissible residual norm, 0 … ½: the sum ends after l terms if ‖Mˡ‖²_F < enough
/// @return V, n × n; nullopt if the sum diverges (an eigenvalue of M has a modulus ≥ 1), or if it
///         converges so slowly that the residual condition is violated
/// @throws InvalidParameter where M is not square
/// Work: 3 n³ multiply-adds per doubling, up to 48 doublings.
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
  const Square left = measure - map.transpose() * (measure * map) - identity;  // equation's error
  const double rounding =
      4.0 * static_cast<double>(n) * epsilon * measure.norm() * (1.0 + map.squaredNorm());
  if (!(left.norm() + rounding < 0.5)) return std::nullopt;
  return Square(0.5 * (measure + measure.transpose()));
}

}  // namespace holdfast
