#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "holdfast/control/sampling_clock.hpp"
#include "holdfast/core/lanes.hpp"
#include "holdfast/core/select.hpp"
#include "holdfast/motion/instant.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "holdfast/sweep/motion_metrics.hpp"

namespace holdfast {

/// Whether a velocity that was nonzero `before` is zero or of opposite sign `now`. At a reversal of
/// Δż the drive enters its gap (contact/hysteresis.hpp). For packs: one result per lane.
template <class Scalar>
Mask<Scalar> is_reversal(const Scalar& before, const Scalar& now) {
  const Scalar zero(0);
  return ((before > zero) & (now <= zero)) | ((before < zero) & (now >= zero));
}

/// Sums and peaks over samples, from which MotionMetrics are computed. A SIMD pack has one motion
/// per lane. The caller decides which samples are steady (at or after half the duration).
template <class Scalar>
struct MetricObserver {
  static constexpr double infinity = std::numeric_limits<double>::infinity();  ///< plus infinity

  Scalar before_last = Scalar(MotionMetrics::unknown);  ///< z₁ (m) two samples ago; NaN: none yet
  Scalar last = Scalar(MotionMetrics::unknown);         ///< z₁ (m) one sample ago; NaN: none yet
  Scalar first_peak = Scalar(MotionMetrics::unknown);   ///< |z₁| (m) at first extremum; NaN: none
  Scalar force_peak = Scalar(0);                        ///< largest control force |u| (N)
  Scalar highest = Scalar(-infinity);                   ///< largest relative displacement Δz (m)
  Scalar lowest = Scalar(infinity);                     ///< smallest relative displacement Δz (m)
  Scalar steady_peak = Scalar(0);                       ///< max |z₁| (m) of the steady samples
  Scalar squares = Scalar(0);                           ///< Σ z₁² (m²) of the steady samples
  Scalar force_squares = Scalar(0);                     ///< Σ u² (N²) of the steady samples
  Scalar engaged = Scalar(0);    ///< number of steady samples at which the drive transmits
  Scalar reversals = Scalar(0);  ///< number of reversals of Δż between successive steady samples

  /// Updates `first_peak` with the displacement z₁ (m) of a sample. An extremum is recognised one
  /// sample later. Work: about 4 comparisons and 3 selects.
  void observe_extremum(const Scalar& displacement) {
    using std::abs;
    // At the first two samples the comparisons are with NaN and therefore false.
    const Mask<Scalar> turns = ((last > before_last) & (displacement < last)) |
                               ((last < before_last) & (displacement > last));
    first_peak = select(without<Scalar>(turns, extremum_found()), Scalar(abs(last)), first_peak);
    before_last = last;
    last = displacement;
  }

  /// The lanes whose first extremum has been found.
  Mask<Scalar> extremum_found() const { return first_peak == first_peak; }

  /// Updates the extreme values with a sample's force u (N) and relative displacement Δz (m).
  void observe_load(const Scalar& force, const Scalar& relative_displacement) {
    using std::abs;
    using std::max;
    using std::min;
    force_peak = max(force_peak, Scalar(abs(force)));
    highest = max(highest, relative_displacement);
    lowest = min(lowest, relative_displacement);
  }

  /// Adds a steady sample to the sums and peaks.
  /// @param displacement  conductor's displacement z₁ (m)
  /// @param force         control force u (N)
  /// @param transmits     whether the drive transmits
  /// @param reverses      whether Δż reversed (is_reversal()) since the previous sample
  void observe_steady(const Scalar& displacement, const Scalar& force,
                      const Mask<Scalar>& transmits, const Mask<Scalar>& reverses) {
    using std::abs;
    using std::max;
    const Scalar zero(0), one(1);
    steady_peak = max(steady_peak, Scalar(abs(displacement)));
    squares = squares + displacement * displacement;
    force_squares = force_squares + force * force;
    engaged = engaged + select(transmits, one, zero);
    reversals = reversals + select(reverses, one, zero);
  }

