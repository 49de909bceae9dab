#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/orbit/event/event_motion_region.hpp"
#include "holdfast/orbit/event/event_orbit_search.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/phase_space/attractor_set.hpp"
#include "holdfast/phase_space/motion_batch.hpp"

namespace holdfast {

/// A certified, attracting periodic motion found in a cell.
struct MappedMotion {
  std::int64_t period_samples;   ///< number N of samples in a period
  double period;                 ///< period N τ (s)
  std::int64_t forcing_periods;  ///< number of forcing periods in one period of the motion
  double amplitude;              ///< largest |z₁| (m) at a sample
  double largest_multiplier;     ///< largest modulus of the Floquet multipliers, per period
  double border_share;           ///< distance to nearest switching surface over the orbit's size
};

/// A cell of a map, with the periodic motions found in that cell.
struct MapCell {
  /// The outcome of the motion from the initial state: `certified`, or why no orbit was found.
  OrbitOutcome outcome = OrbitOutcome::none_found;
  std::vector<MappedMotion> motions;  ///< distinct motions; the first is from_start(), if any

  /// The motion from the initial state; null where that motion settles on no periodic orbit.
  const MappedMotion* from_start() const {
    return outcome == OrbitOutcome::certified ? &motions.front() : nullptr;
  }
};

/// The numbers of rows and columns of a grid of cells in a plane of two parameters.
struct MapShape {
  std::size_t rows;     ///< number of values of the first parameter, ≥ 1
  std::size_t columns;  ///< number of values of the second parameter, ≥ 1

  /// The number of cells, rows × columns; the cell index is row × columns + column, from 0.
  std::size_t cells() const { return rows * columns; }
};

namespace detail {

template <class Orbit>
MappedMotion mapped(const Orbit& orbit) {
  return {orbit.period_samples(),     orbit.period(),
          orbit.forcing_periods(),    orbit.amplitude(),
          orbit.largest_multiplier(), orbit.border_share()};
}

/// The search for motions of IdealLoops in a map, and their continuation in another cell.
template <class Scalar>
struct SampledMapModel {
  using Loop = IdealLoop<Scalar>;
  using Orbit = PeriodicOrbit;

  /// The data from which a motion is continued: its itinerary determines the orbit.
  struct Seed {
    Rational ratio;
    Itinerary itinerary;
    ForcedMotionMemory<Scalar> memory;
  };

  OrbitLimits limits;

  std::optional<Rational> ratio_of(const Loop& loop) const { return forcing_ratio(loop); }

  Seed seed_of(const Orbit& orbit) const {
    return {orbit.ratio,
            orbit.itinerary,
            {orbit.states.front().template head<4>(), orbit.states.front()[4], orbit.memory}};
  }

  bool is_same(const Seed& known, const Seed& other) const {
    const auto step = static_cast<std::size_t>(known.ratio.denominator);
    return is_rotated(known.itinerary, other.itinerary, step, std::equal_to<>());
  }

  OrbitResult from_start(const Loop& loop, const Vector<Scalar, 4>& state) const {
    return find_periodic_orbit(loop, state, limits);
  }

  OrbitResult continued(const Loop& loop, const Rational& ratio, const Seed& seed) const {
    if (ratio.numerator != seed.ratio.numerator || ratio.denominator != seed.ratio.denominator)
      return {};
    const Backlash<Scalar> law(loop.backlash_width, resized(seed.memory, loop).backlash);
    return orbit_of_itinerary(loop, ratio, ItineraryMaps<Scalar>(loop, ratio), seed.itinerary, law);
  }

  OrbitResult from_neighbour(const Loop& loop, const Rational& ratio, const Seed& seed) const {
    auto motion = periodically_forced_motion(loop, ratio, Vector<Scalar, 4>::Zero().eval());
    motion.restore(resized(seed.memory, loop));
    return orbit_of_motion(loop, ratio, limits, motion);
  }

