#pragma once

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "holdfast/contact/contact.hpp"
#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/core/lanes.hpp"
#include "holdfast/core/select.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/batch/lane_events.hpp"
#include "holdfast/motion/batch/lane_excitation.hpp"
#include "holdfast/motion/batch/lane_modes.hpp"
#include "holdfast/motion/batch/lane_numbers.hpp"
#include "holdfast/motion/batch/two_mass_series.hpp"
#include "holdfast/motion/event_motion.hpp"

namespace holdfast {

/// A pack of motions of two masses, one in each SIMD lane, whose contacts may change between
/// samples. Each motion has its own loop; all motions are at the same sample.
///
/// Each lane uses the method of EventMotion. Lanes where a guard (GuardOf) may reach zero advance
/// together, each to its next contact change; the other lanes wait. DriveContact computes the new
/// mode, lane by lane. The results of a lane do not depend on the other lanes.
///
/// Work per sample without a change of contact: some 90 operations on packs. A change of contact in
/// a lane takes one or two Taylor series, some 1500 operations each. No memory is allocated.
/// @tparam Scalar  `double` or a pack
template <class Scalar>
class EventPack {
  using Lane = Lanes<Scalar>;
  using LaneMask = Mask<Scalar>;

 public:
  static constexpr std::size_t lanes = Lane::count;  ///< number of lanes, with one motion each

  /// The sample returned by `sense`. It contains no states; see state().
  struct Sample {
    Scalar control_force;  ///< transmitted force (N) of each lane
    LaneMask engaged;      ///< lanes in ContactMode::engaged
  };

