#pragma once

#include <cstddef>

#include "holdfast/simd/pack.hpp"
#include "holdfast/sweep/metric_batch.hpp"

namespace holdfast::simd {

/// Simulates `count` motions in SIMD lanes and computes the peaks, rms values etc. of each motion.
///
///     simd::motion_metrics(motions.data(), motions.size(), 20.0, metrics.data());
///
/// `results` must have room for `count` entries; `duration` is the simulated time (s) of a motion,
/// ≥ 0. Only the calling thread computes; several threads may call it for different motions.
/// @throws InvalidParameter where a motion or the duration is not admissible
inline void motion_metrics(const SweepMotion* motions, std::size_t count, double duration,
                           MotionMetrics* results) {
  holdfast::motion_metrics<Pack<double>>(motions, count, duration, results);
}

}  // namespace holdfast::simd
