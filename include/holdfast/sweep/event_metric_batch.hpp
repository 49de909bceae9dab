#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "holdfast/control/sampling_clock.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/lanes.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/batch/event_pack.hpp"
#include "holdfast/motion/batch/event_table.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/sweep/metric_observer.hpp"
#include "holdfast/sweep/motion_metrics.hpp"

namespace holdfast {

/// One motion of a sweep whose contact may change between samples: its loop and initial state.
struct EventSweepMotion {
  const ImplementedLoop* loop;      ///< loop for which has_event_pack() is true
  Vector<double, 4> initial_state;  ///< initial state [z₁, ż₁, z₂, ż₂] (m, m/s, m, m/s)
};

namespace detail {

/// A motion of a batch: its start and its range of samples.
struct PreparedEventMotion {
  EventStart start;
  SampleSpan span;
};

/// The motions of a batch ordered by their numbers of samples, and the tables that they share.
struct PreparedEventMotions {
  std::vector<PreparedEventMotion> motions;
  std::vector<std::unique_ptr<EventTable>> tables;

  /// Prepares a batch. @throws InvalidParameter where a motion or the duration is not admissible
  PreparedEventMotions(const EventSweepMotion* of, std::size_t count, double duration) {
    std::vector<SampleSpan> spans(count);
    for (std::size_t k = 0; k < count; ++k) {
      const ImplementedLoop& loop = *of[k].loop;
      validate(loop);
      for (const double entry : of[k].initial_state) require_finite("initial state", entry, "SI");
      spans[k] = sample_span(k, duration, SamplingClock(loop.digital.sampling.period));
    }
    std::stable_sort(spans.begin(), spans.end(),
                     [](const auto& a, const auto& b) { return a.samples < b.samples; });
    for (const SampleSpan& span : spans) {
      const EventSweepMotion& motion = of[span.motion];
      motions.push_back({{motion.loop, &table_of(*motion.loop), motion.initial_state}, span});
    }
  }

  /// Table for a loop: the latest table that is valid for this loop, or a new one.
  EventTable& table_of(const ImplementedLoop& loop) {
    const auto serving = std::find_if(tables.rbegin(), tables.rend(),
                                      [&](const auto& table) { return table->serves(loop); });
    if (serving != tables.rend()) return **serving;
    return *tables.emplace_back(std::make_unique<EventTable>(loop));
  }
};

/// A pack of motions, one per lane, with the observations for their metrics.
template <class Scalar>
class EventMetricTrack {
 public:
  static constexpr std::size_t lanes = Lanes<Scalar>::count;

  /// Starts a pack of motions. @param motions  first of `count` motions, 1 ≤ count ≤ lanes
  EventMetricTrack(const PreparedEventMotion* motions, std::size_t count)
      : pack_(starts_of(motions, count)) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      spans_[lane] = motions[std::min(lane, count - 1)].span;
      open_[lane] = lane < count;
      if (!open_[lane]) pack_.sleep(lane);
    }
  }

  bool is_open() const { return std::find(open_.begin(), open_.end(), true) != open_.end(); }

