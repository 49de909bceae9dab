#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "holdfast/contact/contact.hpp"
#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/orbit/event/event_orbit.hpp"
#include "holdfast/orbit/event/return_map.hpp"
#include "holdfast/orbit/loop_orbit.hpp"
#include "holdfast/orbit/return_search.hpp"

namespace holdfast {

/// The result of a search for the periodic orbit of an EventMotion.
template <class Contact>
struct EventOrbitResult : OrbitResultOf<EventOrbitOf<EventMotion<Contact>::states>> {
  /// Complete state of the motion before the orbit's first sample; nullopt without an orbit.
  std::optional<StroboscopicState<Contact>> point;
};

namespace detail {

/// Records the samples and switches of a motion as an orbit and passes all to EventOrbitMeasures.
template <class Contact>
class PeriodRecorder {
 public:
  using Motion = EventMotion<Contact>;
  using Orbit = EventOrbitOf<Motion::states>;

  PeriodRecorder(const Motion& motion, EventOrbitMeasures<Contact>& measures, Orbit& orbit)
      : motion_(motion), measures_(measures), orbit_(orbit) {}

  void flowed(int mode, double begin, double length) {
    reached_ = begin + length;
    measures_.flowed(mode, begin, length);
  }
  void commanded() { measures_.commanded(); }
  void switched(int from, int to, int guard, const typename Motion::Instant& instant) {
    measures_.switched(from, to, guard, instant);
    note_switch(motion_.contact().word());
  }

  /// Adds a sample, given the contact mode before it.
  void take(ContactMode before, const typename Motion::Sample& sample) {
    orbit_.states.push_back(sample.state);
    orbit_.modes.push_back(sample.mode);
    orbit_.forces.push_back(sample.control_force);
    orbit_.reversals.push_back(motion_.contact().reversal());
    reached_ = 0.0;
    if (sample.mode != before) note_switch(sample.mode);
    measures_.begin();
  }

 private:
  void note_switch(ContactMode mode) {
    const double sample_time =
        static_cast<double>(orbit_.states.size() - 1) * motion_.loop().sampling.period;
    orbit_.switches.push_back({sample_time + reached_, mode});
  }

  const Motion& motion_;
  EventOrbitMeasures<Contact>& measures_;
  Orbit& orbit_;
  double reached_ = 0.0;  // s after the sample
};

/// A sample of an orbit and its distance in time from the nearest switch.
struct FarSample {
  std::int64_t sample = -1;  ///< index j of the sample; −1: every sample is at a switch
  double distance = 0.0;     ///< time from the nearest switch (s)
};

/// The sample in a given contact mode that is farthest in time from any switch.
template <int States>
FarSample sample_far_from_switches(const EventOrbitOf<States>& orbit, ContactMode mode) {
  FarSample best;
  auto next = orbit.switches.begin();
  for (std::int64_t j = 0; j < orbit.period_samples(); ++j) {
    const double time = static_cast<double>(j) * orbit.sampling_period;
    while (next != orbit.switches.end() && next->time < time) ++next;
    if (orbit.modes[static_cast<std::size_t>(j)] != mode) continue;
    double distance = std::numeric_limits<double>::infinity();
    if (!orbit.switches.empty()) {
      const double after =
          next != orbit.switches.end() ? next->time : orbit.switches.front().time + orbit.period();
      const double before = next != orbit.switches.begin()
                                ? std::prev(next)->time
                                : orbit.switches.back().time - orbit.period();
      distance = std::min(after - time, time - before);
    }
    if (distance > best.distance) best = {j, distance};
  }
  return best;
}

/// The sample at which an orbit's return map begins, −1 for none. It is the engaged sample farthest
/// in time from all switches, or the farthest one in a gap if that is at least ten times as far.
template <int States>
std::int64_t section_of(const EventOrbitOf<States>& orbit) {
  constexpr double near = 0.1;
  const FarSample engaged = sample_far_from_switches(orbit, ContactMode::engaged);
  const FarSample gap = sample_far_from_switches(orbit, ContactMode::gap);
  return engaged.distance > near * gap.distance ? engaged.sample : gap.sample;
}

/// Whether two periods have the same modes and switches, at times equal within a tolerance (s).
template <int States>
bool switch_alike(const EventOrbitOf<States>& one, const EventOrbitOf<States>& other,
                  double tolerance) {
  return one.modes == other.modes &&
         std::equal(one.switches.begin(), one.switches.end(), other.switches.begin(),
                    other.switches.end(), [&](const auto& a, const auto& b) {
                      return a.mode == b.mode && std::abs(a.time - b.time) <= tolerance;
                    });
}

/// The solver for an orbit of N samples near a given state; it also measures the orbit.
template <class Contact>
class EventOrbitSolver {
 public:
  using Motion = EventMotion<Contact>;
  using State = typename Motion::State;
  using Extent = StateScaleOf<typename Motion::Plant>;
  using Orbit = EventOrbitOf<Motion::states>;
  using Result = EventOrbitResult<Contact>;
  using Point = StroboscopicState<Contact>;

