#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/stats/share_error.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/phase_space/attractor_set.hpp"
#include "holdfast/phase_space/motion_batch.hpp"

namespace holdfast {

/// The attractor of one initial state, if one was found.
struct BasinLabel {
  OrbitOutcome outcome = OrbitOutcome::none_found;  ///< `certified`, or why no attractor was found
  int attractor = -1;  ///< index in BasinsOf::attractors; −1 unless certified
};

/// One attractor, with the share of the initial states in its basin.
/// @tparam Orbit  PeriodicOrbit or EventOrbit
template <class Orbit>
struct AttractorOf {
  Orbit orbit;            ///< certified orbit; among phase-shifted copies the first one found
  std::size_t states;     ///< number of initial states in its basin
  double fraction;        ///< share of the initial states in its basin
  double standard_error;  ///< standard error of `fraction` for random states (share_error())
  std::optional<int> mirror_image;  ///< index of an earlier mirror image; nullopt: none
};

/// The basins of attraction: the attractor of each of many initial states.
template <class Orbit>
struct BasinsOf {
  std::vector<BasinLabel> labels;              ///< one label for each initial state, in their order
  std::vector<AttractorOf<Orbit>> attractors;  ///< attractors, in the order of first initial states
};

/// The basins of attraction of an IdealLoop.
using BasinMap = BasinsOf<PeriodicOrbit>;

namespace detail {

/// The basins made from labels whose attractors are numbered in the order of finding. The
/// attractors are renumbered in the order of the initial states.
template <class Orbit>
BasinsOf<Orbit> numbered_basins(std::vector<BasinLabel> labels, const std::vector<Orbit>& orbits) {
  BasinsOf<Orbit> basins{std::move(labels), {}};
  std::vector<int> number_of(orbits.size(), -1);
  for (BasinLabel& label : basins.labels) {
    if (label.attractor < 0) continue;
    const auto found = static_cast<std::size_t>(label.attractor);
    if (number_of[found] < 0) {
      number_of[found] = static_cast<int>(basins.attractors.size());
      basins.attractors.push_back({orbits[found], 0, 0.0, 0.0, std::nullopt});
    }
    label.attractor = number_of[found];
    ++basins.attractors[static_cast<std::size_t>(label.attractor)].states;
  }
  const auto all = static_cast<double>(basins.labels.size());
  for (std::size_t k = 0; k < basins.attractors.size(); ++k) {
    AttractorOf<Orbit>& attractor = basins.attractors[k];
    attractor.fraction = static_cast<double>(attractor.states) / all;
    attractor.standard_error = share_error(attractor.states, basins.labels.size());
    for (std::size_t earlier = 0; earlier < k && !attractor.mirror_image; ++earlier) {
      if (is_mirror_image(attractor.orbit, basins.attractors[earlier].orbit))
        attractor.mirror_image = static_cast<int>(earlier);
    }
  }
  return basins;
}

/// The result of a search for the periodic orbit of one motion.
template <class Orbit>
struct FoundOrbit {
  BasinLabel label;            ///< label; its attractor is the known orbit that the motion reaches
  std::optional<Orbit> orbit;  ///< the certified orbit if it is a new one, else empty
};

/// The FoundOrbit of a motion, made from the result of the orbit search for that motion.
/// @tparam Result  an OrbitResultOf, or derived from one
template <class Result>
auto own_orbit(Result found) {
  using Orbit = typename decltype(found.orbit)::value_type;
  if (found.outcome != OrbitOutcome::certified) found.orbit.reset();
  return FoundOrbit<Orbit>{{found.outcome, -1}, std::move(found.orbit)};
}

/// The search for the labels of many initial states of one loop, in rounds. Each round first
/// searches, one by one, for the orbits of some remaining states. Then all remaining motions may be
/// advanced together towards the known orbits. Each round searches twice as many states as the
/// previous one, up to 2¹⁶. The result is independent of the order of execution within a round.
/// @tparam Model  has search(motion, set), a FoundOrbit, and advance(motions, set, for_tiles),
///                which marks attracted and diverging motions
/// @tparam Tiles  for_tiles(count, tile, job): job(first, number) for tiles of 0 … count − 1
template <class Model, class Tiles>
class BasinSearch {
  using Attractors = AttractorSet<typename Model::Loop>;
  using Orbit = typename Attractors::Orbit;

