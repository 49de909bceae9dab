#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/lanes.hpp"
#include "holdfast/core/select.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/forcing.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/excitation/phasor_table.hpp"
#include "holdfast/sweep/metric_observer.hpp"
#include "holdfast/sweep/metric_track.hpp"
#include "holdfast/sweep/motion_metrics.hpp"
#include "holdfast/sweep/sweep_matrices.hpp"
#include "holdfast/sweep/sweep_motion.hpp"

namespace holdfast::detail {

/// Some motions side by side, each with its own loop and number of samples, from their start to
/// their metrics.
///
/// The lanes go in step; where one begins to be steady or has had its samples, the others pause for
/// a moment. Thus no sample asks whose it is, and no lane's arithmetic depends on its neighbours.
/// @tparam MatricesOfLoop  gives the matrices of a loop, as SweepMatrices does
template <class Scalar, class MatricesOfLoop = SweepMatrices>
class MetricGroup {
  using Lane = Lanes<Scalar>;

  /// Two packs hide each other's latency where the processor has registers for both.
  static constexpr std::size_t packs = Lane::count >= 8 ? 2 : 1;
  using Packs = std::make_index_sequence<packs>;

 public:
  static constexpr std::size_t lanes = packs * Lane::count;

  explicit MetricGroup(const MatricesOfLoop& matrices = MatricesOfLoop()) : matrices_(matrices) {
    tables_.reserve(packs);
    tracks_.reserve(packs);
  }

  /// @param spans    `count` of them, 1 ≤ count ≤ lanes
  /// @param results  one for each motion, in the order of `motions`
  template <class SwitchingObserver>
  void compute(const SweepMotion* motions, const SampleSpan* spans, std::size_t count,
               MotionMetrics* results, SwitchingObserver& observer) {
    start(motions, spans, count);
    run(results, observer, false);
    const std::vector<SampleSpan> unseen = std::exchange(unseen_, {});
    if (unseen.empty()) return;
    start(motions, unseen.data(), unseen.size());
    run(results, observer, true);
  }

 private:
  /// Samples between two looks at the sizes of the states.
  static constexpr std::int64_t stretch = 256;

  /// Lanes beyond the last motion repeat it.
  void start(const SweepMotion* motions, const SampleSpan* spans, std::size_t count) {
    tables_.clear();
    tracks_.clear();
    for (std::size_t k = 0; k < lanes; ++k) {
      spans_[k] = spans[std::min(k, count - 1)];
      numbers_[k] = spans_[k].motion;
      open_[k] = k < count;
    }
    for (std::size_t pack = 0; pack < packs; ++pack) {
      const auto motion = [&](std::size_t lane) -> const SweepMotion& {
        return motions[numbers_[pack * Lane::count + lane]];
      };
      tracks_.push_back(make_track(motion));
    }
    index_ = 0;
  }

  template <class Motion>
  MetricTrack<Scalar> make_track(const Motion& motion) {
    std::array<SweepMatrices::Matrices, Lane::count> matrices;
    for (std::size_t lane = 0; lane < Lane::count; ++lane)
      matrices[lane] = matrices_.of(motion(lane).loop);
    const auto number = [&](const auto& of) {
      return from_lanes<Scalar>([&](std::size_t lane) { return of(motion(lane).loop); });
    };
    using Loop = IdealLoop<double>;
    const SampledLoop<Scalar> loop = loop_from_lanes<Scalar>(matrices);
    tables_.emplace_back(
        input_from_lanes<Scalar>(matrices),
        HarmonicExcitation<Scalar>{number([](const Loop& of) { return of.excitation.amplitude; }),
                                   number([](const Loop& of) { return of.excitation.frequency; })},
        loop.sampling.period);
    const PdGains<Scalar> gains{number([](const Loop& of) { return of.gains.proportional; }),
                                number([](const Loop& of) { return of.gains.differential; })};
    const Scalar width = number([](const Loop& of) { return of.backlash_width; });
    return MetricTrack<Scalar>(typename MetricTrack<Scalar>::Motion(
        loop, gains, PhasorForcing<Scalar>(tables_.back()), Backlash<Scalar>(width),
        matrix_from_lanes<Scalar, 4, 1>([&](std::size_t lane) -> const auto& {
          return motion(lane).initial_state;
        })));
  }

  template <class SwitchingObserver>
  void run(MotionMetrics* results, SwitchingObserver& observer, bool always_watch) {
    while (std::find(open_.begin(), open_.end(), true) != open_.end()) {
      observer.pause();
      begin_steady();
      const Watch watch = to_watch(always_watch);
      if (watch.divergence) {
        for (auto& track : tracks_) track.begin_watching_divergence();
      }
      take(next_pause(), watch, observer);
      if (watch.divergence) {
        close_diverged(results);
      } else {
        close_unseen();
      }
      close_completed(results);
    }
  }

