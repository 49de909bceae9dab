#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/orbit/event/event_orbit.hpp"
#include "holdfast/orbit/event/event_orbit_search.hpp"
#include "holdfast/orbit/event/return_map.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/phase_space/attractor_set.hpp"
#include "holdfast/phase_space/basins.hpp"

namespace holdfast {

/// Which attractor each of many initial states of an ImplementedLoop comes to.
using EventBasinMap = BasinsOf<EventOrbit>;

namespace detail {

/// The different orbits of one ImplementedLoop, by their points at the stroboscopic instants,
/// sampling and forcing in phase.
/// @tparam Orbit  EventOrbit
template <class Orbit>
class EventAttractorSet {
 public:
  /// A point of an orbit.
  struct Place {
    int orbit;
    std::size_t sample;
  };

  /// @return the orbit's number, that of an earlier one of which it is a copy
  int add(Orbit orbit) {
    for (std::size_t k = 0; k < orbits_.size(); ++k)
      if (is_phase_shifted_copy(orbits_[k], orbit)) return static_cast<int>(k);
    const int number = static_cast<int>(orbits_.size());
    Vector<double, 4> extent = Vector<double, 4>::Zero();
    for (const auto& state : orbit.states) extent = extent.cwiseMax(state.cwiseAbs());
    // A state of rest has no extent to tell what is near.
    if (extent.minCoeff() > 0.0) add_places(orbit, number, extent[0]);
    patience_ = std::max(patience_, samples_to_come(orbit));
    extents_.push_back(extent);
    orbits_.push_back(std::move(orbit));
    return number;
  }

  const std::vector<Orbit>& orbits() const { return orbits_; }

  /// Within so many samples most motions that come to one of the orbits are near it.
  double patience() const { return patience_; }

  /// Where a motion is that has come within a millionth of an orbit's extent; nothing where it has
  /// not. Ask at a stroboscopic instant.
  std::optional<Place> near(const Vector<double, 4>& state) const {
    auto entry = std::lower_bound(
        entries_.begin(), entries_.end(), state[0] - largest_reach_,
        [](const Entry& candidate, double value) { return candidate.displacement < value; });
    for (; entry != entries_.end() && entry->displacement <= state[0] + largest_reach_; ++entry)
      if (distance(state, entry->place) <= nearness) return entry->place;
    return std::nullopt;
  }

  /// max_i |z_i − z_i of the orbit| / max |z_i of the orbit|.
  double distance(const Vector<double, 4>& state, const Place& place) const {
    const auto orbit = static_cast<std::size_t>(place.orbit);
    const Vector<double, 4> apart = state - orbits_[orbit].states[place.sample];
    return apart.cwiseAbs().cwiseQuotient(extents_[orbit]).maxCoeff();
  }

 private:
  static constexpr double nearness = 1e-6;

  struct Entry {
    double displacement;  // z₁
    Place place;
  };

  void add_places(const Orbit& orbit, int number, double extent) {
    const auto step = static_cast<std::size_t>(orbit.ratio.denominator);
    for (std::size_t sample = 0; sample < orbit.states.size(); sample += step)
      entries_.push_back({orbit.states[sample][0], {number, sample}});
    std::sort(entries_.begin(), entries_.end(),
              [](const Entry& a, const Entry& b) { return a.displacement < b.displacement; });
    largest_reach_ = std::max(largest_reach_, nearness * extent);
  }

  /// Samples in which a deviation shrinks by 10⁸, and a few periods.
  static double samples_to_come(const Orbit& orbit) {
    const double periods = std::log(1e8) / -orbit.multipliers.front().log_modulus;
    return static_cast<double>(orbit.period_samples()) * (8.0 + std::ceil(periods));
  }

  std::vector<Orbit> orbits_;
  std::vector<Vector<double, 4>> extents_;  // of each orbit
  std::vector<Entry> entries_;              // by displacement
  double largest_reach_ = 0.0;
  double patience_ = 0.0;
};

/// A motion that may come to an orbit of a set.
template <class Contact>
class ApproachingMotion {
  using Attractors = EventAttractorSet<EventOrbit>;

 public:
  /// @param start  at a stroboscopic instant (sampling and forcing in phase)
  ApproachingMotion(const EventMotion<Contact>& start, const Rational& ratio,
                    const Attractors& attractor_set)
      : attractor_set_(attractor_set), motion_(start, ratio.denominator) {}

  /// @return the number of the orbit that it comes to; −1: none in so many samples
  int run(const OrbitLimits& limits, std::int64_t samples) {
    while (taken_ < samples && is_followed()) {
      if (limits.watch) limits.watch();
      const auto place = attractor_set_.near(state());
      if (place && comes_to(*place)) return place->orbit;
      for (std::int64_t j = 0; j < motion_.period(); ++j) take();
    }
    return -1;
  }

 private:
  using Place = Attractors::Place;

  const Vector<double, 4>& state() const { return motion_.motion().state(); }

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
  bool comes_to(const Place& place) {
    const EventOrbit& orbit = attractor_set_.orbits()[static_cast<std::size_t>(place.orbit)];
    const double before = attractor_set_.distance(state(), place);
    if (!keeps_to(orbit, place.sample)) return false;
    const double between = attractor_set_.distance(state(), place);
    if (!keeps_to(orbit, place.sample)) return false;
    const double after = attractor_set_.distance(state(), place);
    // μ itself is the factor in the long run only: a deviation turns while it shrinks.
    constexpr double share = 0.9, rounding = 1e-11;
    const double factor = std::exp(share * orbit.multipliers.front().log_modulus);
    return between <= std::max(before, rounding) && after <= std::max(factor * between, rounding);
  }