 private:
  /// The memory, its gap resized to the loop's width and moved just enough to contain Δz.
  static ForcedMotionMemory<Scalar> resized(ForcedMotionMemory<Scalar> memory, const Loop& loop) {
    auto& gap = memory.backlash;
    const Scalar half = loop.backlash_width / 2.0, here = relative_displacement(memory.state);
    const Scalar middle = std::clamp((gap.lower + gap.upper) / 2.0, here - half, here + half);
    gap.lower = middle - half;
    gap.upper = middle + half;
    return memory;
  }
};

/// The search for motions of ImplementedLoops in a map, and their continuation.
template <class Plant>
struct EventMapModel {
  using Loop = ImplementedLoopOf<Plant>;
  using Orbit = EventOrbitOf<states_of<Plant>>;
  using Seed = Orbit;
  using Result = OrbitResultOf<Orbit>;

  OrbitLimits limits;

  std::optional<Rational> ratio_of(const Loop& loop) const { return forcing_ratio(loop.digital); }
  Seed seed_of(const Orbit& orbit) const { return orbit; }
  bool is_same(const Seed& known, const Seed& other) const {
    return is_phase_shifted_copy(known, other);
  }

  Result from_start(const Loop& loop, const StateOf<Plant>& state) const {
    auto found = find_event_orbit(event_motion(loop, state), limits);
    return {found.outcome, std::move(found.orbit), found.samples, found.candidates};
  }

  Result continued(const Loop& loop, const Rational& ratio, const Seed& seed) const {
    if (ratio.numerator != seed.ratio.numerator || ratio.denominator != seed.ratio.denominator)
      return {};
    return continued_orbit(loop, seed);
  }

  /// The motion in another cell, started from a neighbour's state with the drive engaged.
  Result from_neighbour(const Loop& loop, const Rational&, const Seed& seed) const {
    return from_start(loop, seed.states.front());
  }
};

/// The search for the motions of all cells: first from the initial state, then in rounds from the
/// motions found in neighbouring cells in the previous round, until a round finds no new motion.
template <class Model, class LoopAt, class Tiles>
class MotionMapSearch {
  using Seed = typename Model::Seed;
  using State = Vector<double, 4>;

 public:
  MotionMapSearch(const Model& model, const LoopAt& loop_at, const MapShape& shape,
                  const Tiles& for_tiles)
      : model_(model), loop_at_(loop_at), shape_(shape), for_tiles_(for_tiles) {}

  /// @param starts  the initial state, then the other given states
  std::vector<MapCell> run(const std::vector<State>& starts, int most_rounds) {
    cells_.resize(shape_.cells());
    seeds_.resize(shape_.cells());
    fresh_.resize(shape_.cells());
    for_each_cell([&](std::size_t cell) { begin(cell, starts); });
    for (int round = 0; round < most_rounds && take_over(); ++round)
      for_each_cell([&](std::size_t cell) { go_on(cell); });
    take_over();
    return std::move(cells_);
  }

 private:
  struct Found {
    Seed seed;
    MappedMotion motion;
  };

  template <class Job>
  void for_each_cell(const Job& job) {
    for_tiles_(shape_.cells(), std::size_t{1}, [&](std::size_t first, std::size_t number) {
      for (std::size_t cell = first; cell < first + number; ++cell) job(cell);
    });
  }

  /// Passes a round's new motions to the neighbour cells. @return whether there are any
  bool take_over() {
    bool any = false;
    for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
      known_before_.resize(cells_.size());
      known_before_[cell] = seeds_[cell].size();
      for (Found& found : fresh_[cell]) {
        seeds_[cell].push_back(std::move(found.seed));
        cells_[cell].motions.push_back(found.motion);
        any = true;
      }
      fresh_[cell].clear();
    }
    return any;
  }

  void begin(std::size_t cell, const std::vector<State>& starts) {
    const auto loop = loop_at_(cell);
    if (!loop) return;
    for (std::size_t k = 0; k < starts.size(); ++k) {
      auto found = model_.from_start(*loop, starts[k]);
      if (k == 0) cells_[cell].outcome = found.outcome;
      if (found.outcome == OrbitOutcome::certified) add(cell, *found.orbit);
    }
  }

  void go_on(std::size_t cell) {
    for (const std::size_t neighbour : neighbours(cell))
      for (std::size_t k = known_before_[neighbour]; k < seeds_[neighbour].size(); ++k)
        go_on_from(cell, seeds_[neighbour][k]);
  }

