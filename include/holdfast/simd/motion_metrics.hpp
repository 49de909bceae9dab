#pragma once

#include <cstddef>

#include "holdfast/simd/pack.hpp"
#include "holdfast/sweep/metric_batch.hpp"

namespace holdfast::simd {

/// motion_metrics() on SIMD packs, by the calling thread.
///
///     simd::motion_metrics(motions.data(), motions.size(), 20.0, metrics.data());
///
/// Disjoint parts of the motions may be computed by several threads at a time; the results do not
/// depend on the parts.
/// @throws InvalidParameter where a motion or the duration is not admissible
inline void motion_metrics(const SweepMotion* motions, std::size_t count, double duration,
                           MotionMetrics* results) {
  holdfast::motion_metrics<Pack<double>>(motions, count, duration, results);
}

}  // namespace holdfast::simd
