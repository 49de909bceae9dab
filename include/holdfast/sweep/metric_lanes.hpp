#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "holdfast/motion/instant.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "holdfast/sweep/metric_observer.hpp"
#include "holdfast/sweep/motion_metrics.hpp"

namespace holdfast::detail {

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