  /// @param starts  one motion per lane; for an unused lane, repeat a motion and then call `sleep`
  explicit EventPack(const std::array<EventStart, lanes>& starts)
      : excitation_(
            [&](std::size_t lane) -> const DigitalLoop& { return starts[lane].loop->digital; }),
        modes_(starts, excitation_),
        phasors_(excitation_.lines()) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const DigitalLoop& digital = starts[lane].loop->digital;
      period_[lane] = digital.sampling.period;
      delay_[lane] = std::min(digital.sampling.processing_delay, digital.sampling.period);
      proportional_[lane] = digital.gains.proportional;
      differential_[lane] = digital.gains.differential;
      begin(lane, starts[lane].state);
    }
    excitation_.fix_instants({Scalar(0), delay_.all(), period_.all()});
    any_delay_ = any(delay_.all() > Scalar(0));
    any_late_ = any(delay_.all() < period_.all());
  }

  /// Takes sample j in all lanes and computes the commands u_j; to be called once per sample.
  Sample sense() {
    excitation_.begin_sample(index_);
    switches_.fill(0);
    command_ = proportional_.all() * state_[0].all() + differential_.all() * state_[1].all();
    const Scalar first = select(delay_.all() > Scalar(0), previous_command_.all(), command_);
    jump(0, first, awake(), IgnoreFlowOfLanes());
    Sample sample{select(modes_.engaged(), command_, Scalar(0)), modes_.engaged()};
    if (modes_.sticking().any()) sample.control_force = with_sticking(sample.control_force);
    return sample;
  }

  /// An observer for `advance` that does nothing.
  struct IgnoreFlowOfLanes {
    /// Called at a change of contact, with the lane, the mode before, the mode after, the number of
    /// the guard that reached zero (−1: jump of command or excitation) and the time (s) since t_j.
    void switched(std::size_t, int, int, int, double) const {}
  };

  /// Advances all lanes to t_{j+1}: under u_{j−1} until t_j + δ (processing delay), then under u_j.
  void advance() { advance(IgnoreFlowOfLanes()); }
  /// Advances by one sample and calls observer.switched(…), explained at IgnoreFlowOfLanes.
  template <class Observer>
  void advance(Observer&& observer) {
    const Scalar delay = delay_.all(), period = period_.all(), zero(0);
    if (any_delay_)
      flow({0, previous_command_.all(), zero, delay}, awake() & (delay > zero), observer);
    if (any_late_) {
      const LaneMask late = awake() & (delay < period);
      if (any_delay_) jump(1, command_, late & (delay > zero), observer);
      flow({1, command_, delay, period}, late, observer);
    }
    previous_command_.set(command_);
    ++index_;
  }

  /// The number j of the sample that `sense()` will take or has taken.
  std::int64_t index() const { return index_; }
  /// Changes the number of the present sample to j = `index`, a multiple ≥ 0 of
  /// RotatingPhasor::block. The excitation then has the phase of sample j.
  void restart_index(std::int64_t index) { index_ = index; }
  /// The states z_j = [z₁, ż₁, z₂, ż₂] (m, m/s, m, m/s) of all lanes.
  std::array<Scalar, 4> state() const {
    return {state_[0].all(), state_[1].all(), state_[2].all(), state_[3].all()};
  }
  /// The state z_j = [z₁, ż₁, z₂, ż₂] (m, m/s, m, m/s) of one lane.
  Vector<double, 4> state(std::size_t lane) const {
    return {state_[0][lane], state_[1][lane], state_[2][lane], state_[3][lane]};
  }
  /// The contact of the drive in a lane, in its present mode.
  const DriveContact<>& contact(std::size_t lane) const { return modes_.contact(lane); }
  /// Whether a lane had more than EventMotion::most_switches changes of contact in one period.
  bool accumulates(std::size_t lane) const { return accumulates_[lane]; }
  /// Whether accumulates() is true for at least one lane.
  bool some_accumulate() const { return accumulates_.any(); }
  /// Restarts a lane at the present sample, with the state z (m, m/s, m, m/s) and u_{j−1} = 0.
  void restart(std::size_t lane, const Vector<double, 4>& z) {
    modes_.restart(lane, z);
    begin(lane, z);
  }
  /// Ends the motion of a lane: its state is zero from now on, and other lanes do not wait for it.
  void sleep(std::size_t lane) {
    awake_[lane] = 0.0;
    for (auto& number : state_) number[lane] = 0.0;
    modes_.ignore_guards(lane);
  }

 private:
  using Numbers = LaneNumbers<Scalar>;

  struct Part {
    std::size_t number;
    Scalar command, begin, end;
  };

  LaneMask awake() const { return awake_.all() > Scalar(0.5); }

  void begin(std::size_t lane, const Vector<double, 4>& z) {
    for (std::size_t i = 0; i < 4; ++i) state_[i][lane] = z[static_cast<Eigen::Index>(i)];
    previous_command_[lane] = 0.0;
    accumulates_.reset(lane);
    awake_[lane] = 1.0;
  }

  ContactInstant instant(std::size_t lane, const Scalar& command, const Scalar& force) const {
    return {state(lane), detail::lane_of(command, lane), detail::lane_of(force, lane)};
  }

  /// Applies a jump of the command or force to the contacts that it may change: contacts in stick
  /// with a guard that is no longer positive, and contacts that are fresh (LaneModes::fresh()).
  /// @param instant_number  0: at the sample, 1: at the end of the processing delay
  template <class Observer>
  void jump(std::size_t instant_number, const Scalar& command, const LaneMask& which,
            Observer&& observer) {
    if (modes_.sticking().none() && modes_.freshly_changed().none()) return;
    const Scalar zero(0), force = excitation_.force_at(instant_number);
    const std::array<Scalar, 4> z = state();
    LaneMask stays = zero < Scalar(1);
    for (std::size_t g = 0; g < 2; ++g) {
      const LaneGuard<Scalar>& guard = modes_.guard(g);
      stays = stays & (guard.at(z, command) + guard.force.all() * force > zero);
    }
    const LaneMask fresh = modes_.fresh(), sticks = modes_.sticks();
    const LaneMask asked = which & (fresh | without<Scalar>(sticks, stays));
    if (!any(asked)) return;
    const auto lane_asked = detail::lane_flags<Scalar>(asked);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if (lane_asked[lane] == 0) continue;
      DriveContact<>& contact = modes_.contact(lane);
      const int before = contact.mode();
      contact.jumped(instant(lane, command, force));
      if (contact.mode() == before) {
        modes_.refresh_guards(lane);
        continue;
      }
      enter(lane);
      observer.switched(lane, before, contact.mode(), -1, instant_number == 0 ? 0.0 : delay_[lane]);
    }
  }

  Scalar with_sticking(const Scalar& transmitted) {
    const Scalar force = excitation_.force_at(0);
    Numbers numbers;
    numbers.set(transmitted);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      if (modes_.sticking()[lane])
        numbers[lane] = modes_.contact(lane).transmitted(instant(lane, command_, force));
    return numbers.all();
  }

  void enter(std::size_t lane) {
    modes_.enter(lane);
    if (++switches_[lane] <= EventMotion<>::most_switches) return;
    accumulates_.set(lane);
    modes_.ignore_guards(lane);
  }

  template <class Observer>
  void flow(const Part& part, const LaneMask& which, Observer& observer) {
    const LaneMask through = flow_without_event(part, which);
    if (all(through)) return;
    LaneMask pending = without<Scalar>(which, through);
    if (!any(pending)) return;
    Numbers reached;
    reached.set(part.begin);
    excitation_.turned_to(part.number, phasors_);
    for (;;) {
      flow_to_event(part, pending, reached, observer);
      pending = pending & (reached.all() < part.end);
      if (!any(pending)) return;
      excitation_.turned(reached.all(), phasors_);
    }
  }

  /// Advances over a whole part of the period the lanes of `which` whose contact provably does not
  /// change in this part (NoEventBoundOf). @return the lanes that were advanced
  LaneMask flow_without_event(const Part& part, const LaneMask& which) {
    const LaneStep<Scalar>& step = modes_.step(part.number);
    const std::array<Scalar, 4> before = state();
    std::array<Scalar, 4> after = step.state(before, part.command, excitation_);
    if (modes_.sticking().any()) {
      const LaneMask sticks = modes_.sticks();
      after[2] = select(sticks, Scalar(after[0] + (before[2] - before[0])), after[2]);
      after[3] = select(sticks, after[1], after[3]);
    }
    const LaneMask none_falls = no_guard_falls(part, step, before, after);
    const LaneMask unguarded = modes_.unguarded();
    const LaneMask through = which & (none_falls | unguarded);
    // The next step need not wait for the bound where all lanes are through.
    const bool whole = all(through);
    for (std::size_t i = 0; i < 4; ++i)
      state_[i].set(whole ? after[i] : select(through, after[i], before[i]));
    return through;
  }

  LaneMask no_guard_falls(const Part& part, const LaneStep<Scalar>& step,
                          const std::array<Scalar, 4>& before, const std::array<Scalar, 4>& after) {
    using std::abs;
    using std::min;
    Scalar force_before(0), force_after(0);
    if (modes_.sticking().any()) {
      force_before = excitation_.force_at(part.number);
      force_after = excitation_.force_at(part.number + 1);
    }
    const Scalar drop = step.drop_by_norm.all() * modes_.norm(before) +
                        step.drop_by_command.all() * abs(part.command) + step.drop_constant.all();
    Scalar least(std::numeric_limits<double>::infinity());
    std::array<Scalar, 2> begin, end;
    for (std::size_t g = 0; g < 2; ++g) {
      const LaneGuard<Scalar>& guard = modes_.guard(g);
      const Scalar by_force = guard.force.all();
      begin[g] = guard.at(before, part.command) + by_force * force_before;
      end[g] = guard.at(after, part.command) + by_force * force_after;
      least = min(least, min(begin[g], end[g]));
    }
    const LaneMask settled = modes_.settled();
    const LaneMask far = (least > drop) & settled;
    if (all(far)) return far;
    const LaneMask first_stays = stays_above_zero(begin[0], end[0], drop);
    const LaneMask second_stays = stays_above_zero(begin[1], end[1], drop);
    return far | (first_stays & second_stays & settled);
  }

  /// Advances the lanes of `pending` to the next change of contact, by at most 1/rate and at most
  /// to the end of the part. `phasors_` must be the phasors at the present instants of the lanes.
  template <class Observer>
  void flow_to_event(const Part& part, const LaneMask& pending, Numbers& reached,
                     Observer& observer) {
    using std::min;
    const Scalar zero(0), one(1), begin = reached.all();
    const Scalar wanted = part.end - begin;
    const Scalar length = select(pending, Scalar(min(wanted, Scalar(one / modes_.rate()))), zero);
    const std::array<Scalar, 4> z = state();
    const TwoMassSeries<Scalar> series(modes_.accelerations(part.command), z, phasors_, length,
                                       terms_(Scalar(modes_.rate() * length)));
    const LaneEvent<Scalar> event = next_event_(modes_, series, part.command, pending);
    const std::array<Scalar, 4> after = series.state_at(event.at);
    for (std::size_t i = 0; i < 4; ++i) state_[i].set(select(pending, after[i], z[i]));
    const Scalar came = select(event.found, Scalar(begin + event.at * length),
                               select(length == wanted, part.end, Scalar(begin + length)));
    reached.set(select(pending, came, begin));
    if (modes_.freshly_changed().any()) tell_flowed(pending & (event.at * length > zero));
    if (any(event.found))
      change(event, part.command, series.value(series.force, event.at), reached, observer);
  }

  void tell_flowed(const LaneMask& passed) {
    const auto lane_passed = detail::lane_flags<Scalar>(passed);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      if (lane_passed[lane] != 0 && modes_.freshly_changed()[lane]) modes_.flowed(lane);
  }

  template <class Observer>
  void change(const LaneEvent<Scalar>& event, const Scalar& command, const Scalar& force,
              const Numbers& reached, Observer& observer) {
    const auto found = detail::lane_flags<Scalar>(event.found),
               second = detail::lane_flags<Scalar>(event.second);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if (found[lane] == 0) continue;
      DriveContact<>& contact = modes_.contact(lane);
      const int before = contact.mode(), guard = second[lane];
      ContactInstant now = instant(lane, command, force);
      contact.reached(guard, now);
      for (std::size_t i = 0; i < 4; ++i) state_[i][lane] = now.state[static_cast<Eigen::Index>(i)];
      enter(lane);
      observer.switched(lane, before, contact.mode(), guard, reached[lane]);
    }
  }

  LaneExcitation<Scalar> excitation_;
  LaneModes<Scalar> modes_;
  LaneTerms<Scalar> terms_;
  LaneEventSearch<Scalar> next_event_;
  std::vector<LanePhasor<Scalar>> phasors_;
  Numbers period_, delay_, proportional_, differential_, awake_, previous_command_;
  bool any_delay_ = false, any_late_ = true;
  std::array<Numbers, 4> state_;
  Scalar command_ = Scalar(0);
  std::int64_t index_ = 0;
  std::array<int, lanes> switches_{};
  std::bitset<lanes> accumulates_;
};

}  // namespace holdfast
