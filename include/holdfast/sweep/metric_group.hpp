#pragma once

#include <algorithm>
#include <array>
#include <cmath>
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
#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/sweep/metric_observer.hpp"
#include "holdfast/sweep/motion_metrics.hpp"
#include "holdfast/sweep/sweep_matrices.hpp"
#include "holdfast/sweep/sweep_motion.hpp"

namespace holdfast::detail {

/// Observations that at least one lane needs in the next samples; other observations are omitted.
struct Watch {
  bool extremum;    ///< some lane has not yet had its first extremum
  bool steady;      ///< some lane is in its steady samples
  bool divergence;  ///< some state is so large that it may leave the range of the number type
};

/// Sizes of a state: above `large_state` every sample is checked for divergence; a motion that
/// reaches `unseen_state` without these checks is computed again with them.
inline constexpr double large_state = 1e60, unseen_state = 1e200;

/// A pack of motions with their metrics.
///
/// Work per sample: 42 operations of the motion (24 multiply-adds of the loop, 12 of the forcing, 2
/// of the gains, 4 additions), 15 of the backlash (5 additions, 6 comparisons, 4 selects), 4 of the
/// metrics (largest and smallest); 8 more where steady, 8 while a first extremum is sought.
template <class Scalar>
class MetricTrack {
 public:
  using Motion = SampledMotion<Scalar, Backlash<Scalar>, PhasorForcing<Scalar>>;

  explicit MetricTrack(const Motion& motion) : motion_(motion) {}

  /// Takes one sample. @return the lanes in which the drive transmits
  template <bool Extremum, bool Steady, bool Divergence>
  Mask<Scalar> step() {
    const Scalar velocity_before = motion_.law().memory().previous_velocity;
    const auto sample = motion_.sense();
    Scalar displacement = motion_.readings().displacement(sample.state);
    observer_.observe_load(sample.control_force,
                           motion_.readings().relative_displacement(sample.state));
    if constexpr (Steady)
      observer_.observe_steady(displacement, sample.control_force, sample.engaged,
                               is_reversal(velocity_before, velocity(sample.state)));
    if constexpr (Divergence) {
      finite_ = finite_ & is_finite(sample.state);
      finite_samples_ = finite_samples_ + select(finite_, Scalar(1), Scalar(0));
      displacement = select(finite_, displacement, Scalar(MotionMetrics::unknown));
    }
    if constexpr (Extremum) observer_.observe_extremum(displacement);
    motion_.advance();
    return sample.engaged;
  }

  /// Begins the steady samples of the lanes in the mask at the present sample.
  void begin_steady(const Mask<Scalar>& lanes) {
    observer_.begin_steady(
        lanes, is_reversal(motion_.law().memory().previous_velocity, velocity(motion_.state())));
  }

  /// Starts the checks for divergence and the count of samples with a finite state. In a lane that
  /// is still finite, the count begins with all samples so far.
  void begin_watching_divergence() {
    finite_samples_ =
        select(finite_, Scalar(static_cast<double>(motion_.index())), finite_samples_);
  }

  /// The size Σ |z_i| of the present state in SI units, a rough measure of divergence.
  Scalar size() const {
    using std::abs;
    Scalar result = abs(motion_.state()[0]);
    for (int i = 1; i < 4; ++i) result = result + abs(motion_.state()[i]);
    return result;
  }

  Mask<Scalar> finite() const { return finite_; }
  const Scalar& finite_samples() const { return finite_samples_; }
  const MetricObserver<Scalar>& observer() const { return observer_; }

 private:
  Scalar velocity(const Vector<Scalar, 4>& state) const {
    return motion_.readings().relative_velocity(state);
  }

  static Mask<Scalar> is_finite(const Vector<Scalar, 4>& state) {
    const Scalar sum = state.sum();
    return Scalar(0) * sum == Scalar(0);
  }

  Motion motion_;
  MetricObserver<Scalar> observer_;
  Mask<Scalar> finite_ = Scalar(0) == Scalar(0);
  Scalar finite_samples_ = Scalar(0);
};

/// Computes the metrics of motions in SIMD lanes, each with its own loop and number of samples.
///
/// All lanes advance together. The inner loop over samples stops at each lane's first steady sample
/// and end, and needs no branches on lanes. Results are independent of other lanes.
/// @tparam Source  type with the members of SweepMatrices: matrices of a loop, calls at samples
template <class Scalar, class Source = SweepMatrices>
class MetricGroup {
  using Lane = Lanes<Scalar>;

  /// The number of packs: two hide instruction latency where there are registers enough for both.
  static constexpr std::size_t packs = Lane::count >= 8 ? 2 : 1;
  using Packs = std::make_index_sequence<packs>;

 public:
  static constexpr std::size_t lanes = packs * Lane::count;

  explicit MetricGroup(Source& source) : source_(source) {
    tables_.reserve(packs);
    tracks_.reserve(packs);
  }

  /// Computes the metrics of the `count` motions that `spans` name by their index in `motions`.
  /// @param spans    samples of these motions, 1 ≤ count ≤ lanes
  /// @param results  metrics, one for each motion, in the order of `motions`
  void compute(const SweepMotion* motions, const SampleSpan* spans, std::size_t count,
               MotionMetrics* results) {
    start(motions, spans, count);
    run(results, false);
    const std::vector<SampleSpan> unseen = std::exchange(unseen_, {});
    if (unseen.empty()) return;
    start(motions, unseen.data(), unseen.size());
    run(results, true);
  }

