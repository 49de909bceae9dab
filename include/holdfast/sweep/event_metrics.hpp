#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

#include "holdfast/control/sampling_clock.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/plant/port_readings.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/sweep/metric_observer.hpp"
#include "holdfast/sweep/motion_metrics.hpp"

namespace holdfast {

namespace detail {

/// The relative velocity Δż (m/s) of the drive in a state. Values as small as rounding errors,
/// which occur in stick, are set to zero. For the two masses Δż is exactly zero in stick.
template <class Plant>
double drive_velocity(const PortReadings<Plant>& readings, const StateOf<Plant>& state) {
  const double velocity = readings.relative_velocity(state);
  if constexpr (HasPorts<Plant>::value) {
    constexpr double rounding = 64.0 * std::numeric_limits<double>::epsilon();
    const double size = readings.velocity_row().cwiseAbs().dot(state.cwiseAbs());
    if (std::abs(velocity) <= rounding * size) return 0.0;
  }
  return velocity;
}

/// Whether contact changes of a motion accumulate (SwitchCounts); possible for EventMotion only.
template <class Motion>
bool accumulates(const Motion&) {
  return false;
}
template <class Contact>
bool accumulates(const EventMotion<Contact>& motion) {
  return motion.counts().accumulates;
}

/// The metrics of one motion, which must be at its first sample.
template <class Motion>
MotionMetrics metrics_of_motion(Motion& motion, const SampleSpan& span,
                                const std::function<void()>& pause) {
  constexpr std::int64_t samples_between_pauses = 1 << 14;
  const auto readings = motion.readings();
  MetricObserver<double> observer;
  double velocity_before = 0.0;
  for (std::int64_t taken = 0; taken < span.samples; ++taken) {
    if (pause && taken % samples_between_pauses == 0) pause();
    if (!std::isfinite(motion.state().sum())) return diverged_metrics(observer, taken);
    const auto sample = motion.sense();
    const double displacement = readings.displacement(sample.state);
    const double velocity = drive_velocity(readings, sample.state);
    const bool reverses = is_reversal(velocity_before, velocity);
    velocity_before = velocity;
    observer.observe_extremum(displacement);
    observer.observe_load(sample.control_force, readings.relative_displacement(sample.state));
    if (sample.index == span.first_steady) observer.begin_steady(true, reverses);
    if (sample.index >= span.first_steady)
      observer.observe_steady(displacement, sample.control_force, sample.engaged, reverses);
    motion.advance();
    if (accumulates(motion)) return {MotionEnd::accumulates, taken + 1};
  }
  return completed_metrics(observer, span);
}

}  // namespace detail

/// The metrics (MotionMetrics) of one motion of an implemented loop.
///
/// The metrics are evaluated only at the samples t_j of the loop's clock, although the contact may
/// change in between. The drive counts as transmitting only in the contact mode `engaged`, not in
/// `stick`. u_j is the force transmitted at the sample. For a loop converted from an IdealLoop the
/// metrics equal those of `motion_metrics` except for rounding.
///
///     event_metrics(implemented_loop(loop), Vector<double, 4>::Zero(), 20.0).steady_peak;
///
/// Work: that of EventMotion, and about 30 operations a sample. No allocation per sample.
/// @param loop           loop with its excitation and backlash
/// @param initial_state  x, N × 1; for the two masses [z₁, ż₁, z₂, ż₂] (m, m/s, m, m/s)
/// @param duration       length of the motion (s), ≥ 0
/// @param pause          function pause(), called every 2¹⁴ samples; may throw to stop
/// @throws InvalidParameter where loop or duration is not admissible, or the state not finite
/// @tparam Plant  TwoMass<double> or a LinearPlant<double, N>
template <class Plant>
MotionMetrics event_metrics(const ImplementedLoopOf<Plant>& loop,
                            const StateOf<Plant>& initial_state, double duration,
                            const std::function<void()>& pause = {}) {
  validate(loop);
  const detail::SampleSpan span = detail::sample_span(
      0, duration, SamplingClock(loop.digital.sampling.period, loop.digital.jitter));
  auto motion = event_motion(loop, initial_state);
  return detail::metrics_of_motion(motion, span, pause);
}

}  // namespace holdfast
