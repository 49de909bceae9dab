#pragma once

#include <cmath>
#include <complex>
#include <type_traits>

#include "holdfast/control/loop_map.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic_input.hpp"
#include "holdfast/math/linalg/complex_exponential.hpp"
#include "holdfast/math/linalg/elimination.hpp"

namespace holdfast {

/// The steady response to unit forces at ω, as complex amplitudes of what P and D multiply and of
/// the conductor's displacement z. What is measured need not be the conductor's own motion, but
/// for instance a filter's; of the two masses it is z₁ and ż₁, and z is z₁.
template <class Scalar>
struct LoopPhasors {
  std::complex<Scalar> control_displacement;  ///< t_z (m/N): what P multiplies, by the control
  std::complex<Scalar> control_velocity;      ///< t_v (m/(N s)): what D multiplies, by the control
  std::complex<Scalar> force_displacement;    ///< f_z (m/N): what P multiplies, by the excitation
  std::complex<Scalar> force_velocity;        ///< f_v (m/(N s)): what D multiplies, likewise
  std::complex<Scalar> control_conductor;     ///< t_c (m/N): z to the control force
  std::complex<Scalar> force_conductor;       ///< f_c (m/N): z to the excitation

  /// t_c f_z − f_c t_z, by which P enters the numerator of the controlled amplitude; 0 where z
  /// itself is measured.
  std::complex<Scalar> proportional_slope() const {
    return control_conductor * force_displacement - force_conductor * control_displacement;
  }
  /// t_c f_v − f_c t_v, by which D enters it.
  std::complex<Scalar> differential_slope() const {
    return control_conductor * force_velocity - force_conductor * control_velocity;
  }
};

/// The responses of a sampled loop to unit forces at ω, one a column of Y:
///
///     (λI − S₀) Y = [s, g],   λ = e^{iωτ}
///
/// s being how the command enters and g the phasor of the excitation, which moves no command. Of
/// the two masses the stored command is eliminated: S₀ = A_d and s = Γ₀ + Γ₁/λ.
/// @tparam Loop              `SampledLoop` of the two masses, or `LoopMap` of any order, whose
/// gains
///                           do not matter
/// @param loop               the loop
/// @param input              `harmonic_input` of the same loop and ω
/// @param angular_frequency  ω (rad/s), > 0
/// @throws InvalidParameter for an input of another size than the loop
template <class Loop, class Scalar, int States>
LoopPhasors<Scalar> loop_phasors(const Loop& loop, const HarmonicInput<Scalar, States>& input,
                                 const detail::Undeduced<Scalar>& angular_frequency) {
  using Complex = std::complex<Scalar>;
  constexpr bool closed = std::is_same_v<Loop, SampledLoop<Scalar>>;
  for (const auto* part : {&input.cosine, &input.sine})
    require_size("size of the harmonic input", part->size(), loop.increment.rows());
  const Scalar angle = angular_frequency * loop.sampling.period;
  // (λ − 1) I − (S₀ − I): both parts small and accurate where sampling is fast.
  Matrix<Complex, States> system = -loop.increment.template cast<Complex>();
  system.diagonal().array() += circle_increment(angle);
  Matrix<Complex, States, 2> sources(input.cosine.size(), 2);
  if constexpr (closed) {
    sources.col(0) = loop.present_force.template cast<Complex>() +
                     loop.previous_force.template cast<Complex>() / std::polar(Scalar(1), angle);
  } else {
    sources.col(0) = loop.command.template cast<Complex>();
  }
  sources.col(1) =
      input.cosine.template cast<Complex>() - Complex(0, 1) * input.sine.template cast<Complex>();
  const Matrix<Complex, States, 2> y = eliminated(system, sources);
  if constexpr (closed) {
    return {y(0, 0), y(1, 0), y(0, 1), y(1, 1), y(0, 0), y(0, 1)};
  } else {
    const auto of = [&y](const RowVector<Scalar, Eigen::Dynamic>& row) {
      return Matrix<Complex, 1, 2>(row.template cast<Complex>() * y);
    };
    const auto z = of(loop.displacement), v = of(loop.velocity), c = of(loop.conductor);
    return {z[0], v[0], z[1], v[1], c[0], c[1]};
  }
}

}  // namespace holdfast
