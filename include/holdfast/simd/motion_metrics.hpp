#pragma once

#include <cstddef>

#include "holdfast/simd/pack.hpp"
#include "holdfast/sweep/metric_batch.hpp"

namespace holdfast::simd {

/// Computes motion_metrics() on SIMD packs in the calling thread; `duration` in s, ≥ 0.
///
///     simd::motion_metrics(motions.data(), motions.size(), 20.0, metrics.data());
///
/// Several threads may compute disjoint parts of the motions at the same time; the results do not
/// depend on the division into parts.
/// @throws InvalidParameter where a motion or the duration is not admissible
inline void motion_metrics(const SweepMotion* motions, std::size_t count, double duration,
                           MotionMetrics* results) {
  holdfast::motion_metrics<Pack<double>>(motions, count, duration, results);
}

}  // namespace holdfast::simd
