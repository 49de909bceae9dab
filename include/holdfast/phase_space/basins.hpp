#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/phase_space/attractor_set.hpp"
#include "holdfast/phase_space/motion_batch.hpp"

namespace holdfast {

/// What one initial state comes to.
struct BasinLabel {
  OrbitOutcome outcome = OrbitOutcome::none_found;  ///< `certified`, or why it has no attractor
  int attractor = -1;  ///< index into the attractors of its BasinsOf; −1 unless certified
};

/// One attractor of a set of initial states.
/// @tparam Orbit  PeriodicOrbit or EventOrbit
template <class Orbit>
struct AttractorOf {
  Orbit orbit;  ///< certified; of copies begun at other stroboscopic instants the one found first
  std::size_t states;               ///< how many of the initial states come to it
  double fraction;                  ///< of all of them
  double standard_error;            ///< √(fraction (1 − fraction)/n): the states being a sample
  std::optional<int> mirror_image;  ///< of an earlier attractor
};

/// Which attractor each of many initial states comes to.
template <class Orbit>
struct BasinsOf {
  std::vector<BasinLabel> labels;              ///< in the order of the initial states
  std::vector<AttractorOf<Orbit>> attractors;  ///< in the order in which the states first meet them
};

/// One attractor of an IdealLoop.
using BasinAttractor = AttractorOf<PeriodicOrbit>;
/// Which attractor each of many initial states of an IdealLoop comes to.
using BasinMap = BasinsOf<PeriodicOrbit>;

namespace detail {

/// The basins of labels whose attractors are numbered in the order in which their orbits were
/// found, with the attractors in that in which the states meet them.
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
    attractor.standard_error = std::sqrt(attractor.fraction * (1.0 - attractor.fraction) / all);
    for (std::size_t earlier = 0; earlier < k && !attractor.mirror_image; ++earlier) {
      if (is_mirror_image(attractor.orbit, basins.attractors[earlier].orbit))
        attractor.mirror_image = static_cast<int>(earlier);
    }
  }
  return basins;
}

/// Finds the labels of many initial states of one loop, in rounds: some of the states that are left
/// are searched for their own orbits, one by one; then all that are left move on together past the
/// orbits known by now. Each round takes twice as many of both. Nothing depends on the order in
/// which the parts of a round are done.
/// @tparam Travel  travel(loop, ratio) gives what moves motions on, as MotionBatch does
/// @tparam Tiles   for_tiles(count, tile, job): job(first, number) for tiles of 0 … count − 1
template <class Travel, class Tiles>
class BasinSearch {
 public:
  BasinSearch(const IdealLoop<double>& loop, const OrbitLimits& limits, const Travel& travel,
              const Tiles& for_tiles)
      : loop_(loop),
        limits_(limits),
        travel_(travel),
        for_tiles_(for_tiles),
        attractor_set_(loop) {}

  BasinMap run(const std::vector<Vector<double, 4>>& initial_states) {
    labels_.resize(initial_states.size());
    const auto ratio = forcing_ratio(loop_);
    if (!ratio || ratio->denominator > limits_.largest_period) {
      const auto outcome = ratio ? OrbitOutcome::none_found : OrbitOutcome::incommensurate;
      for (BasinLabel& label : labels_) label.outcome = outcome;
      return {std::move(labels_), {}};
    }
    for (std::size_t k = 0; k < initial_states.size(); ++k)
      left_.push_back({k, memory_of_start(initial_states[k])});
    std::size_t probes = 8;
    std::int64_t samples = std::max<std::int64_t>(4096, 4 * ratio->denominator);
    while (!left_.empty()) {
      probe(*ratio, probes);
      travel(*ratio, samples);
      probes *= 2;
      samples *= 2;
    }
    return numbered_basins(std::move(labels_), attractor_set_.orbits());
  }

