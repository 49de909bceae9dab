#pragma once

#include <cmath>
#include <complex>
#include <type_traits>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/loop_map.hpp"
#include "holdfast/control/sampled_loop.hpp"
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

/// The steady response of a sampled loop and how it moves with a parameter:
///
///     (λI − S₀) Y = Q,   (λI − S₀) Y′ = Q′ − (λ′I − S₀′) Y,   Q = [s, g],   λ = e^{iωτ}
///
/// s being how the command enters and g the phasor of the excitation, which moves no command. Of
/// the two masses the stored command is eliminated: S₀ = A_d and s = Γ₀ + Γ₁/λ.
/// @tparam Loop  `SampledLoop` of the two masses, or `LoopMap` of any order, whose gains do not
///               matter
template <class Loop>
class MovingResponse {
 public:
  using Scalar = std::decay_t<decltype(Loop::sampling.period)>;  ///< of the loop's matrices
  using Complex = std::complex<Scalar>;                          ///< the type of the phasors
  /// True for the two masses.
  static constexpr bool closed = std::is_same_v<Loop, SampledLoop<Scalar>>;
  // With a name: GCC keeps to one file whatever spells the local constant Eigen::Dynamic.
  static constexpr int states = closed ? 4 : Eigen::Dynamic;  ///< of the system that is solved
  using Input = HarmonicInput<Scalar, states>;                ///< how the force enters

  /// @param loop               the loop
  /// @param input              `harmonic_input` of the same loop and ω
  /// @param angular_frequency  ω (rad/s), > 0
  /// @throws InvalidParameter for an input of another size than the loop
  MovingResponse(const Loop& loop, const Input& input, const Scalar& angular_frequency)
      : loop_(loop) {
    for (const auto* part : {&input.cosine, &input.sine})
      require_size("size of the harmonic input", part->size(), loop.increment.rows());
    const Scalar angle = angular_frequency * loop.sampling.period;
    lambda_ = std::polar(Scalar(1), angle);
    lambda_rate_ = Complex(0, angular_frequency) * lambda_;
    // (λ − 1) I − (S₀ − I): both parts small and accurate where sampling is fast.
    system_ = -loop.increment.template cast<Complex>();
    system_.diagonal().array() += circle_increment(angle);
    response_ = eliminated(system_, sources(loop, input));
  }

  /// The responses of the conductor and of what is measured.
  LoopPhasors<Scalar> phasors() const { return read(response_); }

  /// Their derivatives along a parameter.
  /// @param rate         of the loop's matrices, per unit of the parameter: `LoopDerivative`
  /// @param input_rate   of the harmonic input, likewise
  /// @param period_rate  of τ, likewise: λ′ = iωλτ′
  template <class Rate>
  LoopPhasors<Scalar> along(const Rate& rate, const Input& input_rate,
                            const Scalar& period_rate) const {
    const Complex lambda_rate = period_rate * lambda_rate_;
    Columns right = sources(rate, input_rate);
    if constexpr (closed) {
      right.col(0) -=
          loop_.previous_force.template cast<Complex>() * (lambda_rate / (lambda_ * lambda_));
      right -= lambda_rate * response_ - rate.transition.template cast<Complex>() * response_;
    } else {
      right -= lambda_rate * response_ - rate.open_map.template cast<Complex>() * response_;
    }
    return read(eliminated(system_, right));
  }

 private:
  using Columns = Matrix<Complex, states, 2>;

  /// Q of a loop, or Q′ at a fixed λ of its rate.
  template <class LoopOrRate>
  Columns sources(const LoopOrRate& loop, const Input& input) const {
    Columns result(input.cosine.size(), 2);
    if constexpr (closed) {
      result.col(0) = loop.present_force.template cast<Complex>() +
                      loop.previous_force.template cast<Complex>() / lambda_;
    } else {
      result.col(0) = loop.command.template cast<Complex>();
    }
    result.col(1) =
        input.cosine.template cast<Complex>() - Complex(0, 1) * input.sine.template cast<Complex>();
    return result;
  }

  LoopPhasors<Scalar> read(const Columns& y) const {
    if constexpr (closed) {
      return {y(0, 0), y(1, 0), y(0, 1), y(1, 1), y(0, 0), y(0, 1)};
    } else {
      const auto of = [&y](const RowVector<Scalar, Eigen::Dynamic>& row) {
        return Matrix<Complex, 1, 2>(row.template cast<Complex>() * y);
      };
      const auto z = of(loop_.displacement), v = of(loop_.velocity), c = of(loop_.conductor);
      return {z[0], v[0], z[1], v[1], c[0], c[1]};
    }
  }

  Loop loop_;
  Complex lambda_;                  // e^{iωτ}
  Complex lambda_rate_;             // iωλ
  Matrix<Complex, states> system_;  // λI − S₀
  Columns response_;
};

/// How the harmonic input moves with τ, per second: with c_d that of the held force,
/// cosine′ = A_d c + ω sine and sine′ = −ω cosine that of the exact one.
/// @tparam Plant             anything with `excitation_input()`
/// @param plant              that of the loop
/// @param loop               `SampledLoop`, or `LoopMap` of any order
/// @param hold               how the excitation enters a sample
/// @param input              `harmonic_input` of the same loop and ω
/// @param angular_frequency  ω (rad/s), > 0
template <class Plant, class Loop, class Scalar, int States>
HarmonicInput<Scalar, States> input_derivative_by_period(
    const Plant& plant, const Loop& loop, ForceHold hold,
    const HarmonicInput<Scalar, States>& input,
    const detail::Undeduced<Scalar>& angular_frequency) {
  const Eigen::Index size = input.cosine.size();
  Vector<Scalar, States> late = Vector<Scalar, States>::Zero(size);
  if constexpr (std::is_same_v<Loop, SampledLoop<Scalar>>) {
    late = loop.transition * plant.excitation_input();
  } else {
    const Eigen::Index n = size - loop.held_commands;
    late.head(n) = loop.open_map.topLeftCorner(n, n) * plant.excitation_input();
  }
  if (hold == ForceHold::sampled) return {late, Vector<Scalar, States>::Zero(size)};
  return {late + angular_frequency * input.sine, -angular_frequency * input.cosine};
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template class MovingResponse<SampledLoop<double>>;
extern template class MovingResponse<LoopMap<double>>;
#endif

}  // namespace holdfast
