#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/orbit/event/event_orbit.hpp"
#include "holdfast/orbit/event/event_orbit_search.hpp"
#include "holdfast/orbit/event/return_map.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/orbit/state_scale.hpp"
#include "holdfast/phase_space/attractor_set.hpp"
#include "holdfast/phase_space/basins.hpp"
#include "holdfast/phase_space/motion_batch.hpp"
#include "holdfast/plant/port_readings.hpp"
#include "holdfast/plant/ports.hpp"

namespace holdfast {

namespace detail {

/// Those within a millionth of how far an orbit reaches (`StateScaleOf`).
template <class Plant>
struct Neighbourhoods<ImplementedLoopOf<Plant>> {
  using Orbit = EventOrbitOf<states_of<Plant>>;

  struct Point {
    std::size_t sample;          ///< of the orbit
    StateOf<Plant> state;        ///< there
    StateScaleOf<Plant> extent;  ///< of the orbit

    double distance(const StateOf<Plant>& other) const { return extent.share_of(other - state); }
  };

  PortReadings<Plant> readings;

  explicit Neighbourhoods(const ImplementedLoopOf<Plant>& loop) : readings(loop.plant) {}

  std::vector<Point> points_of(const Orbit& orbit) const {
    const StateScaleOf<Plant> extent(readings, orbit.states);
    std::vector<Point> points;
    // A state of rest has no extent to tell what is near.
    if (!(extent.sides().displacement > 0.0)) return points;
    const auto step = static_cast<std::size_t>(orbit.ratio.denominator);
    for (std::size_t sample = 0; sample < orbit.states.size(); sample += step)
      points.push_back({sample, orbit.states[sample], extent});
    return points;
  }
  double reach(const Point& point) const { return nearness * point.extent.largest()[0]; }
  template <class Memory>
  bool holds(const Point& point, const Memory& motion) const {
    return point.distance(motion.state) <= nearness;
  }

  static constexpr double nearness = 1e-6;
};

/// A motion that may come to an orbit of a set.
template <class Contact>
class ApproachingMotion {
  using Plant = typename EventMotion<Contact>::Plant;
  using Attractors = AttractorSet<ImplementedLoopOf<Plant>>;
  using Orbit = typename Attractors::Orbit;

 public:
  /// @param start  at a stroboscopic instant (sampling and forcing in phase)
  ApproachingMotion(const EventMotion<Contact>& start, const Rational& ratio)
      : motion_(start, ratio.denominator) {}

  /// @return the number of the orbit of `known` that it comes to; −1: none in so many samples
  int run(const Attractors& known, const OrbitLimits& limits, std::int64_t samples) {
    while (taken_ < samples && is_followed()) {
      if (limits.watch) limits.watch();
      const auto* const entry = known.near(motion_.point());
      if (entry != nullptr) {
        const Orbit& orbit = known.orbits()[static_cast<std::size_t>(entry->orbit)];
        if (comes_to(orbit, entry->point)) return entry->orbit;
      }
      for (std::int64_t j = 0; j < motion_.period(); ++j) take();
    }
    return -1;
  }

 private:
  const StateOf<Plant>& state() const { return motion_.motion().state(); }

  bool is_followed() const {
    return state().cwiseAbs().maxCoeff() < 1e100 && !motion_.motion().counts().accumulates;
  }

  ContactMode take() {
    const ContactMode mode = motion_.sense().mode;
    motion_.advance();
    ++taken_;
    return mode;
  }

  /// Whether the motion keeps to the orbit's modes and comes nearer over two of its periods, in the
  /// second one as its largest multiplier asks.
  template <class Point>
  bool comes_to(const Orbit& orbit, const Point& point) {
    double distances[3] = {point.distance(state())};
    for (const int period : {1, 2}) {
      bool keeps = true;
      for (std::size_t j = 0; j < orbit.modes.size(); ++j)
        keeps = take() == orbit.modes[(point.sample + j) % orbit.modes.size()] && keeps;
      if (!keeps) return false;
      distances[period] = point.distance(state());
    }
    // μ itself is the factor in the long run only: a deviation turns while it shrinks.
    constexpr double share = 0.9, rounding = 1e-11;
    const double factor = std::exp(share * orbit.multipliers.front().log_modulus);
    return distances[1] <= std::max(distances[0], rounding) &&
           distances[2] <= std::max(factor * distances[1], rounding);
  }

