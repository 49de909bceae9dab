#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

#include "holdfast/core/rational.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/modal/modal_motion.hpp"
#include "holdfast/motion/modal/natural_motions.hpp"
#include "holdfast/orbit/modal/modal_orbit_search.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/phase_space/attractor_set.hpp"
#include "holdfast/phase_space/basins.hpp"
#include "holdfast/phase_space/event_basins.hpp"
#include "holdfast/plant/plant_poles.hpp"

namespace holdfast {
namespace detail {

/// Regions of attraction of a modal conductor's orbits, each around the first state of its orbit.
template <class Loop>
struct ModalNeighbourhoods {
  using Orbit = PeriodicOrbit;

  struct Point {
    Vector<double, 4> state;  ///< first state of the orbit
    ModalAttraction region;
  };
  /// The state of a motion at a stroboscopic instant.
  struct Seen {
    const ModalMotion& motion;
    Vector<double, 4> state;
  };

  Loop loop;
  std::shared_ptr<const ModalItineraryMaps> maps;

  explicit ModalNeighbourhoods(const Loop& of) : loop(of) {
    const auto ratio = forcing_ratio(of);
    const auto poles = plant_poles(of.modes, of.absorber);
    if (ratio && !poles.empty())
      maps = std::make_shared<const ModalItineraryMaps>(of, poles, *ratio);
  }

  std::vector<Point> points_of(const Orbit& orbit) const {
    const auto region = modal_attraction(loop, *maps, orbit);
    if (!region) return {};
    return {{orbit.states.front().template head<4>(), *region}};
  }
  /// The reach in z₁, here infinite: a region is no ball, so that every region must be tested.
  double reach(const Point&) const { return std::numeric_limits<double>::infinity(); }
  bool holds(const Point& point, const Seen& seen) const {
    return attracts(point.region, seen.motion, maps->units());
  }
};

template <>
struct Neighbourhoods<ModalLoop> : ModalNeighbourhoods<ModalLoop> {
  using ModalNeighbourhoods<ModalLoop>::ModalNeighbourhoods;
};

/// The motions of a conductor given by its modes. Each motion is compared with the regions found in
/// earlier rounds. If it enters none of them, its own orbit is searched for.
template <class LoopModel>
struct ModalMotions {
  using Loop = LoopModel;

  Loop loop;
  Rational ratio;
  OrbitLimits limits;
  std::vector<PlantPole> poles = plant_poles(loop.modes, loop.absorber);

  static std::optional<Rational> ratio_of(const Loop& loop) { return forcing_ratio(loop); }

  FoundOrbit<PeriodicOrbit> search(const ActiveTrajectory& from,
                                   const AttractorSet<Loop>& known) const {
    if (poles.empty()) return {};
    const ModalMotion start(loop, poles, modal_state(loop.modes, from.memory.state));
    const int number = attracted(start, known);
    if (number >= 0) return {{OrbitOutcome::certified, number}, {}};
    const ModalItineraryMaps maps(loop, poles, ratio, limits.watch);
    return own_orbit(orbit_by_returns(loop, ratio, limits, start, ModalRegion<Loop>(loop, maps)));
  }

  /// Does nothing: only `search` advances motions of this kind.
  template <class Tiles>
  void advance(std::vector<ActiveTrajectory>&, const AttractorSet<Loop>&, const Tiles&) const {}

 private:
  /// The number of a known orbit whose region the motion enters within patience() samples, or −1.
  int attracted(ModalMotion motion, const AttractorSet<Loop>& known) const {
    const std::int64_t most = patience(known.orbits(), limits);
    for (std::int64_t j = 0; j < most; ++j) {
      if (j % ratio.denominator == 0) {
        if (limits.watch) limits.watch();
        if (!(motion.state().cwiseAbs().maxCoeff() < 1e100)) return -1;
        const int number =
            known.attracted_by(typename Neighbourhoods<Loop>::Seen{motion, motion.state()});
        if (number >= 0) return number;
      }
      motion.sense();
      motion.advance();
    }
    return -1;
  }
};

}  // namespace detail

/// Computes the basins of attraction of a loop whose conductor is given by its modes. A motion is
/// assigned to an attractor if a search that starts from the motion certifies the attractor's
/// orbit, or if the motion enters the region of attraction of a certified orbit.
/// @param loop            loop with its excitation and backlash
/// @param initial_states  states [z₁, ż₁, z₂, ż₂] (m, m/s, m, m/s), finite. The conductor begins
///                        as deflected by a static force and struck by an impulse at the absorber
/// @param limits          limits of each search for the orbit of a single motion
/// @param for_tiles       see find_basins() of an IdealLoop
/// @throws InvalidParameter where loop, states or limits are not admissible
template <class Loop, class Tiles, std::enable_if_t<std::is_same_v<Loop, ModalLoop>, int> = 0>
BasinMap find_basins(const Loop& loop, const std::vector<Vector<double, 4>>& initial_states,
                     const OrbitLimits& limits, const Tiles& for_tiles) {
  return detail::basins_by<detail::ModalMotions<Loop>>(loop, initial_states, limits, for_tiles);
}

}  // namespace holdfast
