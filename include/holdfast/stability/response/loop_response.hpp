#pragma once

#include <Eigen/Core>
#include <complex>
#include <utility>

#include "holdfast/control/loop_map.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/complex_exponential.hpp"
#include "holdfast/math/linalg/reflections.hpp"

namespace holdfast {

/// Transfer functions from command to measured displacement and velocity at one λ (z-transform).
template <class Scalar>
struct CommandResponse {
  std::complex<Scalar> displacement;  ///< transfer function G_z(λ) (m/N) to the displacement
  std::complex<Scalar> velocity;      ///< transfer function G_v(λ) (m/(N s)) to the velocity
};

/// The zero-order-hold transfer functions of a loop of any order, given by its `LoopMap`,
///
///     G_z(λ) = h_z (λI − S₀)⁻¹ s,   G_v(λ) = h_v (λI − S₀)⁻¹ s
///
/// from the command to the measured displacement and velocity. S₀ is the map without feedback, s
/// the command's column, h_z and h_v are the readings' rows. The characteristic equation of the
/// loop is 1 − P G_z(λ) − D G_v(λ) = 0. The n × n matrix S₀ − I is reduced once to Hessenberg form.
/// Each λ then costs about 4 n² complex multiply-adds. Source: A. J. Laub, Efficient multivariable
/// frequency response computations, IEEE TAC 26 (1981).
template <class Scalar>
class LoopResponse {
 public:
  using Complex = std::complex<Scalar>;  ///< type of λ and of the responses

  /// @param map  map of the loop
  explicit LoopResponse(const LoopMap<Scalar>& map);

  /// The transfer functions at λ = 1 + μ. The argument μ avoids a loss of digits for small τ.
  CommandResponse<Scalar> at_distance_from_one(const Complex& mu) const;

  /// The transfer functions G_z and G_v at λ = e^{iθ} on the unit circle.
  /// @param angle  θ (rad), 0 … π
  CommandResponse<Scalar> at_angle(const Scalar& angle) const {
    return at_distance_from_one(circle_increment(angle));
  }

 private:
  Matrix<Scalar, Eigen::Dynamic> hessenberg_;       // Qᵀ (S₀ − I) Q
  Vector<Scalar, Eigen::Dynamic> command_;          // Qᵀ s
  RowVector<Scalar, Eigen::Dynamic> displacement_;  // h_z Q
  RowVector<Scalar, Eigen::Dynamic> velocity_;      // h_v Q
};

template <class Scalar>
LoopResponse<Scalar>::LoopResponse(const LoopMap<Scalar>& map) {
  const HessenbergForm<Matrix<Scalar, Eigen::Dynamic>> reduced(map.increment);
  const auto& q = reduced.basis;
  hessenberg_ = reduced.form;
  command_ = q.transpose() * map.command;
  displacement_ = map.displacement * q;
  velocity_ = map.velocity * q;
}

template <class Scalar>
CommandResponse<Scalar> LoopResponse<Scalar>::at_distance_from_one(const Complex& mu) const {
  const Eigen::Index n = hessenberg_.rows();
  // Column-major and upper triangular but for one diagonal: Gauss with exchange of neighbours.
  Matrix<Complex, Eigen::Dynamic> rows = -hessenberg_.template cast<Complex>();
  rows.diagonal().array() += mu;
  Vector<Complex, Eigen::Dynamic> solution = command_.template cast<Complex>();
  for (Eigen::Index k = 0; k + 1 < n; ++k) {
    if (std::norm(rows(k + 1, k)) > std::norm(rows(k, k))) {
      rows.row(k).tail(n - k).swap(rows.row(k + 1).tail(n - k));
      std::swap(solution[k], solution[k + 1]);
    }
    if (rows(k + 1, k) == Complex(0)) continue;
    const Complex factor = rows(k + 1, k) / rows(k, k);
    rows.row(k + 1).tail(n - k - 1) -= factor * rows.row(k).tail(n - k - 1);
    solution[k + 1] -= factor * solution[k];
  }
  for (Eigen::Index k = n - 1; k >= 0; --k) {
    solution[k] /= rows(k, k);
    solution.head(k) -= solution[k] * rows.col(k).head(k);
  }
  return {(displacement_.template cast<Complex>() * solution).value(),
          (velocity_.template cast<Complex>() * solution).value()};
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template class LoopResponse<double>;
#endif

}  // namespace holdfast