  RepeatingMotion<Contact> motion_;
  std::int64_t taken_ = 0;
};

/// Within so many samples most motions that come to one of the orbits are near it: those in which a
/// deviation shrinks by 10⁸, and a few periods.
template <class Orbit>
std::int64_t patience(const std::vector<Orbit>& orbits, const OrbitLimits& limits) {
  double samples = 0.0;
  for (const Orbit& orbit : orbits) {
    const double periods = std::log(1e8) / -orbit.multipliers.front().log_modulus;
    samples =
        std::max(samples, static_cast<double>(orbit.period_samples()) * (8.0 + std::ceil(periods)));
  }
  const std::int64_t most =
      limits.most_samples > 0 ? limits.most_samples : 8 * limits.largest_period;
  return static_cast<std::int64_t>(std::min(samples, static_cast<double>(most)));
}

/// Motions of an ImplementedLoopOf a plant: each goes past the orbits that the rounds before have
/// found, and is searched for its own where it comes to none of them.
/// @tparam Begin  [z₁, ż₁, z₂, ż₂] ↦ x
template <class LoopModel, class Begin>
struct SingleMotions {
  using Loop = LoopModel;
  using Orbit = typename AttractorSet<Loop>::Orbit;

  Loop loop;
  Rational ratio;
  OrbitLimits limits;
  const Begin& begin;

  static std::optional<Rational> ratio_of(const Loop& loop) { return forcing_ratio(loop.digital); }

  FoundOrbit<Orbit> search(const ActiveTrajectory& from, const AttractorSet<Loop>& known) const {
    const auto motion = event_motion(loop, begin(from.memory.state));
    const int number =
        ApproachingMotion(motion, ratio).run(known, limits, patience(known.orbits(), limits));
    if (number >= 0) return {{OrbitOutcome::certified, number}, {}};
    auto found = find_event_orbit(motion, limits);
    if (found.outcome != OrbitOutcome::certified) found.orbit.reset();
    return {{found.outcome, -1}, std::move(found.orbit)};
  }

  /// They move on in their searches alone.
  template <class Tiles>
  void advance(std::vector<ActiveTrajectory>&, const AttractorSet<Loop>&, const Tiles&) const {}
};

}  // namespace detail

/// find_basins() of an implemented loop.
///
/// A motion is an attractor's where its own search certifies that orbit, or where it comes within a
/// millionth of the extent of an orbit that another search has certified, keeps to its modes for
/// two periods and comes nearer over both, over the second by 0.9 of the decay (in logarithms) that
/// the largest multiplier asks.
/// @param loop            as it is built
/// @param initial_states  each [z₁, ż₁, z₂, ż₂] (m, m/s, m, m/s), finite; may be none
/// @param limits          of each search for one motion's own orbit
/// @param for_tiles       as find_basins() of an IdealLoop takes it
/// @param begin           such a state ↦ x of the plant, N × 1
/// @throws InvalidParameter where loop, states or limits are not admissible
template <class Plant, class Tiles, class Begin>
BasinsOf<EventOrbitOf<states_of<Plant>>> find_basins(
    const ImplementedLoopOf<Plant>& loop, const std::vector<Vector<double, 4>>& initial_states,
    const OrbitLimits& limits, const Tiles& for_tiles, const Begin& begin) {
  return detail::basins_by<detail::SingleMotions<ImplementedLoopOf<Plant>, Begin>>(
      loop, initial_states, limits, for_tiles, begin);
}
/// The same of two masses, which begin with the states as they are.
template <class Tiles>
BasinsOf<EventOrbit> find_basins(const ImplementedLoop& loop,
                                 const std::vector<Vector<double, 4>>& initial_states,
                                 const OrbitLimits& limits, const Tiles& for_tiles) {
  return find_basins(loop, initial_states, limits, for_tiles,
                     [](const Vector<double, 4>& state) { return state; });
}

}  // namespace holdfast