  std::vector<std::size_t> neighbours(std::size_t cell) const {
    const std::size_t row = cell / shape_.columns, column = cell % shape_.columns;
    std::vector<std::size_t> found;
    if (row > 0) found.push_back(cell - shape_.columns);
    if (column > 0) found.push_back(cell - 1);
    if (column + 1 < shape_.columns) found.push_back(cell + 1);
    if (row + 1 < shape_.rows) found.push_back(cell + shape_.columns);
    return found;
  }

  void go_on_from(std::size_t cell, const Seed& seed) {
    // Their motions are told apart by their itineraries, or else by their states.
    const auto loop = loop_at_(cell);
    const auto ratio = loop ? model_.ratio_of(*loop) : std::nullopt;
    if (!ratio || ratio->denominator > model_.limits.largest_period) return;
    auto found = model_.continued(*loop, *ratio, seed);
    if (found.outcome != OrbitOutcome::certified || !found.orbit->is_attracting())
      found = model_.from_neighbour(*loop, *ratio, seed);
    if (found.outcome == OrbitOutcome::certified) add(cell, *found.orbit);
  }

  void add(std::size_t cell, const typename Model::Orbit& orbit) {
    Seed seed = model_.seed_of(orbit);
    for (const Seed& known : seeds_[cell])
      if (model_.is_same(known, seed)) return;
    for (const Found& known : fresh_[cell])
      if (model_.is_same(known.seed, seed)) return;
    fresh_[cell].push_back({std::move(seed), mapped(orbit)});
  }

  const Model& model_;
  const LoopAt& loop_at_;
  MapShape shape_;
  const Tiles& for_tiles_;
  std::vector<MapCell> cells_;
  std::vector<std::vector<Seed>> seeds_;   // of the motions that are known
  std::vector<std::vector<Found>> fresh_;  // of this round
  std::vector<std::size_t> known_before_;  // how many seeds of a cell the neighbours have seen
};

}  // namespace detail

/// The options of motion_map().
struct MotionMapOptions {
  /// The limits of each search; motions with periods beyond `largest_period` are not found.
  OrbitLimits limits{10000, 0, {}};
  /// Largest number of rounds of searches from the new motions of neighbouring cells; 0: none.
  int most_rounds = 1000;
  std::vector<Vector<double, 4>> more_starts =
      {};  ///< further initial states for each cell (m, m/s, m, m/s), finite
};

/// The map of periodic motions of many loops on a grid in a plane of two parameters.
///
/// In each cell, motions are first searched for from the initial state and the other given states.
/// Then, in rounds, they are searched for from the motions of the neighbouring cells. Such a motion
/// is continued with its order of contact changes. If no attracting motion results, the search
/// starts from a state of that motion. It ends when a round finds no new motion, or after
/// `most_rounds`. A motion is missed where neither a given state nor a neighbour leads to it. The
/// result does not depend on the order in which the cells are computed.
/// @param loop_at    index of a cell ↦ std::optional of an IdealLoop<double> or ImplementedLoop;
///                   nullopt where the parameters are not admissible; called from many threads
/// @param shape      number of rows and columns
/// @param start      initial state [z₁, ż₁, z₂, ż₂] (m, m/s, m, m/s), finite
/// @param for_tiles  see find_basins()
/// @param options    options of the search
/// @return one entry for each cell, row by row
/// @throws InvalidParameter where start or limits are not admissible
template <class LoopAt, class Tiles>
std::vector<MapCell> motion_map(const LoopAt& loop_at, const MapShape& shape,
                                const Vector<double, 4>& start, const Tiles& for_tiles,
                                const MotionMapOptions& options = {}) {
  using Loop = typename std::decay_t<decltype(loop_at(std::size_t{0}))>::value_type;
  using Model =
      std::conditional_t<std::is_same_v<Loop, IdealLoop<double>>, detail::SampledMapModel<double>,
                         detail::EventMapModel<TwoMass<double>>>;
  std::vector<Vector<double, 4>> starts{start};
  starts.insert(starts.end(), options.more_starts.begin(), options.more_starts.end());
  for (const auto& state : starts) require_finite("initial state", state.sum(), "");
  validate(options.limits);
  const Model model{options.limits};
  return detail::MotionMapSearch<Model, LoopAt, Tiles>(model, loop_at, shape, for_tiles)
      .run(starts, options.most_rounds);
}

}  // namespace holdfast
