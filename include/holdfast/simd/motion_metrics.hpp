#pragma once

#include <cstddef>

#include "holdfast/simd/pack.hpp"
#include "holdfast/sweep/metric_batch.hpp"

namespace holdfast::simd {

/// Computes the metrics of `count` motions of a sweep on SIMD packs in the calling thread.
/// `results` has `count` entries; `duration` is the simulated time of each motion in s, ≥ 0.
///
///     simd::motion_metrics(motions.data(), motions.size(), 20.0, metrics.data());
///
/// Several threads may each compute a part of the motions; the results are the same.
/// @throws InvalidParameter where a motion or the duration is not admissible
inline void motion_metrics(const SweepMotion* motions, std::size_t count, double duration,
                           MotionMetrics* results) {
  holdfast::motion_metrics<Pack<double>>(motions, count, duration, results);
}

}  // namespace holdfast::simd
