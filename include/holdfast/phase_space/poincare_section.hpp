#pragma once

#include <cmath>
#include <cstdint>

#include "holdfast/core/types.hpp"
#include "holdfast/math/roots/bracketing_root.hpp"
#include "holdfast/motion/between_samples.hpp"
#include "holdfast/motion/forced_loop.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// A point of the Poincaré section Δż = 0, where the absorber and the conductor have the same
/// velocity: the drive reverses there.
struct SectionPoint {
  double time;              ///< s
  Vector<double, 4> state;  ///< [z₁, ż₁, z₂, ż₂] (m, m/s), ż₂ = ż₁
  bool rising;              ///< Δż goes from negative to positive
  bool engaged;             ///< the drive transmits during this sampling period
};

namespace detail {

/// The crossings within one sampling period, one at most before the new force arrives and one
/// after.
template <class Observer>
void cross_section(const BetweenSamples& between, const MotionSample<double>& sample,
                   double previous_force, const Vector<double, 4>& next, Observer&& observer) {
  const Sampling<double>& sampling = between.loop().sampling;
  const auto state_after = [&](double after) {
    return between.state(sample, previous_force, after);
  };
  const double ends[] = {0.0, sampling.processing_delay, sampling.period};
  const bool in_parts =
      sampling.processing_delay > 0.0 && sampling.processing_delay < sampling.period;
  double lower = 0.0, value_at_lower = relative_velocity(sample.state);
  for (int part = in_parts ? 1 : 2; part <= 2; ++part) {
    const double upper = ends[part];
    const double value = relative_velocity(part == 2 ? next : state_after(upper));
    const bool rising = value_at_lower < 0.0 && value >= 0.0;
    const bool falling = value_at_lower > 0.0 && value <= 0.0;
    if (rising || falling) {
      const auto root = bracketing_root(
          [&](double after) { return relative_velocity(state_after(after)); },
          SignChange<double>{lower, upper, value_at_lower, value}, 1e-12 * sampling.period);
      const double after = root.upper;
      observer(SectionPoint{sample.time + after, state_after(after), rising, sample.engaged});
    }
    lower = upper;
    value_at_lower = value;
  }
}

}  // namespace detail

/// Runs a motion and shows every crossing of the section Δż = 0, located between the samples.
///
/// A crossing is seen where Δż has opposite signs at the two ends of a sampling period, or of its
/// parts before and after the new force; two within one part are not.
/// @param loop      that of the motion
/// @param motion    before the first sample to be looked at
/// @param samples   how many sampling periods
/// @param observer  called with each `SectionPoint`, in the order of time
/// Work: some twenty matrix exponentials a crossing.
template <class Motion, class Observer>
TrajectoryOutcome run_section(const ForcedLoop<double>& loop, Motion& motion, std::int64_t samples,
                              Observer&& observer) {
  const BetweenSamples between(loop);
  for (std::int64_t taken = 0; taken < samples; ++taken) {
    const double previous_force = motion.memory().previous_force;
    const MotionSample<double> sample = motion.sense();
    motion.advance();
    if (!std::isfinite(motion.state().sum())) return TrajectoryOutcome::diverged;
    detail::cross_section(between, sample, previous_force, motion.state(), observer);
  }
  return TrajectoryOutcome::completed;
}

}  // namespace holdfast
