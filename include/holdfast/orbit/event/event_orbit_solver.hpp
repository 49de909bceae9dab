#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/orbit/event/event_orbit.hpp"
#include "holdfast/orbit/event/event_orbit_measures.hpp"
#include "holdfast/orbit/event/repeating_motion.hpp"
#include "holdfast/orbit/event/return_map.hpp"
#include "holdfast/orbit/loop_orbit.hpp"

namespace holdfast::detail {

/// One period of a motion, sample by sample.
/// @tparam States  N, the order of the plant
template <int States>
struct OnePeriod {
  std::vector<Vector<double, States>> states;
  std::vector<ContactMode> modes_before, modes;  // of the contact before and after each sample
  std::vector<double> forces;
  std::vector<ContactSwitch> switches;

  /// Whether another turn has the same modes and the same switches at the same times (s).
  bool switches_like(const OnePeriod& other, double tolerance) const {
    return modes_before == other.modes_before && modes == other.modes &&
           std::equal(switches.begin(), switches.end(), other.switches.begin(),
                      other.switches.end(), [&](const auto& a, const auto& b) {
                        return a.mode == b.mode && std::abs(a.time - b.time) <= tolerance;
                      });
  }
};

/// Notes the switches of a motion, and lets its measures look on.
template <class Contact>
class PeriodRecorder {
 public:
  using Motion = EventMotion<Contact>;
  using Period = OnePeriod<Motion::states>;

  PeriodRecorder(const Motion& motion, EventOrbitMeasures<Contact>& measures, Period& one_period)
      : motion_(motion), measures_(measures), one_period_(one_period) {}

  void flowed(int mode, double begin, double length) {
    reached_ = begin + length;
    measures_.flowed(mode, begin, length);
  }
  void commanded() { measures_.commanded(); }
  void switched(int from, int to, int guard, const typename Motion::Instant& instant) {
    measures_.switched(from, to, guard, instant);
    one_period_.switches.push_back({sample_time() + reached_, motion_.contact().word()});
  }

  /// Takes a sample whose contact was in a mode before it.
  void take(ContactMode before, const typename Motion::Sample& sample) {
    one_period_.states.push_back(sample.state);
    one_period_.modes_before.push_back(before);
    one_period_.modes.push_back(sample.mode);
    one_period_.forces.push_back(sample.control_force);
    if (sample.mode != before) one_period_.switches.push_back({sample_time(), sample.mode});
    reached_ = 0.0;
    measures_.begin();
  }

 private:
  /// s after the first sample of the turn.
  double sample_time() const {
    return static_cast<double>(one_period_.states.size() - 1) * motion_.loop().sampling.period;
  }

  const Motion& motion_;
  EventOrbitMeasures<Contact>& measures_;
  Period& one_period_;
  double reached_ = 0.0;  // s after the sample
};

/// The next N samples of a motion.
template <class Contact>
OnePeriod<EventMotion<Contact>::states> one_period_of(RepeatingMotion<Contact>& motion,
                                                      std::int64_t samples,
                                                      EventOrbitMeasures<Contact>& measures) {
  OnePeriod<EventMotion<Contact>::states> one_period;
  PeriodRecorder<Contact> recorder(motion.motion(), measures, one_period);
  for (std::int64_t j = 0; j < samples; ++j) {
    const ContactMode before = motion.motion().contact().word();
    recorder.take(before, motion.sense());
    motion.advance(recorder);
  }
  return one_period;
}

/// Of the samples at which the contact is in a mode, that which is farthest from any switch in
/// time; −1 where there is none.
template <int States>
std::int64_t sample_far_from_switches(const OnePeriod<States>& one_period, ContactMode mode,
                                      double sampling_period) {
  const auto samples = static_cast<std::int64_t>(one_period.states.size());
  const double period = static_cast<double>(samples) * sampling_period;
  std::int64_t best = -1;
  double farthest = -1.0;
  std::size_t next = 0;
  for (std::int64_t j = 0; j < samples; ++j) {
    const auto k = static_cast<std::size_t>(j);
    const double time = static_cast<double>(j) * sampling_period;
    while (next < one_period.switches.size() && one_period.switches[next].time < time) ++next;
    if (one_period.modes_before[k] != mode || one_period.modes[k] != mode) continue;
    double distance = std::numeric_limits<double>::infinity();
    if (!one_period.switches.empty()) {
      const bool last = next == one_period.switches.size();
      const double after =
          last ? one_period.switches.front().time + period : one_period.switches[next].time;
      const double before =
          next == 0 ? one_period.switches.back().time - period : one_period.switches[next - 1].time;
      distance = std::min(after - time, time - before);
    }
    if (distance <= farthest) continue;
    farthest = distance;
    best = j;
  }
  return best;
}

/// Solves for the orbit of N samples near a point and measures it.
template <class Contact>
class EventOrbitSolver {
 public:
  using Motion = EventMotion<Contact>;
  using State = typename Motion::State;
  using Extent = StateScaleOf<typename Motion::Plant>;
  using Orbit = EventOrbitOf<Motion::states>;
  using Period = OnePeriod<Motion::states>;
  using Point = StroboscopicState<Contact>;

