#pragma once

#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic_input.hpp"

namespace holdfast {

/// The force held over the sample, F_j = F_m cos(ω t_j): cosine = c_d, sine = 0.
/// Source: Kollár 2022, Eq. (13).
template <class Scalar>
HarmonicInput<Scalar> held_harmonic(const SampledLoop<Scalar>& loop) {
  return {loop.held_excitation, Vector<Scalar, 4>::Zero()};
}

/// The input for either hold of the force.
template <class Scalar, template <class> class Plant>
HarmonicInput<Scalar> harmonic_input(const Plant<Scalar>& plant, const SampledLoop<Scalar>& loop,
                                     ForceHold hold, const Scalar& angular_frequency) {
  return hold == ForceHold::sampled
             ? held_harmonic(loop)
             : exact_harmonic(plant, loop.sampling.period, angular_frequency);
}

}  // namespace holdfast