  void begin_steady() {
    for (std::size_t pack = 0; pack < packs; ++pack) {
      const auto first = from_lanes<Scalar>([&](std::size_t lane) {
        return static_cast<double>(spans_[pack * Lane::count + lane].first_steady);
      });
      const Mask<Scalar> begins = first == Scalar(static_cast<double>(index_));
      if (any(begins)) tracks_[pack].begin_steady(begins);
    }
  }

  Watch to_watch(bool always_watch) const {
    const auto found = flags([](const auto& track) { return track.extremum_found(); });
    const auto small = flags([](const auto& track) { return track.size() < Scalar(large_state); });
    Watch watch{false, false, always_watch};
    for (std::size_t k = 0; k < lanes; ++k) {
      if (!open_[k]) continue;
      watch.extremum = watch.extremum || found[k] == 0;
      watch.steady = watch.steady || index_ >= spans_[k].first_steady;
      watch.divergence = watch.divergence || small[k] == 0;
    }
    return watch;
  }

  std::int64_t next_pause() const {
    std::int64_t pause = index_ + stretch;
    for (std::size_t k = 0; k < lanes; ++k) {
      if (!open_[k]) continue;
      pause = std::min(pause, spans_[k].samples);
      if (spans_[k].first_steady > index_) pause = std::min(pause, spans_[k].first_steady);
    }
    return pause;
  }

  template <class SwitchingObserver>
  void take(std::int64_t end, const Watch& watch, SwitchingObserver& observer) {
    if (watch.divergence) {
      take<true, true, true>(end, observer, Packs());
    } else if (watch.extremum && watch.steady) {
      take<true, true, false>(end, observer, Packs());
    } else if (watch.extremum) {
      take<true, false, false>(end, observer, Packs());
    } else if (watch.steady) {
      take<false, true, false>(end, observer, Packs());
    } else {
      take<false, false, false>(end, observer, Packs());
    }
  }

  /// The loop over samples. It works on copies of the tracks, which the compiler then keeps in
  /// registers, and all that it calls must be inlined for that.
  template <bool Extremum, bool Steady, bool Divergence, class SwitchingObserver,
            std::size_t... Pack>
  [[gnu::flatten]] void take(std::int64_t end, SwitchingObserver& observer,
                             std::index_sequence<Pack...> /*packs*/) {
    constexpr auto block = static_cast<std::int64_t>(PhasorTable<Scalar>::block);
    const auto go = [&](auto... track) {
      for (std::int64_t j = index_; j < end;) {
        if (j % block == 0) (tables_[Pack].turn_to(j), ...);
        const std::int64_t block_end = std::min(end, (j / block + 1) * block);
        for (; j < block_end; ++j) {
          (observer(numbers_.data() + Pack * Lane::count, j,
                    track.template step<Extremum, Steady, Divergence>()),
           ...);
        }
      }
      ((tracks_[Pack] = track), ...);
    };
    go(tracks_[Pack]...);
    index_ = end;
  }

  void close_completed(MotionMetrics* results) {
    for (std::size_t k = 0; k < lanes; ++k) {
      if (!open_[k] || spans_[k].samples != index_) continue;
      open_[k] = false;
      results[numbers_[k]] = completed_metrics(lane(k), spans_[k]);
    }
  }

  void close_diverged(MotionMetrics* results) {
    const auto finite = flags([](const auto& track) { return track.finite(); });
    for (std::size_t k = 0; k < lanes; ++k) {
      if (!open_[k] || finite[k] != 0) continue;
      open_[k] = false;
      results[numbers_[k]] = diverged_metrics(lane(k), finite_samples(k));
    }
  }

  /// A motion that outgrew everything within one stretch is done again.
  void close_unseen() {
    const auto seen = flags([](const auto& track) { return track.size() < Scalar(unseen_state); });
    for (std::size_t k = 0; k < lanes; ++k) {
      if (!open_[k] || seen[k] != 0) continue;
      open_[k] = false;
      unseen_.push_back(spans_[k]);
    }
  }

  LaneSums lane(std::size_t k) const {
    return tracks_[k / Lane::count].observer().lane(k % Lane::count);
  }

  std::int64_t finite_samples(std::size_t k) const {
    double values[Lane::count];
    Lane::store(tracks_[k / Lane::count].finite_samples(), values);
    return static_cast<std::int64_t>(values[k % Lane::count]);
  }

  /// One byte a lane of a mask of every track.
  template <class MaskOfTrack>
  std::array<std::uint8_t, lanes> flags(const MaskOfTrack& mask) const {
    std::array<std::uint8_t, lanes> result;
    for (std::size_t pack = 0; pack < packs; ++pack)
      Lane::store_flags(mask(tracks_[pack]), result.data() + pack * Lane::count);
    return result;
  }

  MatricesOfLoop matrices_;
  std::vector<PhasorTable<Scalar>> tables_;
  std::vector<MetricTrack<Scalar>> tracks_;
  std::array<SampleSpan, lanes> spans_{};
  std::array<std::size_t, lanes> numbers_{};
  std::array<bool, lanes> open_{};
  std::vector<SampleSpan> unseen_;
  std::int64_t index_ = 0;
};

}  // namespace holdfast::detail
