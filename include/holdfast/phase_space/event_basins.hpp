#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
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
#include "holdfast/phase_space/lane_scheduler.hpp"
#include "holdfast/phase_space/motion_batch.hpp"
#include "holdfast/plant/port_readings.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

namespace detail {

/// Neighbourhoods of an orbit's points, with a radius of 10⁻⁶ of its extent (`StateScaleOf`).
template <class Plant>
struct Neighbourhoods<ImplementedLoopOf<Plant>> {
  using Orbit = EventOrbitOf<states_of<Plant>>;

  struct Point {
    std::size_t sample;          ///< index of a sample of the orbit
    StateOf<Plant> state;        ///< state at sample `sample`
    StateScaleOf<Plant> extent;  ///< extent of the orbit

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

/// Test of whether a motion settles on an orbit of a set, by stroboscopic states and contact modes.
/// @tparam Plant  plant of an ImplementedLoopOf
template <class Plant>
class ApproachOf {
  using Attractors = AttractorSet<ImplementedLoopOf<Plant>>;
  using Orbit = typename Attractors::Orbit;

 public:
  /// @param known    orbits of the set; they must outlive this object
  /// @param samples  largest number of samples before the test fails
  /// @param period   q, samples from one stroboscopic instant to the next
  ApproachOf(const Attractors& known, std::int64_t samples, std::int64_t period)
      : known_(&known), samples_(samples), period_(period) {}

  /// Examines the state at a stroboscopic instant (sampling and forcing in phase) before sense().
  /// @param is_followed  false where changes of contact accumulate
  /// @return whether the motion must be advanced to the next instant
  bool goes_on(const StateOf<Plant>& state, bool is_followed) {
    const bool followed = is_followed && state.cwiseAbs().maxCoeff() < 1e100;
    if (entry_ != nullptr) {
      if (followed && compared_ < static_cast<std::int64_t>(orbit().modes.size())) return true;
      if (followed && keeps_course(state)) return orbit_ < 0;
      entry_ = nullptr;
      return followed;
    }
    if (taken_ >= samples_ || !followed) return false;
    entry_ = known_->near(Place{state});
    if (entry_ != nullptr) {
      distances_[0] = entry_->point.distance(state);
      periods_ = 0;
      begin_period();
    }
    return true;
  }

  /// Records the contact mode of a sample.
  void took(ContactMode mode) {
    ++taken_;
    if (entry_ == nullptr) return;
    const auto& modes = orbit().modes;
    const auto at = (entry_->point.sample + static_cast<std::size_t>(compared_)) % modes.size();
    keeps_ = mode == modes[at] && keeps_;
    ++compared_;
  }

  /// The number of the orbit on which the motion settles; −1 if there is none.
  int found() const { return orbit_; }
  /// The number of samples between two stroboscopic instants.
  std::int64_t period() const { return period_; }

 private:
  struct Place {
    const StateOf<Plant>& state;
  };

  const Orbit& orbit() const { return known_->orbits()[static_cast<std::size_t>(entry_->orbit)]; }

  void begin_period() {
    compared_ = 0;
    keeps_ = true;
  }

  /// Whether the motion had the orbit's contact modes in the last period. After two periods its
  /// distance from the orbit must also have decreased as stated at find_basins().
  bool keeps_course(const StateOf<Plant>& state) {
    if (!keeps_) return false;
    distances_[++periods_] = entry_->point.distance(state);
    begin_period();
    if (periods_ < 2) return true;
    // μ itself is the factor in the long run only: a deviation turns while it shrinks.
    constexpr double share = 0.9, rounding = 1e-11;
    const double factor = std::exp(share * orbit().multipliers.front().log_modulus);
    if (!(distances_[1] <= std::max(distances_[0], rounding) &&
          distances_[2] <= std::max(factor * distances_[1], rounding)))
      return false;
    orbit_ = entry_->orbit;
    return true;
  }

  const Attractors* known_;
  std::int64_t samples_, period_, taken_ = 0, compared_ = 0;
  const typename Attractors::Entry* entry_ = nullptr;  // whose orbit it may come to
  int periods_ = 0, orbit_ = -1;
  bool keeps_ = true;
  double distances_[3] = {};
};

/// The number of the orbit of a set on which a motion settles; −1 if on none within `samples`.
/// @param start  the motion at a stroboscopic instant (sampling and forcing in phase)
template <class Contact, class Attractors>
int approached_orbit(const EventMotion<Contact>& start, const Rational& ratio,
                     const Attractors& known, const OrbitLimits& limits, std::int64_t samples) {
  RepeatingMotion<Contact> motion(start, ratio.denominator);
  ApproachOf<typename EventMotion<Contact>::Plant> approach(known, samples, motion.period());
  while (approach.goes_on(motion.motion().state(), !motion.motion().counts().accumulates)) {
    if (limits.watch) limits.watch();
    for (std::int64_t j = 0; j < motion.period(); ++j) {
      approach.took(motion.sense().mode);
      motion.advance();
    }
  }
  return approach.found();
}

/// The number of samples in which most motions approach the orbit on which they settle: enough to
/// reduce a deviation by a factor of 10⁸, plus eight periods; at most the number in `limits`.
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

/// The scheduler of motions of two masses that are run towards the orbits of a set. It gives each
/// lane its next motion and records the orbit on which a motion settles.
/// @tparam Plant  TwoMass<double>
template <class Plant = TwoMass<double>>
class EventScheduler final : public LaneScheduler {
 public:
  using Approach = ApproachOf<Plant>;

