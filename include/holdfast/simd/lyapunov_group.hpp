#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "holdfast/chaos/block_spectrum.hpp"
#include "holdfast/chaos/itinerary_blocks.hpp"
#include "holdfast/chaos/lyapunov_run.hpp"
#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/lanes.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/forcing.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/simd/pack.hpp"

namespace holdfast {

/// The maps of as many blocks as a pack has lanes, entry by entry side by side.
template <class Architecture>
class LaneMaps<xsimd::batch<double, Architecture>> {
  using Number = xsimd::batch<double, Architecture>;

 public:
  /// Refers to maps of `blocks`, which must outlive this; one block a lane.
  LaneMaps(const ItineraryBlocks& blocks, const LaneBlocks<Number>& lanes) {
    for (std::size_t lane = 0; lane < Number::size; ++lane)
      maps_[lane] = blocks.map(lanes[lane]).data();
  }

  /// The entry of every lane's T⁻¹ M T, 0 ≤ row, column < 5.
  Number operator()(int row, int column) const {
    return entry(static_cast<std::size_t>(5 * row + column),
                 std::make_index_sequence<Number::size>());
  }

 private:
  template <std::size_t... Lane>
  Number entry(std::size_t index, std::index_sequence<Lane...> /*lanes*/) const {
    return Number{maps_[Lane][index]...};
  }

  const double* maps_[Number::size];
};

namespace simd::detail {

/// Makes the motions of a loop on scalars and on packs.
/// @tparam Forcing  PeriodicForcing<double> or HarmonicForcing<double>
template <class Forcing>
struct MotionFamily {
  using Number = Pack<double>;
  template <class Scalar>
  using Motion = SampledMotion<Scalar, Backlash<Scalar>, SharedForcing<Scalar, Forcing>>;

  SampledLoop<double> loop;
  IdealLoop<double> parameters;
  Forcing forcing;

  template <class Scalar>
  Motion<Scalar> motion(const Vector<Scalar, 4>& initial_state) const {
    const PdGains<double>& gains = parameters.gains;
    return {converted<Scalar>(loop),
            {Scalar(gains.proportional), Scalar(gains.differential)},
            SharedForcing<Scalar, Forcing>(forcing),
            Backlash<Scalar>(Scalar(parameters.backlash_width)),
            initial_state};
  }
};

/// Packs of trajectories that step in turn, so that one's latency hides behind the others.
inline constexpr std::size_t packs_of_group = 2;
inline constexpr std::size_t lanes_of_group = packs_of_group * Lanes<Pack<double>>::count;

/// Some packs of trajectories and their spectra.
template <class Family>
class LyapunovGroup {
  using Number = Pack<double>;
  using Motion = typename Family::template Motion<Number>;
  static constexpr std::size_t lanes = Lanes<Number>::count;

 public:
  LyapunovGroup(const Family& family, const std::shared_ptr<const ItineraryBlocks>& blocks,
                const LyapunovRun& run)
      : family_(family), blocks_(blocks), run_(run) {}

  /// @param initial_states  `count` of them, 1 ≤ count ≤ lanes_of_group
  void compute(const Vector<double, 4>* initial_states, std::size_t count,
               LyapunovResult* results) {
    start(initial_states, count);
    const Blocks discarded = advance(run_.discard, [] { return true; });
    for (std::size_t pack = 0; pack < packs_of_group; ++pack)
      spectra_[pack].restart(discarded[pack]);
    holdfast::detail::JudgingTimes judging(run_);
    const Blocks open = advance(run_.most_samples, [&] {
      if (judging.have_come(spectra_[0].complete_batches())) classify();
      return running_ > 0;
    });
    for (std::size_t pack = 0; pack < packs_of_group; ++pack) {
      const auto spectra = spectra_[pack].spectra(open[pack]);
      for (std::size_t lane = 0; lane < lanes; ++lane)
        settle(pack * lanes + lane, LyapunovOutcome::sample_limit, spectra[lane]);
    }
    for (std::size_t k = 0; k < count; ++k)
      results[k] = diverged_[k] ? alone(initial_states[k]) : results_[k];
  }

 private:
  using Blocks = std::array<LaneBlocks<Number>, packs_of_group>;

