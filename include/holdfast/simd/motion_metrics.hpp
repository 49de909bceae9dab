#pragma once

#include <cstddef>

#include "holdfast/simd/pack.hpp"
#include "holdfast/sweep/metric_batch.hpp"

namespace holdfast::simd {

/// Computes the metrics of a sweep's motions on SIMD packs in the calling thread. The duration of
/// the motions is in s, ≥ 0.
///
///     simd::motion_metrics(motions.data(), motions.size(), 20.0, metrics.data());
///
/// Threads may compute disjoint parts of the motions at once, with the same results.
/// @throws InvalidParameter where a motion or the duration is not admissible
inline void motion_metrics(const SweepMotion* motions, std::size_t count, double duration,
                           MotionMetrics* results) {
  holdfast::motion_metrics<Pack<double>>(motions, count, duration, results);
}

}  // namespace holdfast::simd