  /// The index of the next stop of the loop over samples: the first steady sample or the end of a
  /// lane's motion, whichever comes first, or `latest` if that is earlier.
  std::int64_t next_stop(std::int64_t latest) const {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if (!open_[lane]) continue;
      latest = std::min(latest, spans_[lane].samples);
      if (spans_[lane].first_steady > pack_.index())
        latest = std::min(latest, spans_[lane].first_steady);
    }
    return latest;
  }

  /// Prepares for the samples up to the next stop (next_stop()); to be called at each stop.
  void begin_stretch() {
    const auto begin = from_lanes<Scalar>(
        [&](std::size_t lane) { return static_cast<double>(spans_[lane].first_steady); });
    begins_steady_ = begin == Scalar(static_cast<double>(pack_.index()));
    begins_ = any(begins_steady_);
    const auto found = lane_flags<Scalar>(observer_.extremum_found());
    steady_ = seeks_extremum_ = false;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if (!open_[lane]) continue;
      steady_ = steady_ || pack_.index() >= spans_[lane].first_steady;
      seeks_extremum_ = seeks_extremum_ || found[lane] == 0;
    }
  }

  /// Takes one sample and writes the metrics of the motions that end at this sample.
  void take(MotionMetrics* results) {
    close_diverged(results);
    const auto sample = pack_.sense();
    const std::array<Scalar, 4> z = pack_.state();
    const Scalar velocity = z[3] - z[1];
    const Mask<Scalar> reverses = is_reversal(velocity_before_, velocity);
    velocity_before_ = velocity;
    if (seeks_extremum_) observer_.observe_extremum(z[0]);
    observer_.observe_load(sample.control_force, Scalar(z[2] - z[0]));
    if (begins_) observer_.begin_steady(begins_steady_, reverses);
    begins_ = false;
    if (steady_) observer_.observe_steady(z[0], sample.control_force, sample.engaged, reverses);
    pack_.advance();
    if (pack_.some_accumulate()) close_accumulating(results);
  }

  void close_completed(MotionMetrics* results) {
    for (std::size_t lane = 0; lane < lanes; ++lane)
      if (open_[lane] && spans_[lane].samples == pack_.index())
        close(lane, completed_metrics(observer_.lane(lane), spans_[lane]), results);
  }

 private:
  static std::array<EventStart, lanes> starts_of(const PreparedEventMotion* motions,
                                                 std::size_t count) {
    std::array<EventStart, lanes> starts;
    for (std::size_t lane = 0; lane < lanes; ++lane)
      starts[lane] = motions[std::min(lane, count - 1)].start;
    return starts;
  }

  void close(std::size_t lane, const MotionMetrics& metrics, MotionMetrics* results) {
    open_[lane] = false;
    results[spans_[lane].motion] = metrics;
    pack_.sleep(lane);
  }

  void close_diverged(MotionMetrics* results) {
    const std::array<Scalar, 4> z = pack_.state();
    const Scalar sum = (z[0] + z[1]) + (z[2] + z[3]);
    if (all(Scalar(0) * sum == Scalar(0))) return;
    for (std::size_t lane = 0; lane < lanes; ++lane)
      if (open_[lane] && !std::isfinite(lane_of(sum, lane)))
        close(lane, diverged_metrics(observer_.lane(lane), pack_.index()), results);
  }

  void close_accumulating(MotionMetrics* results) {
    for (std::size_t lane = 0; lane < lanes; ++lane)
      if (open_[lane] && pack_.accumulates(lane))
        close(lane, {MotionEnd::accumulates, pack_.index()}, results);
  }

  EventPack<Scalar> pack_;
  MetricObserver<Scalar> observer_;
  Scalar velocity_before_ = Scalar(0);
  Mask<Scalar> begins_steady_ = Scalar(0) > Scalar(0);
  std::array<SampleSpan, lanes> spans_{};
  std::array<bool, lanes> open_{};
  bool steady_ = false, begins_ = false, seeks_extremum_ = true;
};

/// Computes the metrics of prepared motions, two packs at a time; pause() is called on the way.
template <class Scalar, class Pause>
void group_event_metrics(const PreparedEventMotion* motions, std::size_t count,
                         MotionMetrics* results, const Pause& pause) {
  constexpr std::size_t packs = 2, lanes = EventMetricTrack<Scalar>::lanes;
  constexpr std::int64_t samples_between_pauses = 256;
  std::vector<EventMetricTrack<Scalar>> tracks;
  tracks.reserve(packs);
  for (std::size_t first = 0; first < count;) {
    for (; first < count && tracks.size() < packs; first += lanes)
      tracks.emplace_back(motions + first, std::min(lanes, count - first));
    for (std::int64_t index = 0; !tracks.empty();) {
      pause();
      std::int64_t end = index + samples_between_pauses;
      for (auto& track : tracks) end = track.next_stop(end);
      for (auto& track : tracks) track.begin_stretch();
      for (; index < end; ++index)
        for (auto& track : tracks) track.take(results);
      for (auto& track : tracks) track.close_completed(results);
      const auto ended = [](const auto& track) { return !track.is_open(); };
      tracks.erase(std::remove_if(tracks.begin(), tracks.end(), ended), tracks.end());
    }
  }
}

}  // namespace detail

/// Computes the metrics of many motions whose contact may change between samples. The type `Scalar`
/// is a SIMD pack with one motion in each lane, or `double`. Motions may differ in every parameter.
///
/// Except for rounding, a motion's metrics equal those of event_metrics() for one motion. They do
/// not depend on the other motions. Work: that of EventPack, and a few matrix exponentials for each
/// different plant, sampling and force.
/// @param motions   motions; has_event_pack() is true for each loop, and each state is finite
/// @param count     number of motions, ≥ 0
/// @param duration  length of each motion (s), ≥ 0
/// @param results   metrics, as many as motions and in their order
/// @param pause     function pause(), called every few hundred samples; may throw to stop
/// @throws InvalidParameter where a motion or the duration is not admissible
template <class Scalar, class Pause>
void event_metrics(const EventSweepMotion* motions, std::size_t count, double duration,
                   MotionMetrics* results, const Pause& pause) {
  const detail::PreparedEventMotions prepared(motions, count, duration);
  detail::group_event_metrics<Scalar>(prepared.motions.data(), count, results, pause);
}

}  // namespace holdfast