 public:
  BasinSearch(const Model& model, const Tiles& for_tiles)
      : model_(model), attractor_set_(model.loop), for_tiles_(for_tiles) {}

  BasinsOf<Orbit> run(const std::vector<Vector<double, 4>>& initial_states) {
    labels_.resize(initial_states.size());
    for (std::size_t k = 0; k < initial_states.size(); ++k)
      left_.push_back({k, memory_of_start(initial_states[k])});
    constexpr std::size_t largest_round = std::size_t{1} << 16U;
    for (std::size_t most = 8; !left_.empty(); most = std::min(2 * most, largest_round)) {
      search(taken_out(most));
      model_.advance(left_, attractor_set_, for_tiles_);
      const auto ended = [this](const ActiveTrajectory& motion) {
        if (motion.diverged) labels_[motion.number] = {OrbitOutcome::diverges, -1};
        if (motion.orbit >= 0) labels_[motion.number] = {OrbitOutcome::certified, motion.orbit};
        return motion.diverged || motion.orbit >= 0;
      };
      left_.erase(std::remove_if(left_.begin(), left_.end(), ended), left_.end());
    }
    return numbered_basins(std::move(labels_), attractor_set_.orbits());
  }

 private:
  /// Removes some of the remaining motions, evenly spread, and returns them.
  std::vector<ActiveTrajectory> taken_out(std::size_t most) {
    const std::size_t all = left_.size(), count = std::min(most, all);
    std::vector<ActiveTrajectory> chosen, rest;
    for (std::size_t k = 0; k < all; ++k) {
      const bool next = chosen.size() < count && k == chosen.size() * all / count;
      (next ? chosen : rest).push_back(left_[k]);
    }
    left_ = std::move(rest);
    return chosen;
  }

  void search(const std::vector<ActiveTrajectory>& chosen) {
    std::vector<FoundOrbit<Orbit>> found(chosen.size());
    for_tiles_(chosen.size(), 1, [&](std::size_t first, std::size_t number) {
      for (std::size_t k = first; k < first + number; ++k)
        found[k] = model_.search(chosen[k], attractor_set_);
    });
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      BasinLabel& label = labels_[chosen[k].number] = found[k].label;
      if (found[k].orbit) label.attractor = attractor_set_.add(std::move(*found[k].orbit));
    }
  }

  Model model_;
  Attractors attractor_set_;
  const Tiles& for_tiles_;
  std::vector<ActiveTrajectory> left_;
  std::vector<BasinLabel> labels_;
};

/// The basins of attraction of a loop, computed by a Model{loop, ratio, limits, …} of its motions.
template <class Model, class Tiles, class... More>
auto basins_by(const typename Model::Loop& loop,
               const std::vector<Vector<double, 4>>& initial_states, const OrbitLimits& limits,
               const Tiles& for_tiles, const More&... more) {
  validate(loop);
  validate(limits);
  for (const auto& state : initial_states) require_finite("initial state", state.sum(), "");
  const std::optional<Rational> ratio = Model::ratio_of(loop);
  if (ratio && ratio->denominator <= limits.largest_period)
    return BasinSearch<Model, Tiles>({loop, *ratio, limits, more...}, for_tiles)
        .run(initial_states);
  const auto outcome = ratio ? OrbitOutcome::none_found : OrbitOutcome::incommensurate;
  return BasinsOf<typename AttractorSet<typename Model::Loop>::Orbit>{
      std::vector<BasinLabel>(initial_states.size(), {outcome, -1}), {}};
}

/// The motions of a loop that advance in parallel, with a search for the orbit of any one motion.
/// @tparam LoopModel  IdealLoop<double>; ImplementedLoop in event_basins.hpp
template <class LoopModel, class Propagator>
struct BatchedMotions;

/// Motions of an IdealLoop in a batch; a search for an orbit starts at the present state.
template <class Scalar, class Propagator>
struct BatchedMotions<IdealLoop<Scalar>, Propagator> {
  using Loop = IdealLoop<Scalar>;

