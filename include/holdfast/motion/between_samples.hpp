#pragma once

#include <algorithm>

#include "holdfast/control/loop_input.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/motion/forced_loop.hpp"
#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// The state of a motion between two samples, exactly: the sampled loop of the shorter period s,
///
///     z(t_j + s) = e^{As} z_j + Γ₁(s) u_{j−1} + Γ₀(s) u_j + F_m (g_c(s) cos ω t_j + g_s(s) sin ω
///     t_j)
///
/// with the delay min(δ, s), since the contact and the force change at samples only.
/// @tparam Plant  TwoDof<double> or a LinearPlant<double, N>
template <class Plant>
class BetweenSamplesOf {
 public:
  /// N, the order of the plant.
  static constexpr int states = states_of<Plant>;

  /// @param loop  of the motion; admissible, which is not asked here
  explicit BetweenSamplesOf(const ForcedLoop<double, Plant>& loop) : loop_(loop) {}

  /// @param sample          z_j, u_j and j
  /// @param previous_force  u_{j−1} (N)
  /// @param after           s (s), 0 ≤ s ≤ τ
  /// Work: three matrix exponentials, some microseconds.
  StateOf<Plant> state(const MotionSample<double, states>& sample, double previous_force,
                       double after) const {
    const Sampling<double> part{after, std::min(loop_.sampling.processing_delay, after)};
    const SampledLoop<double, states> step = sampled_loop(loop_.plant, part);
    const HarmonicInput<double, states> input =
        harmonic_input(loop_.plant, step, loop_.hold, loop_.excitation.angular_frequency());
    const auto force = sample_excitation(loop_.excitation, loop_.sampling.period, sample.index);
    return step.transition * sample.state + step.previous_force * previous_force +
           step.present_force * sample.control_force + input.cosine * force.cosine +
           input.sine * force.sine;
  }

  /// The loop with its excitation, as given.
  const ForcedLoop<double, Plant>& loop() const { return loop_; }

 private:
  ForcedLoop<double, Plant> loop_;
};

/// That of the two masses.
using BetweenSamples = BetweenSamplesOf<TwoDof<double>>;

}  // namespace holdfast
