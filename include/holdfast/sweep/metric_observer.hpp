#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "holdfast/core/lanes.hpp"
#include "holdfast/core/select.hpp"
#include "holdfast/motion/instant.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "holdfast/sweep/motion_metrics.hpp"

namespace holdfast::detail {

/// What the samples of one motion leave for its metrics.
struct LaneSums {
  double first_peak, force_peak, stroke;
  SteadySums<double> steady;
};

/// What the metrics of one motion, or of as many as a pack has lanes, need of its samples. The
/// drivers, MetricTrack of the sampled map and EventTrack of the event-driven flow, decide which
/// samples are looked at.
template <class Scalar>
class MetricObserver {
 public:
  /// Takes u and Δz of a sample.
  /// @param readings  of the plant
  template <class Sample, class Readings>
  void observe_load(const Sample& sample, const Readings& readings) {
    load_.observe(sample.control_force, readings.relative_displacement(sample.state));
  }
  /// Takes a steady sample. @param reverses  whether Δż changed its sign since the one before
  template <class Sample, class Readings>
  void observe_steady(const Sample& sample, const Readings& readings,
                      const Mask<Scalar>& reverses) {
    steady_.observe(readings.displacement(sample.state), sample.control_force, sample.engaged,
                    reverses);
  }
  /// Takes z of a sample; NaN where no extremum is sought any more.
  void observe_extremum(const Scalar& displacement) { extremum_.observe(displacement); }

  /// Begins the steady samples of the lanes in the mask, at the sample about to be taken.
  /// @param reverses  of that sample
  void begin_steady(const Mask<Scalar>& lanes, const Mask<Scalar>& reverses) {
    steady_.restart(lanes, reverses);
  }

  /// The lanes in which there is a first extremum by now.
  Mask<Scalar> extremum_found() const { return extremum_.found(); }

  /// All that one lane holds.
  LaneSums lane(std::size_t lane) const {
    const auto number = [lane](const Scalar& pack) {
      double values[Lanes<Scalar>::count];
      Lanes<Scalar>::store(pack, values);
      return values[lane];
    };
    return {number(extremum_.size()),
            number(load_.force()),
            number(load_.stroke()),
            {number(steady_.peak), number(steady_.squares), number(steady_.force_squares),
             number(steady_.engaged), number(steady_.reversals)}};
  }

 private:
  FirstExtremum<Scalar> extremum_;
  LoadExtent<Scalar> load_;
  SteadySums<Scalar> steady_;
};

/// The samples of one motion.
struct SampleSpan {
  std::size_t motion;         ///< its number
  double period;              ///< τ (s)
  std::int64_t first_steady;  ///< ≤ samples; as many as there are samples where none is steady
  std::int64_t samples;       ///< ≥ 1
};

/// @throws InvalidParameter where there is no such number of samples
inline SampleSpan sample_span(std::size_t motion, double duration, double period) {
  SampleSpan span{motion, period, 0, samples_within(duration, period)};
  const auto is_steady = [&](std::int64_t index) {
    return not_before(static_cast<double>(index) * period, 0.5 * duration);
  };
  // Half the duration by division is right to a sample or two.
  const double near = std::floor(0.5 * duration / period) - 2.0;
  span.first_steady = near > 0.0 ? static_cast<std::int64_t>(near) : 0;
  while (span.first_steady > 0 && is_steady(span.first_steady - 1)) --span.first_steady;
  while (span.first_steady < span.samples && !is_steady(span.first_steady)) ++span.first_steady;
  return span;
}

inline MotionMetrics completed_metrics(const LaneSums& sums, const SampleSpan& span) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  MotionMetrics metrics{
      MotionEnd::completed, span.samples, sums.first_peak, nan, nan, nan, sums.force_peak, nan, nan,
      sums.stroke};
  const auto count = static_cast<double>(span.samples - span.first_steady);
  if (count == 0.0) return metrics;
  metrics.steady_peak = sums.steady.peak;
  metrics.steady_rms = std::sqrt(sums.steady.squares / count);
  metrics.engaged_fraction = sums.steady.engaged / count;
  metrics.force_rms = std::sqrt(sums.steady.force_squares / count);
  const double first = static_cast<double>(span.first_steady) * span.period;
  const double last = static_cast<double>(span.samples - 1) * span.period;
  if (last > first) metrics.reversals_per_s = sums.steady.reversals / (last - first);
  return metrics;
}

/// @param samples  with a finite state
inline MotionMetrics diverged_metrics(const LaneSums& sums, std::int64_t samples) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {MotionEnd::diverged,
          samples,
          sums.first_peak,
          infinity,
          infinity,
          nan,
          infinity,
          infinity,
          nan,
          infinity};
}

}  // namespace holdfast::detail
