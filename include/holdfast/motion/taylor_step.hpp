#pragma once

#include <Eigen/Core>

#include "holdfast/core/types.hpp"
#include "holdfast/math/roots/series.hpp"
#include "holdfast/plant/affine_dynamics.hpp"

namespace holdfast {

/// The number of Taylor terms of e^x needed in double precision, 0 ≤ x ≤ 1: the smallest number for
/// which the first omitted term is below 2⁻⁶⁰. The sum of all omitted terms is then below 2⁻⁵⁹.
inline int terms_for(double x) {
  constexpr double negligible = 8.7e-19;
  double term = 1.0;
  int terms = 1;
  while (terms < most_terms && (term *= x / terms) > negligible) ++terms;
  return terms;
}

/// The Taylor series of ż = A z + b u + c F + drift over a time h (s): z(t + x h) = Σ z_k x^k, with
///
///     z_{k+1} = h (A z_k + w_k) / (k + 1),   w_0 = drift + b u + c F_0,  w_k = c F_k (k > 0)
///
/// where F(t + x h) = Σ F_k x^k. With ‖A‖ h ≤ 1 and terms_for(‖A‖ h) terms the truncation error is
/// below round-off. Work per term: N² + 2 N multiply-adds.
/// @tparam States  N, the order of the plant
template <int States>
class TaylorStep {
 public:
  /// A matrix of coefficients, z_k in column k, at most `most_terms` columns; no heap for fixed N.
  using Coefficients =
      Eigen::Matrix<double, States, Eigen::Dynamic, Eigen::ColMajor, States, most_terms>;

  /// @param dynamics  matrices A, b, c and the drift, constant during the time h
  /// @param state     state z(t) at the beginning, N × 1
  /// @param command   command u (N)
  /// @param force     coefficients F_k (N), at least one; z gets as many terms as there are F_k
  /// @param length    length h (s), ≥ 0
  TaylorStep(const AffineDynamicsOf<States>& dynamics, const Vector<double, States>& state,
             double command, const Series& force, double length)
      : coefficients_(state.size(), force.size()) {
    coefficients_.col(0) = state;
    Vector<double, States> input = dynamics.drift + dynamics.command * command;
    for (Eigen::Index k = 0; k + 1 < force.size(); ++k) {
      input += dynamics.force * force[k];
      const Vector<double, States> rate = dynamics.state * coefficients_.col(k) + input;
      coefficients_.col(k + 1) = rate * (length / static_cast<double>(k + 1));
      input.setZero();
    }
  }

  /// The state z(t + x h), N × 1, 0 ≤ x ≤ 1.
  Vector<double, States> state(double x) const {
    Vector<double, States> value = coefficients_.col(coefficients_.cols() - 1);
    for (Eigen::Index k = coefficients_.cols() - 2; k >= 0; --k)
      value = value * x + coefficients_.col(k);
    return value;
  }

  /// The coefficients z_k, one per column.
  const Coefficients& coefficients() const { return coefficients_; }

 private:
  Coefficients coefficients_;
};

}  // namespace holdfast
