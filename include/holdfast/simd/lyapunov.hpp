#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "holdfast/chaos/block_spectrum.hpp"
#include "holdfast/chaos/itinerary_blocks.hpp"
#include "holdfast/chaos/lyapunov_run.hpp"
#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/lanes.hpp"
#include "holdfast/core/select.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/simd/pack.hpp"
#include "holdfast/simd/parallel_rows.hpp"

namespace holdfast::simd {

namespace detail {

/// Motions of one loop with their exponents, as many as some packs have lanes.
/// @tparam Forcing  PeriodicForcing<double> or HarmonicForcing<double>
template <class Forcing>
class LyapunovGroup {
  using Number = Pack<double>;
  using SingleMotion = SampledMotion<double, Backlash<double>, Forcing>;
  static constexpr std::size_t pack_lanes = Lanes<Number>::count;
  /// Packs step in turn, so that one's latency hides behind the other's.
  static constexpr std::size_t packs = 2;
  using Blocks = std::array<LaneBlocks<Number>, packs>;

 public:
  static constexpr std::size_t lanes = packs * pack_lanes;

  /// @param start  a motion of the loop; its state does not matter
  LyapunovGroup(const SingleMotion& start, const std::shared_ptr<const ItineraryBlocks>& blocks,
                const LyapunovRun& run)
      : start_(start), blocks_(blocks), run_(run) {}

  /// @param initial_states  `count` of them, 1 ≤ count ≤ lanes
  void compute(const Vector<double, 4>* initial_states, std::size_t count,
               LyapunovResult* results) {
    begin(initial_states, count);
    const auto averages = holdfast::detail::run_average(*this, run_);
    for (std::size_t k = 0; k < count; ++k)
      results[k] = diverged_[k] ? alone(initial_states[k]) : averages[k];
  }

  /// Goes through `samples` samples, or fewer when `go_on` says no after a block.
  template <class GoOn>
  void advance(std::int64_t samples, const GoOn& go_on) {
    open_ = itinerary(0);
    for (; samples >= ItineraryBlocks::length; samples -= ItineraryBlocks::length) {
      const Blocks blocks = itinerary(ItineraryBlocks::length);
      for (std::size_t pack = 0; pack < packs; ++pack) spectra_[pack].push(blocks[pack]);
      if (!go_on()) return;
    }
    open_ = itinerary(static_cast<int>(samples));
  }

  bool diverged(std::size_t lane) const { return diverged_[lane]; }

  void restart() {
    for (std::size_t pack = 0; pack < packs; ++pack) spectra_[pack].restart(open_[pack]);
  }

  std::vector<LyapunovSpectrum<double, 5>> spectra() const {
    std::vector<LyapunovSpectrum<double, 5>> all;
    for (std::size_t pack = 0; pack < packs; ++pack)
      for (const auto& spectrum : spectra_[pack].spectra(open_[pack])) all.push_back(spectrum);
    return all;
  }

  std::size_t complete_batches() const { return spectra_[0].complete_batches(); }

 private:
  /// Lanes beyond the last motion repeat it.
  void begin(const Vector<double, 4>* initial_states, std::size_t count) {
    motions_.clear();
    spectra_.clear();
    for (std::size_t pack = 0; pack < packs; ++pack) {
      const Vector<Number, 4> states = holdfast::detail::from_lanes<Number>([&](std::size_t lane) {
        return initial_states[std::min(pack * pack_lanes + lane, count - 1)];
      });
      motions_.push_back(in_every_lane(start_, states));
      spectra_.emplace_back(blocks_, run_.scope);
    }
    diverged_.fill(false);
  }

  /// The contacts of the next samples of all lanes.
  Blocks itinerary(int samples) {
    std::array<Number, packs> codes;  // whole numbers below 2⁸
    codes.fill(Number(1.0));
    for (int taken = 0; taken < samples; ++taken) {
      for (std::size_t pack = 0; pack < packs; ++pack) {
        const auto engaged = motions_[pack].sense().engaged;
        codes[pack] = codes[pack] + codes[pack] + select(engaged, Number(1.0), Number(0.0));
        motions_[pack].advance();
      }
    }
    Blocks blocks;
    for (std::size_t pack = 0; pack < packs; ++pack) {
      double values[pack_lanes];
      Lanes<Number>::store(codes[pack], values);
      for (std::size_t lane = 0; lane < pack_lanes; ++lane)
        blocks[pack][lane] = static_cast<ItineraryBlock>(values[lane]);
      find_diverged(pack);
    }
    return blocks;
  }

