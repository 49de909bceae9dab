#pragma once

#include <cmath>
#include <type_traits>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/exponential.hpp"

namespace holdfast {

/// The excitation force within a sampling period: held or varying.
enum class ForceHold {
  sampled,  ///< held at its value F(t_j) at the sample, as in Kollár 2022
  exact,    ///< F(t), whose response is integrated exactly
};

/// The response of a plant of order N to a force F(t) = F_m cos(ω t) over one sampling period, as
/// it is added to the state z_{j+1}:
///
///     F_m (cosine · cos(ω t_j) + sine · sin(ω t_j))      for both kinds of ForceHold
template <class Scalar, int States = 4>
struct HarmonicInput {
  Vector<Scalar, States> cosine;  ///< response g_c per newton of F_m cos(ω t_j), N × 1
  Vector<Scalar, States> sine;    ///< response g_s per newton of F_m sin(ω t_j), N × 1
};

/// The response of a plant over a sampling period to the force cos(ω t), not held:
/// ∫₀^τ e^{A(τ−s)} c cos(ω(t_j + s)) ds = g_c cos(ω t_j) + g_s sin(ω t_j).
///
/// The force is the output of an oscillator, so that one matrix exponential contains g_c and g_s:
///
///     d/dt [z; cos ωt; sin ωt] = [A c 0; 0 0 −ω; 0 ω 0] [z; cos ωt; sin ωt]
///
/// As τ → 0, the response to the held force differs by O(τ) in phase and O(τ²) in amplitude.
/// @param a                  state matrix A, N × N (1/s)
/// @param c                  input column c, N × 1 per newton of F
/// @param period             sampling period τ (s), ≥ 0
/// @param angular_frequency  angular frequency ω = 2π f (rad/s), finite
/// @throws InvalidParameter where τ or ω is not admissible, or the sizes disagree
template <class Scalar, int States>
HarmonicInput<Scalar, States> exact_harmonic(const Matrix<Scalar, States>& a,
                                             const Vector<Scalar, States>& c, const Scalar& period,
                                             const Scalar& angular_frequency) {
  if constexpr (std::is_floating_point_v<Scalar>) {
    require_non_negative("sampling period tau", static_cast<double>(period), "s");
    require_finite("angular frequency", static_cast<double>(angular_frequency), "rad/s");
  }
  require_size("size of the excitation input", c.size(), a.rows());
  constexpr int size = larger_size(States, 2);
  const Eigen::Index n = a.rows();
  Matrix<Scalar, size> generator = Matrix<Scalar, size>::Zero(n + 2, n + 2);
  generator.template topLeftCorner<States, States>(n, n) = a;
  generator.template block<States, 1>(0, n, n, 1) = c;
  generator(n, n + 1) = -angular_frequency;
  generator(n + 1, n) = angular_frequency;
  const auto whole = exponential(Matrix<Scalar, size>(generator * period));
  return {whole.template block<States, 1>(0, n, n, 1),
          whole.template block<States, 1>(0, n + 1, n, 1)};
}

/// The harmonic input (g_c′, g_s′) of a force whose phase is advanced by `angle` = α (rad):
/// g_c cos(θ + α) + g_s sin(θ + α) = g_c′ cos θ + g_s′ sin θ for all θ.
template <class Scalar, int States>
HarmonicInput<Scalar, States> ahead_by(const Scalar& angle,
                                       const HarmonicInput<Scalar, States>& input) {
  using std::cos;
  using std::sin;
  const Scalar cosine = cos(angle), sine = sin(angle);
  return {input.cosine * cosine + input.sine * sine, input.sine * cosine - input.cosine * sine};
}

}  // namespace holdfast