  /// One period.
  bool keeps_to(const EventOrbit& orbit, std::size_t first) {
    bool keeps = true;
    for (std::size_t j = 0; j < orbit.modes.size(); ++j)
      keeps = take() == orbit.modes[(first + j) % orbit.modes.size()] && keeps;
    return keeps;
  }

  const Attractors& attractor_set_;
  RepeatingMotion<Contact> motion_;
  std::int64_t taken_ = 0;
};

/// Finds the labels of many initial states, in rounds of ever more of them. A motion first goes
/// past the orbits that the rounds before have found, and is searched for its own where it comes to
/// none of them. Nothing depends on the order in which the states of a round are done.
/// @tparam Tiles   as in BasinSearch
template <class Tiles>
class EventBasinSearch {
 public:
  EventBasinSearch(const ImplementedLoop& loop, const Rational& ratio, const OrbitLimits& limits,
                   const Tiles& for_tiles)
      : loop_(loop), ratio_(ratio), limits_(limits), for_tiles_(for_tiles) {}

  EventBasinMap run(const std::vector<Vector<double, 4>>& initial_states) {
    std::vector<BasinLabel> labels(initial_states.size());
    std::vector<std::size_t> left(initial_states.size());
    for (std::size_t k = 0; k < left.size(); ++k) left[k] = k;
    std::size_t most = 8;
    while (!left.empty()) {
      const std::vector<std::size_t> chosen = taken_out(left, most);
      std::vector<Found> found(chosen.size());
      for_tiles_(chosen.size(), 1, [&](std::size_t first, std::size_t number) {
        for (std::size_t k = first; k < first + number; ++k)
          found[k] = searched(initial_states[chosen[k]]);
      });
      for (std::size_t k = 0; k < chosen.size(); ++k) labels[chosen[k]] = noted(found[k]);
      most = std::min(2 * most, largest_round);
    }
    return numbered_basins(std::move(labels), attractor_set_.orbits());
  }

 private:
  static constexpr std::size_t largest_round = std::size_t{1} << 16U;

  struct Found {
    BasinLabel label;
    std::optional<EventOrbit> orbit;  // where it is not of the set
  };

  /// Some of the states that are left, evenly spread.
  static std::vector<std::size_t> taken_out(std::vector<std::size_t>& left, std::size_t most) {
    const std::size_t count = std::min(most, left.size());
    std::vector<std::size_t> chosen, rest;
    for (std::size_t k = 0; k < left.size(); ++k) {
      const bool next = chosen.size() < count && k == chosen.size() * left.size() / count;
      (next ? chosen : rest).push_back(left[k]);
    }
    left = std::move(rest);
    return chosen;
  }

  Found searched(const Vector<double, 4>& initial_state) const {
    return with_motion(loop_, initial_state, [this](const auto& motion) {
      const std::int64_t most =
          limits_.most_samples > 0 ? limits_.most_samples : 8 * limits_.largest_period;
      const double samples = std::min(attractor_set_.patience(), static_cast<double>(most));
      const int known = ApproachingMotion(motion, ratio_, attractor_set_)
                            .run(limits_, static_cast<std::int64_t>(samples));
      if (known >= 0) return Found{{OrbitOutcome::certified, known}, std::nullopt};
      auto search = find_event_orbit(motion, ratio_, limits_);
      if (search.outcome != OrbitOutcome::certified) search.orbit.reset();
      return Found{{search.outcome, -1}, std::move(search.orbit)};
    });
  }

  BasinLabel noted(Found& found) {
    if (found.orbit) found.label.attractor = attractor_set_.add(std::move(*found.orbit));
    return found.label;
  }

  ImplementedLoop loop_;
  Rational ratio_;
  OrbitLimits limits_;
  const Tiles& for_tiles_;
  EventAttractorSet<EventOrbit> attractor_set_;
};

}  // namespace detail

/// The attractor of each of many initial states [z₁, ż₁, z₂, ż₂] of an implemented loop.
///
/// Distinct attractors are told apart by their orbits; copies of one that run some common periods
/// of sampling and forcing later are the same attractor. A motion is an attractor's where its own
/// search certifies that orbit, or where it comes within a millionth of the extent of an orbit that
/// another search has certified, keeps to its modes for two periods and comes nearer over both,
/// over the second by 0.9 of the decay (in logarithms) that the largest multiplier asks.
/// @param loop            as it is built
/// @param initial_states  each (m, m/s, m, m/s), finite; may be none
/// @param limits          of each search for one motion's own orbit
/// @param for_tiles       for_tiles(count, tile, job) calls job(first, number) for tiles that cover
///                        0 … count − 1, on as many threads as it likes; the result does not depend
///                        on it
/// @throws InvalidParameter where loop, states or limits are not admissible
template <class Tiles>
EventBasinMap find_event_basins(const ImplementedLoop& loop,
                                const std::vector<Vector<double, 4>>& initial_states,
                                const OrbitLimits& limits, const Tiles& for_tiles) {
  validate(loop);
  validate(limits);
  for (const auto& state : initial_states) require_finite("initial state", state.sum(), "");
  const auto ratio = forcing_ratio(loop.digital);
  if (ratio && ratio->denominator <= limits.largest_period)
    return detail::EventBasinSearch<Tiles>(loop, *ratio, limits, for_tiles).run(initial_states);
  const auto outcome = ratio ? OrbitOutcome::none_found : OrbitOutcome::incommensurate;
  return {std::vector<BasinLabel>(initial_states.size(), {outcome, -1}), {}};
}

}  // namespace holdfast
