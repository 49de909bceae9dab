#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

#include "holdfast/control/sampling_clock.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/motion/instant.hpp"
#include "holdfast/plant/port_readings.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/sweep/metric_observer.hpp"
#include "holdfast/sweep/motion_metrics.hpp"

namespace holdfast {

namespace detail {

/// The samples of a motion whose clock may jitter: those not after the duration, and of them those
/// not before half of it.
inline SampleSpan sample_span(const SamplingClock& clock, double duration) {
  SampleSpan span = sample_span(0, duration, clock.period());
  if (clock.jitter().half_width == 0.0) return span;
  // No sample deviates by half a period from the grid, and each comes after the one before.
  while (not_before(duration, clock.time(span.samples))) ++span.samples;
  while (!not_before(duration, clock.time(span.samples - 1))) --span.samples;
  const auto is_steady = [&](std::int64_t index) {
    return not_before(clock.time(index), 0.5 * duration);
  };
  std::int64_t& first = span.first_steady;
  first = std::min(first, span.samples);
  while (first > 0 && is_steady(first - 1)) --first;
  while (first < span.samples && !is_steady(first)) ++first;
  return span;
}

/// Of a motion whose changes of contact accumulate after some samples.
inline MotionMetrics unfollowed_metrics(std::int64_t samples) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  return {MotionEnd::accumulates, samples, nan, nan, nan, nan, nan, nan, nan, nan};
}

/// Takes the samples of one motion, each into all that is kept of them.
template <class Plant>
class EventTrack {
  using Sample = EventSampleOf<states_of<Plant>>;

 public:
  EventTrack(const SampleSpan& span, const PortReadings<Plant>& readings)
      : span_(span), readings_(readings) {}

  void observe(const Sample& sample) {
    const double velocity = velocity_of(sample.state);
    const bool reverses = is_reversal(previous_velocity_, velocity);
    previous_velocity_ = velocity;
    observer_.observe_extremum(readings_.displacement(sample.state));
    observer_.observe_load(sample, readings_);
    if (sample.index < span_.first_steady) return;
    if (sample.index == span_.first_steady) observer_.begin_steady(true, reverses);
    observer_.observe_steady(sample, readings_, reverses);
  }

  MotionMetrics completed(const SamplingClock& clock) const {
    const LaneSums sums = observer_.lane(0);
    MotionMetrics metrics = completed_metrics(sums, span_);
    const double time = clock.time(span_.samples - 1) - clock.time(span_.first_steady);
    if (time > 0.0) metrics.reversals_per_s = sums.steady.reversals / time;
    return metrics;
  }

  /// @param samples  with a finite state
  MotionMetrics diverged(std::int64_t samples) const {
    return diverged_metrics(observer_.lane(0), samples);
  }

 private:
  /// Δż; zero where the ports leave nothing of it but rounding, as in a stick. The two masses have
  /// ż₂ = ż₁ there to the last bit.
  double velocity_of(const StateOf<Plant>& state) const {
    const double velocity = readings_.relative_velocity(state);
    if constexpr (HasPorts<Plant>::value) {
      constexpr double rounding = 64.0 * std::numeric_limits<double>::epsilon();
      const double size = readings_.velocity_row().cwiseAbs().dot(state.cwiseAbs());
      if (std::abs(velocity) <= rounding * size) return 0.0;
    }
    return velocity;
  }

  SampleSpan span_;
  PortReadings<Plant> readings_;
  MetricObserver<double> observer_;
  double previous_velocity_ = 0.0;
};

}  // namespace detail

/// The metrics of sweep/motion_metrics.hpp for one motion of an implemented loop.
///
/// All is taken at the samples, t_j of the loop's clock, also where the drive switches between
/// them: a sample transmits where the drive is `engaged` (a stick is not), and the force u_j is
/// what the drive transmits there. Of the loop of the paper's model the metrics are those of
/// `motion_metrics`, but for rounding.
///
///     event_metrics(implemented_loop(loop), Vector<double, 4>::Zero(), 20.0).steady_peak;
///
/// Work: that of EventMotion, and about 30 operations a sample. The loop over samples allocates
/// nothing.
/// @param loop           as it is built
/// @param initial_state  x, N × 1; of the two masses [z₁, ż₁, z₂, ż₂] (m, m/s, m, m/s)
/// @param duration       s, ≥ 0
/// @param pause          called every 2¹⁴ samples; may throw to end the motion
/// @throws InvalidParameter where the loop or the duration is not admissible, or the state not
/// finite
/// @tparam Plant  TwoMass<double> or a LinearPlant<double, N>
template <class Plant>
MotionMetrics event_metrics(const ImplementedLoopOf<Plant>& loop,
                            const StateOf<Plant>& initial_state, double duration,
                            const std::function<void()>& pause = {}) {
  constexpr std::int64_t samples_between_pauses = 1 << 14;
  validate(loop);
  for (const double entry : initial_state) require_finite("initial state", entry, "SI");
  const SamplingClock clock(loop.digital.sampling.period, loop.digital.jitter);
  const detail::SampleSpan span = detail::sample_span(clock, duration);
  auto motion = event_motion(loop, initial_state);
  detail::EventTrack<Plant> track(span, motion.readings());
  for (std::int64_t taken = 0; taken < span.samples; ++taken) {
    if (pause && taken % samples_between_pauses == 0) pause();
    if (!std::isfinite(motion.state().sum())) return track.diverged(taken);
    track.observe(motion.sense());
    motion.advance();
    if (motion.counts().accumulates) return detail::unfollowed_metrics(taken + 1);
  }
  return track.completed(clock);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template MotionMetrics event_metrics(const ImplementedLoop&, const Vector<double, 4>&,
                                            double, const std::function<void()>&);
#endif

}  // namespace holdfast
