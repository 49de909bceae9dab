#pragma once

#include <algorithm>

#include "holdfast/control/loop_input.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/sampled_motion.hpp"
#include "support/reference/sample_excitation.hpp"

namespace holdfast::test {

/// The state of a sampled motion between two samples by matrix exponentials, as an oracle for the
/// Taylor series of the event-driven flow: the sampled loop of the shorter period s,
///
///     z(t_j + s) = e^{As} z_j + Γ₁(s) u_{j−1} + Γ₀(s) u_j + F_m (g_c(s) cos ω t_j + g_s(s) sin ω
///     t_j)
///
/// with the delay min(δ, s), since the contact and the force change at samples only.
/// @param sample          z_j, u_j and j
/// @param previous_force  u_{j−1} (N)
/// @param after           s (s), 0 ≤ s ≤ τ
inline Vector<double, 4> state_between_samples(const IdealLoop<double>& loop,
                                               const MotionSample<double>& sample,
                                               double previous_force, double after) {
  const Sampling<double> part{after, std::min(loop.sampling.processing_delay, after)};
  const SampledLoop<double> step = sampled_loop(loop.plant, part);
  const HarmonicInput<double> input =
      harmonic_input(loop.plant, step, loop.hold, loop.excitation.angular_frequency());
  const auto force = sample_excitation(loop.excitation, loop.sampling.period, sample.index);
  return step.transition * sample.state + step.previous_force * previous_force +
         step.present_force * sample.control_force + input.cosine * force.cosine +
         input.sine * force.sine;
}

}  // namespace holdfast::test