 private:
  /// Number of samples between two checks of the sizes of the states.
  static constexpr std::int64_t stretch = 256;

  /// Starts the motions; lanes beyond the last motion repeat it.
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
      matrices[lane] = source_.of(motion(lane).loop);
    const auto of_loop = [&](const auto& part) {
      return from_lanes<Scalar>([&](std::size_t lane) { return part(motion(lane).loop); });
    };
    using Loop = IdealLoop<double>;
    const SampledLoop<Scalar> loop = loop_from_lanes<Scalar>(matrices);
    tables_.emplace_back(
        HarmonicInput<Scalar>{
            from_lanes<Scalar>([&](std::size_t lane) { return matrices[lane].input.cosine; }),
            from_lanes<Scalar>([&](std::size_t lane) { return matrices[lane].input.sine; })},
        HarmonicExcitation<Scalar>{of_loop([](const Loop& of) { return of.excitation.amplitude; }),
                                   of_loop([](const Loop& of) { return of.excitation.frequency; })},
        loop.sampling.period);
    const PdGains<Scalar> gains{of_loop([](const Loop& of) { return of.gains.proportional; }),
                                of_loop([](const Loop& of) { return of.gains.differential; })};
    const Scalar width = of_loop([](const Loop& of) { return of.backlash_width; });
    return MetricTrack<Scalar>(typename MetricTrack<Scalar>::Motion(
        loop, gains, PhasorForcing<Scalar>(tables_.back()), Backlash<Scalar>(width),
        from_lanes<Scalar>([&](std::size_t lane) { return motion(lane).initial_state; })));
  }

  void run(MotionMetrics* results, bool always_watch) {
    while (std::find(open_.begin(), open_.end(), true) != open_.end()) {
      source_.pause();
      begin_steady();
      const Watch watch = to_watch(always_watch);
      if (watch.divergence) {
        for (auto& track : tracks_) track.begin_watching_divergence();
      }
      take(next_pause(), watch);
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
    const auto found = flags([](const auto& track) { return track.observer().extremum_found(); });
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

  void take(std::int64_t end, const Watch& watch) {
    if (watch.divergence) {
      take<true, true, true>(end, Packs());
    } else if (watch.extremum && watch.steady) {
      take<true, true, false>(end, Packs());
    } else if (watch.extremum) {
      take<true, false, false>(end, Packs());
    } else if (watch.steady) {
      take<false, true, false>(end, Packs());
    } else {
      take<false, false, false>(end, Packs());
    }
  }

  /// Loop over samples. Copies of the tracks are used, which the compiler keeps in registers; for
  /// this, every function called here must be inlined.
  template <bool Extremum, bool Steady, bool Divergence, std::size_t... Pack>
  [[gnu::flatten]] void take(std::int64_t end, std::index_sequence<Pack...> /*packs*/) {
    constexpr auto block = static_cast<std::int64_t>(PhasorTable<Scalar>::block);
    const auto go = [&](auto... track) {
      for (std::int64_t j = index_; j < end;) {
        if (j % block == 0) (tables_[Pack].turn_to(j), ...);
        const std::int64_t block_end = std::min(end, (j / block + 1) * block);
        for (; j < block_end; ++j) {
          (source_(numbers_.data() + Pack * Lane::count, j,
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
      results[numbers_[k]] =
          completed_metrics(track_of(k).observer().lane(k % Lane::count), spans_[k]);
    }
  }

  void close_diverged(MotionMetrics* results) {
    const auto finite = flags([](const auto& track) { return track.finite(); });
    for (std::size_t k = 0; k < lanes; ++k) {
      if (!open_[k] || finite[k] != 0) continue;
      open_[k] = false;
      const double samples = lane_of(track_of(k).finite_samples(), k % Lane::count);
      results[numbers_[k]] = diverged_metrics(track_of(k).observer().lane(k % Lane::count),
                                              static_cast<std::int64_t>(samples));
    }
  }

  /// Ends motions beyond `unseen_state`. They are computed again with checks at every sample.
  void close_unseen() {
    const auto seen = flags([](const auto& track) { return track.size() < Scalar(unseen_state); });
    for (std::size_t k = 0; k < lanes; ++k) {
      if (!open_[k] || seen[k] != 0) continue;
      open_[k] = false;
      unseen_.push_back(spans_[k]);
    }
  }

  const MetricTrack<Scalar>& track_of(std::size_t k) const { return tracks_[k / Lane::count]; }

  template <class MaskOfTrack>
  std::array<std::uint8_t, lanes> flags(const MaskOfTrack& mask) const {
    std::array<std::uint8_t, lanes> result;
    for (std::size_t pack = 0; pack < packs; ++pack)
      Lane::store_flags(mask(tracks_[pack]), result.data() + pack * Lane::count);
    return result;
  }

  Source& source_;
  std::vector<PhasorTable<Scalar>> tables_;
  std::vector<MetricTrack<Scalar>> tracks_;
  std::array<SampleSpan, lanes> spans_{};
  std::array<std::size_t, lanes> numbers_{};
  std::array<bool, lanes> open_{};
  std::vector<SampleSpan> unseen_;
  std::int64_t index_ = 0;
};

}  // namespace holdfast::detail