  /// Resets the sums over steady samples; to be called before the first steady sample of a lane.
  /// @param lanes     lanes to be reset
  /// @param reverses  whether Δż reverses at the first steady sample; this reversal is not counted
  void begin_steady(const Mask<Scalar>& lanes, const Mask<Scalar>& reverses) {
    const Scalar zero(0);
    for (Scalar* sum : {&steady_peak, &squares, &force_squares, &engaged})
      *sum = select(lanes, zero, *sum);
    reversals = select(lanes, select(reverses, Scalar(-1), zero), reversals);
  }

  /// The sums and peaks of one lane.
  MetricObserver<double> lane(std::size_t lane) const {
    MetricObserver<double> kept;
    kept.first_peak = detail::lane_of(first_peak, lane);
    kept.force_peak = detail::lane_of(force_peak, lane);
    kept.highest = detail::lane_of(highest, lane);
    kept.lowest = detail::lane_of(lowest, lane);
    kept.steady_peak = detail::lane_of(steady_peak, lane);
    kept.squares = detail::lane_of(squares, lane);
    kept.force_squares = detail::lane_of(force_squares, lane);
    kept.engaged = detail::lane_of(engaged, lane);
    kept.reversals = detail::lane_of(reversals, lane);
    return kept;
  }
};

namespace detail {

/// The range of samples of one motion.
struct SampleSpan {
  std::size_t motion;         ///< index of the motion
  std::int64_t first_steady;  ///< index of the first steady sample; = samples where there is none
  std::int64_t samples;       ///< number of samples, ≥ 1
  double steady_time;         ///< time (s) from the first steady sample to the last
};

/// Range of samples of a motion up to `duration` (s). Samples at or after duration/2 are steady.
/// @throws InvalidParameter where the duration, the period or the number is not admissible
inline SampleSpan sample_span(std::size_t motion, double duration, const SamplingClock& clock) {
  std::int64_t samples = samples_within(duration, clock.period());
  if (clock.jitter().half_width > 0.0) {
    // No sample deviates by half a period from the grid, and each comes after the one before.
    while (not_before(duration, clock.time(samples))) ++samples;
    while (!not_before(duration, clock.time(samples - 1))) --samples;
  }
  const auto is_steady = [&](std::int64_t index) {
    return not_before(clock.time(index), 0.5 * duration);
  };
  // The quotient is correct to within a sample or two.
  const double near = std::floor(0.5 * duration / clock.period()) - 2.0;
  std::int64_t first = std::min(near > 0.0 ? static_cast<std::int64_t>(near) : 0, samples);
  while (first > 0 && is_steady(first - 1)) --first;
  while (first < samples && !is_steady(first)) ++first;
  return {motion, first, samples, clock.time(samples - 1) - clock.time(first)};
}

inline MotionMetrics completed_metrics(const MetricObserver<double>& seen, const SampleSpan& span) {
  MotionMetrics metrics{MotionEnd::completed, span.samples, seen.first_peak};
  metrics.force_peak = seen.force_peak;
  metrics.absorber_stroke = seen.highest - seen.lowest;
  const auto count = static_cast<double>(span.samples - span.first_steady);
  if (count == 0.0) return metrics;
  metrics.steady_peak = seen.steady_peak;
  metrics.steady_rms = std::sqrt(seen.squares / count);
  metrics.engaged_fraction = seen.engaged / count;
  metrics.force_rms = std::sqrt(seen.force_squares / count);
  if (span.steady_time > 0.0) metrics.reversals_per_s = seen.reversals / span.steady_time;
  return metrics;
}

/// Metrics of a diverged motion. @param samples  number of samples with a finite state
inline MotionMetrics diverged_metrics(const MetricObserver<double>& seen, std::int64_t samples) {
  MotionMetrics metrics{MotionEnd::diverged, samples, seen.first_peak};
  for (double* number : {&metrics.steady_peak, &metrics.steady_rms, &metrics.force_peak,
                         &metrics.force_rms, &metrics.absorber_stroke})
    *number = std::numeric_limits<double>::infinity();
  return metrics;
}

}  // namespace detail
}  // namespace holdfast