 private:
  /// Searches some of the motions that are left, evenly spread.
  void probe(const Rational& ratio, std::size_t most) {
    const std::size_t count = std::min(most, left_.size());
    std::vector<OrbitResult> results(count, {OrbitOutcome::none_found, std::nullopt, 0, 0});
    for_tiles_(count, 1, [&](std::size_t first, std::size_t number) {
      for (std::size_t k = first; k < first + number; ++k) {
        auto motion = periodically_forced_motion(loop_, ratio, Vector<double, 4>::Zero().eval());
        motion.restore(left_[place_of(k, count)].memory);
        results[k] = OrbitSearch<double>(loop_, ratio, limits_, motion).run();
      }
    });
    for (std::size_t k = 0; k < count; ++k) {
      ActiveTrajectory& motion = left_[place_of(k, count)];
      BasinLabel& label = labels_[motion.number];
      label.outcome = results[k].outcome;
      if (label.outcome == OrbitOutcome::certified)
        label.attractor = attractor_set_.add(std::move(*results[k].orbit));
      motion.searched = true;
    }
    drop([](const ActiveTrajectory& motion) { return motion.searched; });
  }

  std::size_t place_of(std::size_t probe, std::size_t probes) const {
    return probe * left_.size() / probes;
  }

  void travel(const Rational& ratio, std::int64_t samples) {
    const auto batch = travel_(loop_, ratio);
    constexpr std::size_t tile = 64;
    for_tiles_(left_.size(), tile, [&](std::size_t first, std::size_t number) {
      auto own = batch;
      own.run(left_.data() + first, number, samples, attractor_set_);
    });
    for (const ActiveTrajectory& motion : left_) {
      if (motion.diverged) labels_[motion.number] = {OrbitOutcome::diverges, -1};
      if (motion.orbit >= 0) labels_[motion.number] = {OrbitOutcome::certified, motion.orbit};
    }
    drop([](const ActiveTrajectory& motion) { return motion.diverged || motion.orbit >= 0; });
  }

  template <class Ended>
  void drop(const Ended& ended) {
    left_.erase(std::remove_if(left_.begin(), left_.end(), ended), left_.end());
  }

  IdealLoop<double> loop_;
  OrbitLimits limits_;
  const Travel& travel_;
  const Tiles& for_tiles_;
  AttractorSet<IdealLoop<double>> attractor_set_;
  std::vector<ActiveTrajectory> left_;
  std::vector<BasinLabel> labels_;
};

}  // namespace detail

/// find_basins() with another way to move the motions on.
/// @param travel          travel(loop, ratio) gives what has MotionBatch's run() and can be copied
/// @param loop            of all motions
/// @param initial_states  where they begin
/// @param limits          of the search for periodic orbits
/// @param for_tiles       deals tiles of states out, as in find_basins()
/// @throws InvalidParameter where loop, states or limits are not admissible
template <class Travel, class Tiles>
BasinMap find_basins_by(const Travel& travel, const IdealLoop<double>& loop,
                        const std::vector<Vector<double, 4>>& initial_states,
                        const OrbitLimits& limits, const Tiles& for_tiles) {
  validate(loop);
  validate(limits);
  for (const auto& state : initial_states) require_finite("initial state", state.sum(), "");
  return detail::BasinSearch<Travel, Tiles>(loop, limits, travel, for_tiles).run(initial_states);
}

/// The attractor of each of many initial states [z₁, ż₁, z₂, ż₂].
///
/// Distinct attractors are told apart by their orbits; copies of one that run some common periods
/// of sampling and forcing later are the same attractor. An initial state counts as an attractor's
/// only once its motion is in a neighbourhood from which it surely tends to it.
/// @param loop            the loop with its excitation and backlash
/// @param initial_states  each (m, m/s, m, m/s), finite; may be none
/// @param limits          of each search for one motion's own orbit; motions travel on in between,
///                        so that more of them may be found than by searches alone
/// @tparam Scalar         the lanes: `double`, or a SIMD pack
/// @param for_tiles       for_tiles(count, tile, job) calls job(first, number) for tiles that cover
///                        0 … count − 1, on as many threads as it likes; the result does not depend
///                        on it
/// @throws InvalidParameter where loop, states or limits are not admissible
template <class Scalar, class Tiles>
BasinMap find_basins(const IdealLoop<double>& loop,
                     const std::vector<Vector<double, 4>>& initial_states,
                     const OrbitLimits& limits, const Tiles& for_tiles) {
  const auto travel = [](const IdealLoop<double>& of, const Rational& ratio) {
    return MotionBatch<Scalar>(of, ratio);
  };
  return find_basins_by(travel, loop, initial_states, limits, for_tiles);
}

}  // namespace holdfast