  Loop loop;
  Rational ratio;
  OrbitLimits limits;
  const Propagator& propagate;
  PeriodicallyForcedMotion<double> start =
      periodically_forced_motion(loop, ratio, Vector<double, 4>::Zero().eval());
  std::int64_t samples = std::max<std::int64_t>(4096, 4 * ratio.denominator);  // of a round

  static std::optional<Rational> ratio_of(const Loop& loop) { return forcing_ratio(loop); }

  FoundOrbit<PeriodicOrbit> search(const ActiveTrajectory& motion,
                                   const AttractorSet<Loop>& /*known*/) const {
    auto alone = start;
    alone.restore(motion.memory);
    return own_orbit(orbit_of_motion(loop, ratio, limits, alone));
  }

  template <class Tiles>
  void advance(std::vector<ActiveTrajectory>& motions, const AttractorSet<Loop>& known,
               const Tiles& for_tiles) {
    const auto batch = propagate(start);
    constexpr std::size_t tile = 64;
    for_tiles(motions.size(), tile, [&](std::size_t first, std::size_t number) {
      auto own = batch;
      own.run(motions.data() + first, number, samples, known);
    });
    samples *= 2;
  }
};

}  // namespace detail

/// Computes basins of attraction like find_basins(), with a given function that advances motions.
/// @param propagate       IdealLoop: propagate(motion) returns an object with MotionBatch's run().
///                        ImplementedLoop: propagate(loop, scheduler) replaces run_on_lanes()
/// @param loop            loop; for an ImplementedLoop has_event_pack() must be true
/// @param initial_states  states [z₁, ż₁, z₂, ż₂] (m, m/s, m, m/s), finite; may be empty
/// @param limits          limits of each search for the orbit of a single motion
/// @param for_tiles       see find_basins()
/// @throws InvalidParameter where loop, states or limits are not admissible
template <class Propagator, class Loop, class Tiles>
auto find_basins_by(const Propagator& propagate, const Loop& loop,
                    const std::vector<Vector<double, 4>>& initial_states, const OrbitLimits& limits,
                    const Tiles& for_tiles) {
  return detail::basins_by<detail::BatchedMotions<Loop, Propagator>>(loop, initial_states, limits,
                                                                     for_tiles, propagate);
}

/// Finds the attractor of each of many initial states [z₁, ż₁, z₂, ż₂].
///
/// Attractors are distinguished by their orbits; copies of an orbit shifted by common periods of
/// sampling and forcing are the same attractor. An initial state is assigned to an attractor only
/// once its motion is certain to tend to the orbit. Orbits are searched for from some states; then
/// all remaining motions are advanced together until known orbits attract them.
/// @param loop            the loop with its excitation and backlash
/// @param initial_states  initial states (m, m/s, m, m/s), finite; may be empty
/// @param limits          limits of each search for the orbit of a single motion
/// @tparam Scalar         number type of the parallel motions: `double`, or a SIMD pack
/// @param for_tiles       for_tiles(count, tile, job) divides 0 … count − 1 into tiles of at most
///                        `tile` indices and calls job(first index, number of indices) for each, on
///                        any number of threads, in any order
/// @throws InvalidParameter where loop, states or limits are not admissible
template <class Scalar, class Tiles>
BasinMap find_basins(const IdealLoop<double>& loop,
                     const std::vector<Vector<double, 4>>& initial_states,
                     const OrbitLimits& limits, const Tiles& for_tiles) {
  const auto propagate = [](const auto& motion) { return MotionBatch<Scalar>(motion); };
  return find_basins_by(propagate, loop, initial_states, limits, for_tiles);
}

}  // namespace holdfast