  /// @param motions  array of `count` motions
  /// @param fresh    an ApproachOf before its first state, copied for every motion
  EventScheduler(ActiveTrajectory* motions, std::size_t count, const Approach& fresh,
                 const OrbitLimits& limits)
      : next_(motions), end_(motions + count), fresh_(fresh), limits_(limits) {}

  bool next(std::size_t lane, Vector<double, 4>& start) override {
    if (next_ == end_) return false;
    places_[lane] = {next_++, fresh_};
    start = places_[lane]->motion->memory.state;
    return true;
  }
  bool goes_on(std::size_t lane, const Vector<double, 4>& state, bool is_followed) override {
    if (limits_.watch) limits_.watch();
    Place& place = *places_[lane];
    const bool on = place.approach.goes_on(state, is_followed);
    if (!on) place.motion->orbit = place.approach.found();
    return on;
  }
  void took(std::size_t lane, ContactMode mode) override { places_[lane]->approach.took(mode); }
  std::int64_t period() const override { return fresh_.period(); }

 private:
  struct Place {
    ActiveTrajectory* motion;
    Approach approach;
  };

  ActiveTrajectory* next_;
  ActiveTrajectory* end_;
  Approach fresh_;
  const OrbitLimits& limits_;
  std::array<std::optional<Place>, 8> places_;
};

/// The motions of a loop ImplementedLoopOf<Plant>. Each motion is compared with the orbits found in
/// earlier rounds. If it settles on none of them, its own orbit is searched for.
/// @tparam Begin  map [z₁, ż₁, z₂, ż₂] ↦ x
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
        approached_orbit(motion, ratio, known, limits, patience(known.orbits(), limits));
    if (number >= 0) return {{OrbitOutcome::certified, number}, {}};
    return own_orbit(find_event_orbit(motion, limits));
  }

  /// Does nothing: only `search` advances motions of this kind.
  template <class Tiles>
  void advance(std::vector<ActiveTrajectory>&, const AttractorSet<Loop>&, const Tiles&) const {}
};

/// The motions of an ImplementedLoop that has_event_pack(). All remaining motions are followed side
/// by side, from their initial states, towards the orbits known so far.
template <class Plant, class Propagator>
struct BatchedMotions<ImplementedLoopOf<Plant>, Propagator> {
  using Loop = ImplementedLoopOf<Plant>;

  Loop loop;
  Rational ratio;
  OrbitLimits limits;
  const Propagator& propagate;
  std::size_t passed = 0;  // orbits that all have gone past

  static std::optional<Rational> ratio_of(const Loop& loop) { return forcing_ratio(loop.digital); }

  FoundOrbit<EventOrbit> search(const ActiveTrajectory& from,
                                const AttractorSet<Loop>& /*known*/) const {
    return own_orbit(find_event_orbit(event_motion(loop, from.memory.state), limits));
  }

  template <class Tiles>
  void advance(std::vector<ActiveTrajectory>& motions, const AttractorSet<Loop>& known,
               const Tiles& for_tiles) {
    if (known.orbits().size() == passed) return;
    passed = known.orbits().size();
    const std::int64_t samples = patience(known.orbits(), limits);
    constexpr std::size_t tile = 64;
    for_tiles(motions.size(), tile, [&](std::size_t first, std::size_t number) {
      EventScheduler<> scheduler(motions.data() + first, number,
                                 {known, samples, ratio.denominator}, limits);
      propagate(loop, scheduler);
    });
  }
};

}  // namespace detail

/// Computes the basins of attraction of an implemented loop: one attractor per initial state.
///
/// A motion is assigned to an attractor if a search that starts from the motion certifies the
/// attractor's orbit. It is also assigned if its distance from a certified orbit falls below 10⁻⁶
/// of the orbit's extent and its contact modes then equal the orbit's for two periods. In the first
/// period the distance must not increase. In the second it must shrink to at most μ^0.9 times its
/// value, except for round-off. Here μ is the largest modulus of the orbit's multipliers.
/// @param loop            the loop with its hardware
/// @param initial_states  states [z₁, ż₁, z₂, ż₂] (m, m/s, m, m/s), finite; may be empty
/// @param limits          limits of each search for the orbit of a single motion
/// @param for_tiles       see find_basins() of an IdealLoop
/// @param begin           map from an initial state to the state x of the plant, N × 1
/// @throws InvalidParameter where loop, states or limits are not admissible
template <class Plant, class Tiles, class Begin>
BasinsOf<EventOrbitOf<states_of<Plant>>> find_basins(
    const ImplementedLoopOf<Plant>& loop, const std::vector<Vector<double, 4>>& initial_states,
    const OrbitLimits& limits, const Tiles& for_tiles, const Begin& begin) {
  return detail::basins_by<detail::SingleMotions<ImplementedLoopOf<Plant>, Begin>>(
      loop, initial_states, limits, for_tiles, begin);
}
/// Computes the basins of attraction of two masses. Each initial state is a state of the plant.
template <class Tiles>
BasinsOf<EventOrbit> find_basins(const ImplementedLoop& loop,
                                 const std::vector<Vector<double, 4>>& initial_states,
                                 const OrbitLimits& limits, const Tiles& for_tiles) {
  return find_basins(loop, initial_states, limits, for_tiles,
                     [](const Vector<double, 4>& state) { return state; });
}

}  // namespace holdfast
