#pragma once

#include "holdfast/control/loop_map.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic_input.hpp"
#include "holdfast/plant/ports.hpp"

namespace holdfast {

/// The response to a force held over each sampling period at F_j = F_m cos(ω t_j). Its cosine
/// column is the loop's `held_excitation` c_d; its sine column is 0. Source: Kollár 2022, Eq. (13).
template <class Scalar, int States>
HarmonicInput<Scalar, States> held_harmonic(const SampledLoop<Scalar, States>& loop) {
  return {loop.held_excitation, Vector<Scalar, States>::Zero(loop.held_excitation.size())};
}

/// The response of a plant over one `sampling_period` (s) to a force F_m cos(ω t) that is not held;
/// `angular_frequency` is ω (rad/s).
template <class Plant, class Scalar = ScalarOf<Plant>>
HarmonicInput<Scalar, states_of<Plant>> exact_harmonic(
    const Plant& plant, const detail::Undeduced<Scalar>& sampling_period,
    const detail::Undeduced<Scalar>& angular_frequency) {
  return exact_harmonic<Scalar, states_of<Plant>>(plant.state_matrix(), plant.excitation_input(),
                                                  sampling_period, angular_frequency);
}

/// The response of a plant over one sampling period to a force F_m cos(ω t), held between samples
/// or not according to `hold`; `angular_frequency` is ω (rad/s).
template <class Plant, class Scalar = ScalarOf<Plant>>
HarmonicInput<Scalar, states_of<Plant>> harmonic_input(
    const Plant& plant, const SampledLoop<Scalar, states_of<Plant>>& loop, ForceHold hold,
    const detail::Undeduced<Scalar>& angular_frequency) {
  return hold == ForceHold::sampled
             ? held_harmonic(loop)
             : exact_harmonic(plant, loop.sampling.period, angular_frequency);
}

/// The response of a loop, with k delayed commands and a plant of order N, over one sampling period
/// to a force F_m cos(ω t). Its columns have N + k rows; the last k rows, of the commands, are 0.
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