  EventOrbitSolver(const RepeatingMotion<Contact>& motion, const Rational& ratio)
      : motion_(motion), readings_(motion.motion().readings()), ratio_(ratio) {}

  /// Solves for an orbit of N = `samples` samples near a given state at a stroboscopic instant.
  Result solve(const Point& near, std::int64_t samples) {
    motion_.go_to(near);
    EventOrbitMeasures<Contact> unused(motion_.motion());
    const Orbit way = next_period(samples, unused);
    const std::int64_t section = detail::section_of(way);
    if (section < 0) return {};
    const Extent extent(readings_, way.states);
    const bool gap_opens = !way.switches.empty();
    const auto units = return_units(motion_.motion(), extent, way.forces);
    ReturnMap<Contact> map(motion_, samples, units, gap_opens);
    const Point start = moved(near, section);
    const auto solution = map.fixed_point(start);
    const Point& first = solution ? *solution : start;
    const auto neutral = solution ? std::nullopt : map.neutral_coordinate(start);
    if (!solution && !neutral) return {};
    Result found = measured(moved(first, samples - section), samples, extent);
    const std::int64_t shortest = found.orbit->period_samples();
    if (shortest < samples) map = {motion_, shortest, units, gap_opens};
    found.orbit->multipliers = map.multipliers(first);
    found.neutral_state = solution && is_neutral(found.orbit->multipliers.front())
                              ? map.neutral_coordinate(first)
                              : neutral;
    if (found.neutral_state && found.outcome == OrbitOutcome::certified)
      found.outcome = OrbitOutcome::neutral;
    return found;
  }

 private:
  static bool is_neutral(const Multiplier& largest) {
    return largest.angle == 0.0 && std::abs(largest.log_modulus) <= 1e-8;
  }

  Point moved(const Point& from, std::int64_t samples) {
    motion_.go_to(from);
    for (std::int64_t j = 0; j < samples; ++j) {
      motion_.sense();
      motion_.advance();
    }
    return motion_.point();
  }

  Orbit next_period(std::int64_t samples, EventOrbitMeasures<Contact>& measures) {
    Orbit way{};
    way.ratio = ratio_;
    way.sampling_period = motion_.motion().loop().sampling.period;
    PeriodRecorder<Contact> recorder(motion_.motion(), measures, way);
    for (std::int64_t j = 0; j < samples; ++j) {
      const ContactMode before = motion_.motion().contact().word();
      recorder.take(before, motion_.sense());
      motion_.advance(recorder);
    }
    return way;
  }

  /// Measures the orbit over three periods from its first state, and compares their switches.
  /// @param extent  extent of the simulated motion; the orbit's states may be mere rounding errors
  Result measured(const Point& first, std::int64_t samples, const Extent& extent) {
    motion_.go_to(first);
    EventOrbitMeasures<Contact> measures(motion_.motion());
    Orbit orbit = next_period(samples, measures);
    const auto shortest = static_cast<std::int64_t>(shortest_period(
        orbit.states, orbit.modes, static_cast<std::size_t>(ratio_.denominator), extent));
    if (shortest < samples) return measured(first, shortest, extent);
    bool alike = !motion_.motion().counts().accumulates;
    const State closure = motion_.motion().state() - orbit.states.front();
    for (int more = 0; more < 2; ++more)
      alike = switch_alike(next_period(samples, measures), orbit, 1e-6 * orbit.sampling_period) &&
              alike;
    orbit.closure_error = closure.norm();
    orbit.extent = Extent(readings_, orbit.states).sides();
    for (const State& state : orbit.states)
      orbit.largest_sample =
          std::max(orbit.largest_sample, std::abs(readings_.displacement(state)));
    const SwitchingMargins& margins = orbit.margins = measures.margins();
    orbit.time_share = measures.time_share();
    orbit.largest_displacement = measures.largest_displacement();
    const bool touches = touches_surface(
        orbit.extent, orbit.extent.share_of(readings_.both_sides(closure)), margins.border_distance,
        std::min(margins.exit_velocity, margins.reversal_velocity));
    return {{outcome_of(touches, alike), std::move(orbit)}, first};
  }

  RepeatingMotion<Contact> motion_;
  PortReadings<typename Motion::Plant> readings_;
  Rational ratio_;
};

/// The Model of ReturnSearch for an EventMotion. If the state repeats, it solves for a fixed point
/// of the return map. The motion has settled if its distance from the orbit is below 10⁻⁶ of its
/// extent and then, over two periods with the orbit's contact modes, does not grow.
template <class Contact>
class EventSearchModel {
 public:
  using Motion = EventMotion<Contact>;
  using Plant = typename Motion::Plant;
  using State = typename Motion::State;
  using Memory = StroboscopicState<Contact>;
  using Symbol = ContactMode;
  using Result = EventOrbitResult<Contact>;
  using Seen = SeenMotion<Symbol, Plant>;

