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

/// The samples of all motions, neighbours of about equal numbers of them; equal ones keep their
/// order, and so what they share.
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

/// The metrics of motions whose samples are known and ordered, group by group.
/// @param source  SweepMatrices or its like
template <class Scalar, class Source>
void group_metrics(const SweepMotion* motions, const SampleSpan* spans, std::size_t count,
                   MotionMetrics* results, Source& source) {
  using Group = MetricGroup<Scalar, Source>;
  Group group(source);
  for (std::size_t first = 0; first < count; first += Group::lanes)
    group.compute(motions, spans + first, std::min(Group::lanes, count - first), results);
}

}  // namespace detail

/// The metrics of many motions, which may differ in every parameter, as many at a time as `Scalar`
/// has lanes.
///
///     std::vector<MotionMetrics> metrics(motions.size());
///     motion_metrics<double>(motions.data(), motions.size(), 20.0, metrics.data());
///
/// A motion's metrics do not depend on the others, to the last bit; on packs and scalars they are
/// the same but for rounding. Memory: some 50 bytes a motion beside the results. Work: see
/// `detail::MetricTrack`; before that a motion costs a few matrix exponentials, unless the one
/// before it among those of equal numbers of samples has the same plant and sampling.
/// @param motions   each with an admissible loop and a finite state
/// @param count     number of motions, ≥ 0
/// @param duration  s, ≥ 0
/// @param results   as many, in the order of the motions
/// @param source    SweepMatrices, or what is derived from it to be called at every sample j with
///                  the numbers of the motions in the lanes, j, and the mask of the lanes that
///                  transmit; also beyond a motion's last sample, and for a motion that repeats in
///                  spare lanes or is done again; and its pause() every some hundred samples, which
///                  may throw to end all
/// @throws InvalidParameter where a motion or the duration is not admissible
template <class Scalar, class Source = detail::SweepMatrices>
void motion_metrics(const SweepMotion* motions, std::size_t count, double duration,
                    MotionMetrics* results, Source&& source = Source()) {
  const std::vector<detail::SampleSpan> spans = detail::ordered_spans(motions, count, duration);
  detail::group_metrics<Scalar>(motions, spans.data(), count, results, source);
}

}  // namespace holdfast