  /// Lanes beyond the last trajectory repeat it.
  void start(const Vector<double, 4>* initial_states, std::size_t count) {
    motions_.clear();
    spectra_.clear();
    for (std::size_t pack = 0; pack < packs_of_group; ++pack) {
      Vector<Number, 4> states;
      for (int i = 0; i < 4; ++i) {
        double values[lanes];
        for (std::size_t lane = 0; lane < lanes; ++lane)
          values[lane] = initial_states[std::min(pack * lanes + lane, count - 1)][i];
        states[i] = Lanes<Number>::load(values);
      }
      motions_.push_back(family_.motion(states));
      spectra_.emplace_back(blocks_, run_.scope);
    }
    settled_.fill(false);
    diverged_.fill(false);
    running_ = lanes_of_group;
  }

  /// Goes through `samples` samples, or fewer when `go_on` says so after a block or all lanes are
  /// settled. @return the last blocks, incomplete
  template <class GoOn>
  Blocks advance(std::int64_t samples, const GoOn& go_on) {
    while (samples >= ItineraryBlocks::length && running_ > 0) {
      const Blocks blocks = itinerary(ItineraryBlocks::length);
      for (std::size_t pack = 0; pack < packs_of_group; ++pack) spectra_[pack].push(blocks[pack]);
      samples -= ItineraryBlocks::length;
      if (!go_on()) return itinerary(0);
    }
    return itinerary(running_ > 0 ? static_cast<int>(samples) : 0);
  }

  /// The contacts of the next samples of all lanes.
  Blocks itinerary(int samples) {
    std::array<Number, packs_of_group> codes;  // whole numbers below 2⁸
    codes.fill(Number(1.0));
    for (int taken = 0; taken < samples; ++taken) {
      for (std::size_t pack = 0; pack < packs_of_group; ++pack) {
        const auto engaged = motions_[pack].sense().engaged;
        codes[pack] = codes[pack] + codes[pack] + select(engaged, Number(1.0), Number(0.0));
        motions_[pack].advance();
      }
    }
    Blocks blocks;
    for (std::size_t pack = 0; pack < packs_of_group; ++pack) {
      double values[lanes];
      Lanes<Number>::store(codes[pack], values);
      for (std::size_t lane = 0; lane < lanes; ++lane)
        blocks[pack][lane] = static_cast<ItineraryBlock>(values[lane]);
      find_diverged(pack);
    }
    return blocks;
  }

  void find_diverged(std::size_t pack) {
    const Number sum = motions_[pack].state().sum();
    if (all(sum - sum == Number(0.0))) return;
    double values[lanes];
    Lanes<Number>::store(sum, values);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const std::size_t k = pack * lanes + lane;
      if (settled_[k] || std::isfinite(values[lane])) continue;
      settled_[k] = diverged_[k] = true;
      --running_;
    }
  }

  void classify() {
    for (std::size_t pack = 0; pack < packs_of_group; ++pack) {
      const auto spectra = spectra_[pack].spectra();
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        if (accurate_enough(spectra[lane].cautious_standard_errors(), run_))
          settle(pack * lanes + lane, LyapunovOutcome::accurate, spectra[lane]);
      }
    }
  }

  void settle(std::size_t k, LyapunovOutcome outcome, const LyapunovSpectrum<double, 5>& spectrum) {
    if (settled_[k]) return;
    settled_[k] = true;
    --running_;
    results_[k] = lyapunov_result(outcome, spectrum, run_);
  }

  /// A trajectory that leaves the range of the number type, on scalars.
  LyapunovResult alone(const Vector<double, 4>& initial_state) const {
    auto motion = family_.motion(initial_state);
    return run_lyapunov(motion, blocks_, run_);
  }

  Family family_;
  std::shared_ptr<const ItineraryBlocks> blocks_;
  LyapunovRun run_;
  std::vector<Motion> motions_;
  std::vector<BlockSpectrum<Number>> spectra_;
  std::array<LyapunovResult, lanes_of_group> results_{};
  std::array<bool, lanes_of_group> settled_{};
  std::array<bool, lanes_of_group> diverged_{};
  std::size_t running_ = 0;
};

}  // namespace simd::detail
}  // namespace holdfast