  struct Candidate : OrbitCandidateOf<Orbit> {
    std::optional<Point> point;  // at the orbit's first sample
  };

  EventOrbitSolver(const RepeatingMotion<Contact>& motion, const Rational& ratio)
      : motion_(motion),
        readings_(motion.motion().readings()),
        ratio_(ratio),
        sampling_period_(motion.motion().loop().sampling.period) {}

  /// @param near  at a stroboscopic instant
  Candidate solve(const Point& near, std::int64_t samples) {
    motion_.go_to(near);
    EventOrbitMeasures<Contact> unused(motion_.motion());
    const Period one_period = one_period_of(motion_, samples, unused);
    const Extent extent(readings_, one_period.states);
    const std::int64_t section = section_of(one_period);
    if (section < 0) return {{CandidateOutcome::singular, std::nullopt}, std::nullopt};
    const bool gap_opens = !one_period.switches.empty();
    const auto units = return_units(motion_.motion(), extent, one_period.forces);
    ReturnMap<Contact> map(motion_, samples, units, gap_opens);
    const auto solution = map.fixed_point(moved(near, section));
    if (!solution) return {{CandidateOutcome::singular, std::nullopt}, std::nullopt};
    const Point first = moved(*solution, samples - section);
    Candidate candidate = measured(first, samples, extent);
    Orbit& orbit = *candidate.orbit;
    if (orbit.period_samples() < samples) map = {motion_, orbit.period_samples(), units, gap_opens};
    orbit.multipliers = map.multipliers(*solution);
    return candidate;
  }

 private:
  /// Where a fixed point is sought: with the drive engaged if it ever is, since it has forgotten
  /// its gap then.
  std::int64_t section_of(const Period& one_period) const {
    const std::int64_t engaged =
        sample_far_from_switches(one_period, ContactMode::engaged, sampling_period_);
    return engaged >= 0 ? engaged
                        : sample_far_from_switches(one_period, ContactMode::gap, sampling_period_);
  }

  Point moved(const Point& from, std::int64_t samples) {
    motion_.go_to(from);
    for (std::int64_t j = 0; j < samples; ++j) {
      motion_.sense();
      motion_.advance();
    }
    return motion_.point();
  }

  /// Three periods from a point: they must switch alike.
  /// @param extent  of the states among which the orbit was sought; its own may be rounding
  Candidate measured(const Point& first, std::int64_t samples, const Extent& extent) {
    motion_.go_to(first);
    EventOrbitMeasures<Contact> measures(motion_.motion());
    Period one_period = one_period_of(motion_, samples, measures);
    const auto shortest = static_cast<std::int64_t>(shortest_period(
        one_period.states, one_period.modes, static_cast<std::size_t>(ratio_.denominator), extent));
    if (shortest < samples) return measured(first, shortest, extent);
    bool alike = !motion_.motion().counts().accumulates;
    const State end = motion_.motion().state();
    for (int more = 0; more < 2; ++more)
      alike = one_period_of(motion_, samples, measures)
                  .switches_like(one_period, 1e-6 * sampling_period_) &&
              alike;
    Orbit orbit = orbit_of(std::move(one_period), measures);
    const State closure = end - orbit.states.front();
    orbit.closure_error = closure.norm();
    const SwitchingMargins& margins = orbit.margins;
    const bool touches = touches_surface(
        orbit.extent, orbit.extent.share_of(readings_.both_sides(closure)), margins.border_distance,
        std::min(margins.exit_velocity, margins.reversal_velocity));
    const auto outcome = touches ? CandidateOutcome::on_surface
                         : alike ? CandidateOutcome::verified
                                 : CandidateOutcome::other_itinerary;
    return {{outcome, std::move(orbit)}, first};
  }

  Orbit orbit_of(Period one_period, const EventOrbitMeasures<Contact>& measures) const {
    Orbit orbit{};
    orbit.extent = Extent(readings_, one_period.states).sides();
    for (const State& state : one_period.states)
      orbit.largest_sample =
          std::max(orbit.largest_sample, std::abs(readings_.displacement(state)));
    orbit.ratio = ratio_;
    orbit.sampling_period = sampling_period_;
    orbit.states = std::move(one_period.states);
    orbit.modes = std::move(one_period.modes);
    orbit.forces = std::move(one_period.forces);
    orbit.switches = std::move(one_period.switches);
    orbit.margins = measures.margins();
    orbit.time_share = measures.time_share();
    orbit.largest_displacement = measures.largest_displacement();
    return orbit;
  }

  RepeatingMotion<Contact> motion_;
  PortReadings<typename Motion::Plant> readings_;
  Rational ratio_;
  double sampling_period_;
};

}  // namespace holdfast::detail