  void find_diverged(std::size_t pack) {
    const Number sum = motions_[pack].state().sum();
    if (all(sum - sum == Number(0.0))) return;
    for (std::size_t lane = 0; lane < pack_lanes; ++lane) {
      bool& diverged = diverged_[pack * pack_lanes + lane];
      diverged = diverged || !std::isfinite(holdfast::detail::lane_of(sum, lane));
    }
  }

  /// A motion that leaves the range of the number type, sample by sample.
  LyapunovResult alone(const Vector<double, 4>& initial_state) const {
    SingleMotion motion = in_every_lane(start_, initial_state);
    return run_lyapunov(motion, blocks_, run_);
  }

  SingleMotion start_;
  std::shared_ptr<const ItineraryBlocks> blocks_;
  LyapunovRun run_;
  std::vector<SampledMotion<Number, Backlash<Number>, Forcing>> motions_;
  std::vector<BlockSpectrum<Number>> spectra_;
  Blocks open_;  // the last blocks, incomplete
  std::array<bool, lanes> diverged_{};
};

}  // namespace detail

/// The Lyapunov exponents of one loop along the motions from many initial states, several a
/// register and on several threads.
///
///     const auto results = simd::lyapunov_spectra(loop, states, {100000, 1000});
///
/// Each is that of `run_lyapunov` along its motion but for rounding. Where f τ = p/q, the forcing
/// is exactly periodic.
/// @param loop              the loop with its excitation and backlash
/// @param initial_states    each [z₁, ż₁, z₂, ż₂] (m, m/s, m, m/s)
/// @param run               how long, and with what accuracy, each is averaged
/// @param tangent_sampling  sampling of the loop whose S and S* are the tangents
/// @param threads           ≥ 1, or 0 for all cores; the results do not depend on it
/// @return in the order of the initial states
/// @throws InvalidParameter where `loop`, `run` or `tangent_sampling` is not admissible
inline std::vector<LyapunovResult> lyapunov_spectra(
    const IdealLoop<double>& loop, const std::vector<Vector<double, 4>>& initial_states,
    const LyapunovRun& run, const Sampling<double>& tangent_sampling, int threads = 0) {
  validate(loop);
  validate(run);
  validate(tangent_sampling);
  const auto blocks = std::make_shared<const ItineraryBlocks>(
      sampled_loop(loop.plant, tangent_sampling), loop.gains);
  std::vector<LyapunovResult> results(initial_states.size());
  const auto run_from = [&](const auto& start) {
    using Group = detail::LyapunovGroup<std::decay_t<decltype(start.forcing())>>;
    parallel_rows(static_cast<std::int64_t>(initial_states.size()),
                  static_cast<std::int64_t>(Group::lanes), threads, Group(start, blocks, run),
                  [&](Group& group, std::int64_t first, std::int64_t count) {
                    group.compute(initial_states.data() + first, static_cast<std::size_t>(count),
                                  results.data() + first);
                  });
  };
  const Vector<double, 4> rest = Vector<double, 4>::Zero();
  if (const auto ratio = forcing_ratio(loop)) {
    run_from(periodically_forced_motion(loop, *ratio, rest));
  } else {
    run_from(harmonically_forced_motion(loop, rest));
  }
  return results;
}

/// The same with the tangents of the motion itself.
inline std::vector<LyapunovResult> lyapunov_spectra(
    const IdealLoop<double>& loop, const std::vector<Vector<double, 4>>& initial_states,
    const LyapunovRun& run, int threads = 0) {
  return lyapunov_spectra(loop, initial_states, run, loop.sampling, threads);
}

}  // namespace holdfast::simd
