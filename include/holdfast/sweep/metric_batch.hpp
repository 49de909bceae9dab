#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "holdfast/sweep/metric_group.hpp"
#include "holdfast/sweep/metric_observer.hpp"
#include "holdfast/sweep/motion_metrics.hpp"
#include "holdfast/sweep/sweep_matrices.hpp"
#include "holdfast/sweep/sweep_motion.hpp"

namespace holdfast {

namespace detail {

/// The spans of all motions, sorted by their numbers of samples. Motions with equal numbers keep
/// their order, so that successive motions can share matrices.
/// @throws InvalidParameter where a motion or the duration is not admissible
inline std::vector<SampleSpan> ordered_spans(const SweepMotion* motions, std::size_t count,
                                             double duration) {
  std::vector<SampleSpan> spans(count);
  for (std::size_t k = 0; k < count; ++k) {
    validate(motions[k]);
    spans[k] = sample_span(k, duration, SamplingClock(motions[k].loop.sampling.period));
  }
  std::stable_sort(spans.begin(), spans.end(),
                   [](const auto& a, const auto& b) { return a.samples < b.samples; });
  return spans;
}

/// Computes the metrics of motions with sorted spans, group by group.
/// @param source  SweepMatrices, or an object with its members
template <class Scalar, class Source>
void group_metrics(const SweepMotion* motions, const SampleSpan* spans, std::size_t count,
                   MotionMetrics* results, Source& source) {
  using Group = MetricGroup<Scalar, Source>;
  Group group(source);
  for (std::size_t first = 0; first < count; first += Group::lanes)
    group.compute(motions, spans + first, std::min(Group::lanes, count - first), results);
}

}  // namespace detail

/// Computes the metrics of many motions, which may differ in every parameter, in SIMD lanes.
///
///     std::vector<MotionMetrics> metrics(motions.size());
///     motion_metrics<double>(motions.data(), motions.size(), 20.0, metrics.data());
///
/// A motion's metrics do not depend on the other motions, not even in the last bit. SIMD packs and
/// scalars give equal metrics up to rounding. Memory: some 50 bytes per motion and results. Work:
/// see `detail::MetricTrack`, and a few matrix exponentials for each motion whose plant or sampling
/// differs from that of the motion before it.
/// @param motions   motions, each with an admissible loop and a finite state
/// @param count     number of motions, ≥ 0
/// @param duration  length of each motion (s), ≥ 0
/// @param results   metrics, as many as motions and in their order
/// @param source    SweepMatrices, or a derived class that observes the samples. At every sample
///                  `source` is called with the indices of the lanes' motions, the sample's index
///                  and the mask of the lanes whose drive transmits. A lane may be past the end of
///                  its motion, or repeat another lane's motion. source.pause() is called every few
///                  hundred samples and may throw to stop the computation
/// @throws InvalidParameter where a motion or the duration is not admissible
template <class Scalar, class Source = detail::SweepMatrices>
void motion_metrics(const SweepMotion* motions, std::size_t count, double duration,
                    MotionMetrics* results, Source&& source = Source()) {
  const std::vector<detail::SampleSpan> spans = detail::ordered_spans(motions, count, duration);
  detail::group_metrics<Scalar>(motions, spans.data(), count, results, source);
}

}  // namespace holdfast
