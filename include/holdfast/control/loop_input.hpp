#pragma once

#include "holdfast/control/loop_map.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic_input.hpp"
#include "holdfast/plant/ports.hpp"

namespace holdfast {

/// Harmonic input of a force F_j = F_m cos(ω t_j) held over each period: cosine = c_d, sine = 0.
/// Source: Kollár 2022, Eq. (13).
template <class Scalar, int States>
HarmonicInput<Scalar, States> held_harmonic(const SampledLoop<Scalar, States>& loop) {
  return {loop.held_excitation, Vector<Scalar, States>::Zero(loop.held_excitation.size())};
}

/// Harmonic input of a force that is not held, over a sampling period (s); ω in rad/s.
template <class Plant, class Scalar = ScalarOf<Plant>>
HarmonicInput<Scalar, states_of<Plant>> exact_harmonic(
    const Plant& plant, const detail::Undeduced<Scalar>& sampling_period,
    const detail::Undeduced<Scalar>& angular_frequency) {
  return exact_harmonic<Scalar, states_of<Plant>>(plant.state_matrix(), plant.excitation_input(),
                                                  sampling_period, angular_frequency);
}

/// Input of a harmonic force, held over each sampling period or not (`hold`).
template <class Plant, class Scalar = ScalarOf<Plant>>
HarmonicInput<Scalar, states_of<Plant>> harmonic_input(
    const Plant& plant, const SampledLoop<Scalar, states_of<Plant>>& loop, ForceHold hold,
    const detail::Undeduced<Scalar>& angular_frequency) {
  return hold == ForceHold::sampled
             ? held_harmonic(loop)
             : exact_harmonic(plant, loop.sampling.period, angular_frequency);
}

/// Harmonic input of a loop of any order N and delay, (N + k) × 1, zero for the k delayed commands.
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
