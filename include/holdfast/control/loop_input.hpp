#pragma once

#include "holdfast/control/loop_map.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic_input.hpp"
#include "holdfast/plant/ports.hpp"

namespace holdfast {

/// The harmonic input of a force that is held over each sampling period at F_j = F_m cos(ω t_j).
/// The input's cosine column is the loop's `held_excitation` c_d; its sine column is zero. Source:
/// Kollár 2022, Eq. (13).
template <class Scalar, int States>
HarmonicInput<Scalar, States> held_harmonic(const SampledLoop<Scalar, States>& loop) {
  return {loop.held_excitation, Vector<Scalar, States>::Zero(loop.held_excitation.size())};
}

/// The harmonic input of a continuous force F_m cos(ω t), not held, over one sampling period (s).
/// The argument `angular_frequency` is ω (rad/s).
template <class Plant, class Scalar = ScalarOf<Plant>>
HarmonicInput<Scalar, states_of<Plant>> exact_harmonic(
    const Plant& plant, const detail::Undeduced<Scalar>& sampling_period,
    const detail::Undeduced<Scalar>& angular_frequency) {
  return exact_harmonic<Scalar, states_of<Plant>>(plant.state_matrix(), plant.excitation_input(),
                                                  sampling_period, angular_frequency);
}

/// The harmonic input of a force of angular frequency ω (rad/s) in a plant's sampled loop. The
/// argument `hold` determines whether the force is held between samples.
template <class Plant, class Scalar = ScalarOf<Plant>>
HarmonicInput<Scalar, states_of<Plant>> harmonic_input(
    const Plant& plant, const SampledLoop<Scalar, states_of<Plant>>& loop, ForceHold hold,
    const detail::Undeduced<Scalar>& angular_frequency) {
  return hold == ForceHold::sampled
             ? held_harmonic(loop)
             : exact_harmonic(plant, loop.sampling.period, angular_frequency);
}

/// The harmonic input of a loop with a plant of order N and k delayed commands. Its columns have
/// N + k rows; the last k rows, of the commands, are 0.
template <class Plant, class Scalar = ScalarOf<Plant>>
HarmonicInput<Scalar, Eigen::Dynamic> harmonic_input(
    const Plant& plant, const LoopMap<Scalar>& map, ForceHold hold,
    const detail::Undeduced<Scalar>& angular_frequency) {
  using Column = Vector<Scalar, Eigen::Dynamic>;
  HarmonicInput<Scalar, Eigen::Dynamic> input{map.excitation, Column::Zero(map.size())};
  if (hold == ForceHold::sampled) return input;
  const auto exact = exact_harmonic(plant, map.sampling.period, angular_frequency);
  input.cosine.head(exact.cosine.size()) = exact.cosine;
  input.sine.head(exact.sine.size()) = exact.sine;
  return input;
}

}  // namespace holdfast
