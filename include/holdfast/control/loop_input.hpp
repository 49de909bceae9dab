#pragma once

#include "holdfast/control/loop_map.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic_input.hpp"
#include "holdfast/plant/ports.hpp"

namespace holdfast {

/// The input of a force held over each period, F_j = F_m cos(ω t_j): cosine = c_d, sine = 0.
/// Source: Kollár 2022, Eq. (13).
template <class Scalar, int States>
HarmonicInput<Scalar, States> held_harmonic(const SampledLoop<Scalar, States>& loop) {
  return {loop.held_excitation, Vector<Scalar, States>::Zero(loop.held_excitation.size())};
}

/// The input of the exact harmonic force over a sampling period (s); ω in rad/s.
template <class Plant, class Scalar = ScalarOf<Plant>>
HarmonicInput<Scalar, states_of<Plant>> exact_harmonic(
    const Plant& plant, const detail::Undeduced<Scalar>& sampling_period,
    const detail::Undeduced<Scalar>& angular_frequency) {
  return exact_harmonic<Scalar, states_of<Plant>>(plant.state_matrix(), plant.excitation_input(),
                                                  sampling_period, angular_frequency);
}

/// The input of the harmonic force with either hold.
template <class Plant, class Scalar = ScalarOf<Plant>>
HarmonicInput<Scalar, states_of<Plant>> harmonic_input(
    const Plant& plant, const SampledLoop<Scalar, states_of<Plant>>& loop, ForceHold hold,
    const detail::Undeduced<Scalar>& angular_frequency) {
  return hold == ForceHold::sampled
             ? held_harmonic(loop)
             : exact_harmonic(plant, loop.sampling.period, angular_frequency);
}

/// The harmonic input of a loop of any order and delay, (N + k) × 1, with 0 at the stored commands.
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