  /// Cost of solving for an orbit, in simulated samples per orbit sample (measured 16 … 60).
  static std::int64_t samples_per_solved() { return 32; }

  EventSearchModel(const Motion& start, const Rational& ratio)
      : motion_(start, ratio.denominator), solver_(motion_, ratio) {}

  const PortReadings<Plant>& readings() const { return motion_.motion().readings(); }
  const State& state() const { return motion_.motion().state(); }
  Memory memory() const { return motion_.point(); }
  bool is_followed() const { return !motion_.motion().counts().accumulates; }

  Symbol take_sample() {
    const ContactMode mode = motion_.sense().mode;
    motion_.advance();
    return mode;
  }

  bool has_contact_of(const Memory& other) const {
    return motion_.motion().contact().mode() == other.contact.mode();
  }

  /// Whether to solve for a new orbit; false while the motion settles on the proposed orbit.
  bool may_repeat(const Seen&, std::int64_t) const { return periods_on_orbit_ == 0; }

  Result solve(const Seen&, std::int64_t period, const Memory&) {
    return solver_.solve(motion_.point(), period);
  }

  bool is_same(const Result& known, const Result& other, const Seen& seen) const {
    if (known.orbit->modes != other.orbit->modes) return false;
    StateScaleOf<Plant> extent(readings(), known.orbit->states);
    extent.widen(1e-3, seen.extent);
    return extent.share_of(first_state(other) - first_state(known)) <= 1e-9;
  }

  void approach(const Result& found, const Seen& seen) {
    approached_ = seen.taken();
    distance_ = seen.extent.share_of(state() - first_state(found));
    periods_on_orbit_ = 0;
  }

  /// Whether the motion has stayed on the orbit for two periods; tested at the end of each period.
  bool has_come(const Result& found, const Seen& seen) {
    const std::vector<ContactMode>& modes = found.orbit->modes;
    const auto period = static_cast<std::int64_t>(modes.size());
    const std::int64_t passed = seen.taken() - approached_;
    if (passed == 0 || passed % period != 0) return false;
    const double before = distance_;
    distance_ = seen.extent.share_of(state() - first_state(found));
    const bool nearer = seen.came_nearer(first_state(found), before, distance_);
    const bool same_modes = std::equal(modes.begin(), modes.end(), seen.itinerary.end() - period);
    periods_on_orbit_ = nearer && same_modes ? periods_on_orbit_ + 1 : 0;
    return periods_on_orbit_ >= 2;
  }

 private:
  static const State& first_state(const Result& found) { return found.orbit->states.front(); }

  RepeatingMotion<Contact> motion_;
  EventOrbitSolver<Contact> solver_;
  std::int64_t approached_ = 0;  // samples before the orbit was proposed
  double distance_ = 0.0;        // of the motion from it, as a share of the motion's extent
  int periods_on_orbit_ = 0;
};

}  // namespace detail

/// Finds the periodic orbit on which a motion settles, with a numerical certificate (EventOrbitOf).
///
///     const auto motion = event_motion(loop, state);
///     const auto found = find_event_orbit(motion);
///     if (found.outcome == OrbitOutcome::certified) use(found.orbit->period());
///
/// `certified` also means that the motion came close to the orbit and did not move away over two
/// further periods. Close: the relative distance (StateScaleOf) is below 10⁻⁶. For `neutral`,
/// `neutral_state` is the index of a state variable without restoring term. `none_found` occurs
/// also if a sampling period has more than EventMotion::most_switches contact changes, and
/// `incommensurate` also for a recorded force and for sampling jitter.
///
/// Work: at most `limits.most_samples` simulated samples, and about as much for computing orbits.
/// Memory: one byte per sample of the motion, about 150 bytes per sample of the orbit.
/// @param start   the motion, before a sample; the search simulates a copy of it
/// @param limits  limits of the search: longest period and number of samples
/// @throws InvalidParameter where a limit is out of its range
template <class Contact>
EventOrbitResult<Contact> find_event_orbit(const EventMotion<Contact>& start,
                                           const OrbitLimits& limits = {}) {
  validate(limits);
  const std::optional<Rational> ratio = forcing_ratio(start.loop());
  if (!ratio) return {{OrbitOutcome::incommensurate, {}}, {}};
  if (ratio->denominator > limits.largest_period) return {};
  EventMotion<Contact> motion = start;
  for (; motion.index() % ratio->denominator != 0; motion.advance()) motion.sense();
  return detail::ReturnSearch(detail::EventSearchModel<Contact>(motion, *ratio), *ratio, limits)
      .run();
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template EventOrbitResult<DriveContact<>> find_event_orbit(
    const EventMotion<DriveContact<>>&, const OrbitLimits&);
extern template EventOrbitResult<DriveContact<ControlledPlant>> find_event_orbit(
    const EventMotion<DriveContact<ControlledPlant>>&, const OrbitLimits&);
#endif

}  // namespace holdfast
