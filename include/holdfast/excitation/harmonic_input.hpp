#pragma once

#include <cmath>

#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/exponential.hpp"

namespace holdfast {

/// How the harmonic force is taken over a sample.
enum class ForceHold {
  sampled,  ///< held at its sampled value, the paper's choice
  exact,    ///< integrated exactly
};

/// How a harmonic force F(t) = F_m cos(ω t) enters one sampling period.
///
///     z_{j+1} = … + F_m (cosine · cos(ω t_j) + sine · sin(ω t_j))
///
/// Both holds of the force share this form, so one stepper serves both.
template <class Scalar>
struct HarmonicInput {
  Vector<Scalar, 4> cosine;  ///< 4 × 1, per newton
  Vector<Scalar, 4> sine;    ///< 4 × 1, per newton
};

/// The exact integral of the harmonic force over the sample, ∫₀^τ e^{A(τ−s)} c cos(ω(t_j + s)) ds.
///
/// The force is written as the output of an oscillator, so that one matrix exponential holds it
/// all:
///
///     d/dt [z; cos ωt; sin ωt] = [A c 0; 0 0 −ω; 0 ω 0] [z; cos ωt; sin ωt]
///
/// Differs from the held force by O(τ) in phase and O(τ²) in amplitude as τ → 0.
/// @param a                  A, 4 × 4 (1/s)
/// @param c                  4 × 1, per newton of F
/// @param period             τ (s), ≥ 0
/// @param angular_frequency  ω = 2π f (rad/s), finite
template <class Scalar>
HarmonicInput<Scalar> exact_harmonic(const Matrix<Scalar, 4>& a, const Vector<Scalar, 4>& c,
                                     const Scalar& period, const Scalar& angular_frequency) {
  Matrix<Scalar, 6> generator = Matrix<Scalar, 6>::Zero();
  generator.template topLeftCorner<4, 4>() = a;
  generator.template block<4, 1>(0, 4) = c;
  generator(4, 5) = -angular_frequency;
  generator(5, 4) = angular_frequency;
  const Matrix<Scalar, 6> exponential =
      detail::balanced_exponential(Matrix<Scalar, 6>(generator * period));
  return {exponential.template block<4, 1>(0, 4), exponential.template block<4, 1>(0, 5)};
}

/// The same for a plant over a sampling period.
template <class Scalar, template <class> class Plant>
HarmonicInput<Scalar> exact_harmonic(const Plant<Scalar>& plant, const Scalar& sampling_period,
                                     const Scalar& angular_frequency) {
  return exact_harmonic<Scalar>(plant.state_matrix(), plant.excitation_input(), sampling_period,
                                angular_frequency);
}

/// The input of a harmonic force whose phase is ahead by `angle` (rad):
/// g_c cos(θ + angle) + g_s sin(θ + angle) = cosine' cos θ + sine' sin θ.
template <class Scalar>
HarmonicInput<Scalar> ahead_by(const Scalar& angle, const HarmonicInput<Scalar>& input) {
  using std::cos;
  using std::sin;
  const Scalar cosine = cos(angle), sine = sin(angle);
  return {input.cosine * cosine + input.sine * sine, input.sine * cosine - input.cosine * sine};
}

}  // namespace holdfast
