#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "holdfast/contact/contact.hpp"
#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/control/controller.hpp"
#include "holdfast/control/digital_loop.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/control/sampling_clock.hpp"
#include "holdfast/excitation/force_over_samples.hpp"
#include "holdfast/math/roots/first_root.hpp"
#include "holdfast/math/roots/series.hpp"
#include "holdfast/motion/event_sample.hpp"
#include "holdfast/motion/mode_motion.hpp"
#include "holdfast/motion/next_event.hpp"
#include "holdfast/motion/taylor_step.hpp"
#include "holdfast/plant/affine_dynamics.hpp"
#include "holdfast/plant/port_readings.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

namespace detail {

/// The plant that a contact says it drives; the two masses where it says nothing.
template <class Contact, class = void>
struct DrivenPlant {
  using type = TwoMass<double>;
  static PortReadings<type> readings(const Contact&) { return {}; }
};
template <class Contact>
struct DrivenPlant<Contact, std::void_t<typename Contact::Plant>> {
  using type = typename Contact::Plant;
  static const PortReadings<type>& readings(const Contact& contact) { return contact.readings(); }
};

}  // namespace detail

/// The motion of the sampled loop whose contact may change between the samples.
///
/// The digital side is that of SampledMotion: `sense()` takes a sample and decides the command u_j,
/// `advance()` moves to the next one, under u_{j−1} until t_j + δ and under u_j from then on. In
/// between the state follows the mode of the contact: over a whole part of the period by the same
/// exact matrices if a bound tells that no guard can come to zero in it, else by its Taylor series,
/// of which the first root of every guard is found (math/roots/first_root.hpp), so that no change
/// of contact is passed over.
///
/// Work per sample without a change of contact: about 80 multiply-adds and a square root; per
/// change some 2000 multiply-adds more. Nothing is allocated.
/// @tparam Contact  DriveContact, whose law is chosen at run time; one of its laws; or any other
///                  automaton with the members of a law. It tells the plant, the two masses or a
///                  LinearPlant
template <class Contact = DriveContact<>>
class EventMotion {
 public:
  /// What the contact drives.
  using Plant = typename detail::DrivenPlant<Contact>::type;
  /// N, the order of the plant.
  static constexpr int states = states_of<Plant>;
  using State = StateOf<Plant>;               ///< x, N × 1
  using Sample = EventSampleOf<states>;       ///< what `sense` takes
  using Instant = ContactInstantOf<states>;   ///< what a change of contact depends on
  using Dynamics = AffineDynamicsOf<states>;  ///< the motion in one mode
  using Expansion = TaylorStepOf<states>;     ///< its Taylor series

  /// Most changes of contact in one sampling period; beyond them SwitchCounts::accumulates is set.
  static constexpr int most_switches = 1000;
  /// Most ‖A‖ τ and ω τ: one Taylor series is made for each unit of them, where the contact may
  /// change.
  static constexpr double most_turns_per_sample = ModeMotion<Plant>::most_turns_per_sample;

  /// @throws InvalidParameter where the loop is not admissible, or turns more than
  ///         `most_turns_per_sample` in one sampling period
  EventMotion(const DigitalLoop& loop, const Contact& contact, const State& initial_state)
      : loop_(loop),
        readings_(detail::DrivenPlant<Contact>::readings(contact)),
        controller_(loop.gains, loop.limits),
        clock_(loop.sampling.period, loop.jitter),
        force_(loop.force, loop.hold, loop.sampling.period),
        contact_(contact),
        state_(initial_state) {
    validate(loop);
    for (int mode = 0; mode < Contact::modes; ++mode)
      modes_.emplace_back(
          with_law(contact_, [mode](const auto& law) { return law.dynamics(mode); }), loop, force_);
    for (const double after : {0.0, loop.sampling.processing_delay, loop.sampling.period})
      instants_.push_back(force_.instant(after));
  }

  /// Takes sample j: the command, and the contact where it depends on it. Call once per sample.
  Sample sense() {
    return with_law(contact_, [this](auto& law) { return this->sense_by(law); });
  }

  /// Moves from t_j to t_{j+1} under the command that the last `sense()` decided.
  void advance() { advance(IgnoreFlow()); }

  /// The same past an observer, for what depends on the way (motion/variational_flow.hpp):
  ///
  ///     flowed(mode, begin, length)             a part of the period, s from the sample, in a mode
  ///     commanded()                             at t_j + δ: u_j takes the place of u_{j−1}
  ///     switched(from, to, guard, instant)      at the end of the last part, the state before
  template <class Observer>
  void advance(Observer&& observer) {
    with_law(contact_, [&](auto& law) { advance_by(law, observer); });
    previous_command_ = command_;
    ++index_;
  }

  /// Adds a displacement (m) to the conductor at the present instant; call before `sense()`.
  void displace_conductor(double displacement) {
    readings_.displace_conductor(state_, displacement);
    with_law(contact_, [](auto& law) { law.displaced(); });
  }

  /// j, the sample that `sense()` will take or has taken.
  std::int64_t index() const { return index_; }
  /// t_j (s).
  double time() const { return clock_.time(index_); }
  /// x_j, N × 1; of the two masses z_j = [z₁, ż₁, z₂, ż₂] at t_j (m, m/s, m, m/s).
  const State& state() const { return state_; }
  /// u_{j−1} (N), which is in force until t_j + δ.
  double previous_command() const { return previous_command_; }
  /// u_j (N), once `sense()` has taken sample j.
  double command() const { return command_; }
  /// The contact in its present mode.
  const Contact& contact() const { return contact_; }
  /// How states of the plant are read.
  const PortReadings<Plant>& readings() const { return readings_; }
  /// The controller with what it remembers of the past samples.
  const Controller& controller() const { return controller_; }
  /// The digital side and the excitation, as given.
  const DigitalLoop& loop() const { return loop_; }
  /// What the motion has met with since it began or since `restart_counts()`.
  const SwitchCounts& counts() const { return counts_; }
  /// The excitation, at the present sample from `sense()` on.
  const ForceOverSamples& force() const { return force_; }
  /// h_j = t_{j+1} − t_j (s).
  double period() const { return clock_.period_of(index_); }
  /// 1 / the largest length (s) over which a series of `most_terms` terms is exact, in a mode.
  double rate(int mode) const { return modes_[at(mode)].rate(); }
  /// The motion in one of the modes of the contact.
  const Dynamics& dynamics(int mode) const { return modes_[at(mode)].dynamics(); }

  /// Forgets what the motion has met with.
  void restart_counts() { counts_ = {}; }

  /// Goes on as if the computer had read a displacement (m) at the sample before.
  void remember_reading(double displacement) { controller_.restore({displacement, true}); }

  /// Goes on at sample `index` from a state, a command in force until t_j + δ, and a contact. What
  /// the controller last read stays.
  void restore(std::int64_t index, const State& state, double previous_command,
               const Contact& contact) {
    index_ = index;
    state_ = state;
    previous_command_ = previous_command;
    contact_ = contact;
  }

 private:
  using ModeGuard = GuardOf<states>;
  using ModeGuards = GuardsOf<states>;

  static constexpr std::size_t at(int mode) { return static_cast<std::size_t>(mode); }

  /// F at one of the ends of the two parts of the period.
  double force_at(std::size_t end) const {
    const PeriodInstant& instant = instants_[end];
    return loop_.jitter.half_width > 0.0 ? force_.at(instant.after) : force_.at(instant);
  }

  /// The command in force at the sample itself.
  double first_command() const {
    return loop_.sampling.processing_delay > 0.0 ? previous_command_ : command_;
  }

  template <class Law>
  Sample sense_by(Law& law) {
    const double elapsed = index_ > 0 ? clock_.period_of(index_ - 1) : loop_.sampling.period;
    force_.begin_sample(index_, time());
    switches_ = 0;
    law.sample(state_);
    command_ = law.commanded(controller_.command(readings_.measured_displacement(state_),
                                                 readings_.measured_velocity(state_), elapsed));
    const double force = force_at(0);
    jump(law, {state_, first_command(), force}, IgnoreFlow());
    Sample sample;
    sample.index = index_;
    sample.time = time();
    sample.state = state_;
    sample.mode = law.word();
    sample.engaged = sample.mode == ContactMode::engaged;
    sample.control_force = law.transmitted({state_, command_, force});
    return sample;
  }

  template <class Law, class Observer>
  void advance_by(Law& law, Observer& observer) {
    const double period = clock_.period_of(index_), delay = loop_.sampling.processing_delay;
    if (delay > 0.0) flow(law, {previous_command_, 0.0, std::min(delay, period), 0}, observer);
    observer.commanded();
    if (!(delay < period)) return;
    if (delay > 0.0) jump(law, {state_, command_, force_at(1)}, observer);
    flow(law, {command_, delay, period, 1}, observer);
  }

  template <class Law, class Observer>
  void jump(Law& law, const Instant& now, Observer&& observer) {
    const int before = law.mode();
    law.jumped(now);
    if (law.mode() == before) return;
    count(law.word());
    observer.switched(before, law.mode(), -1, now);
  }

  void count(ContactMode entered) {
    ++counts_.entered[static_cast<std::size_t>(entered)];
    if (++switches_ > most_switches) counts_.accumulates = true;
  }

  /// A part of the sampling period under one command.
  struct Part {
    double command;      // N
    double begin, end;   // s after the sample
    std::size_t number;  // 0 before t_j + δ, 1 after it
  };

  template <class Law, class Observer>
  void flow(Law& law, const Part& part, Observer& observer) {
    if (flow_without_event(law, part.command, part.end - part.begin, part.number)) {
      observer.flowed(law.mode(), part.begin, part.end - part.begin);
      return;
    }
    double reached = part.begin;
    while (reached < part.end) reached = flow_to_event(law, part, reached, observer);
  }

  /// A whole part of the period at once, if it is sure that the contact does not change in it.
  template <class Law>
  bool flow_without_event(Law& law, double command, double length, std::size_t part) {
    if (!force_.is_regular() || loop_.jitter.half_width > 0.0) return false;
    const ModeGuards guards = law.guards();
    for (int g = 0; g < guards.count; ++g)
      if (!may_have_no_event(guards.guard[at(g)])) return false;
    const int mode = law.mode();
    ModeMotion<Plant>& here = modes_[at(mode)];
    State after = here.step(part).state(state_, command, force_.held(), force_.phases());
    law.keep(state_, after);
    if (guards.count > 0) {
      const double drop_below_chord =
          here.bound(law, mode, guards.guard[0], force_).drop_below_chord(state_, command, length);
      for (int g = 0; g < guards.count; ++g)
        if (!(least_at_ends(guards.guard[at(g)], after, command, part) > drop_below_chord))
          return false;
    }
    state_ = after;
    law.flowed();
    return true;
  }

  static bool may_have_no_event(const ModeGuard& guard) {
    return guard.zeros == 0 && !guard.unsigned_yet;
  }

  /// The lesser of a guard's values at the ends of a part of the period.
  double least_at_ends(const ModeGuard& guard, const State& after, double command,
                       std::size_t part) const {
    double begin = guard.state.dot(state_), end = guard.state.dot(after);
    if (guard.force != 0.0) {
      begin += guard.force * force_at(part);
      end += guard.force * force_at(part + 1);
    }
    return std::min(begin, end) + guard.command * command + guard.constant;
  }

  /// Goes on to the next change of contact, or to the end of the part. @return where it came to
  template <class Law, class Observer>
  double flow_to_event(Law& law, const Part& part, double begin, Observer& observer) {
    const int mode = law.mode();
    const ModeMotion<Plant>& here = modes_[at(mode)];
    const double wanted = std::min(part.end, force_.next_break(begin)) - begin;
    const double length = std::min(wanted, 1.0 / here.rate());
    ModeStretch<states> stretch{state_, part.command, Series(terms_for(here.rate() * length)),
                                length};
    force_.expand(begin, length, stretch.force);
    const NextEvent<states> event = next_event(
        here.dynamics(), switches_ > most_switches ? ModeGuards{} : law.guards(), stretch);
    if (event.sign != 0.0) law.learn_sign(event.sign);
    const bool whole = event.guard < 0;
    const double passed = whole ? length : event.root.at * length;
    const double reached = begin + passed;
    observer.flowed(mode, begin, passed);
    state_ = event.state;
    if (passed > 0.0) law.flowed();
    if (!whole) {
      const double force = value_and_slope(stretch.force, event.root.at).value;
      change(law, event.guard, {state_, part.command, force}, observer);
      if (event.root.outcome == RootOutcome::grazing) ++counts_.grazing;
      return reached;
    }
    if (length == part.end - begin) return part.end;
    if (length == wanted) jump(law, {state_, part.command, force_.at(reached)}, observer);
    return reached;
  }

  template <class Law, class Observer>
  void change(Law& law, int guard, const Instant& before, Observer& observer) {
    const int left = law.mode();
    Instant now = before;
    law.reached(guard, now);
    observer.switched(left, law.mode(), guard, before);
    state_ = now.state;
    count(law.word());
  }

  DigitalLoop loop_;
  PortReadings<Plant> readings_;
  Controller controller_;
  SamplingClock clock_;
  ForceOverSamples force_;
  Contact contact_;
  State state_;
  std::vector<ModeMotion<Plant>> modes_;
  std::vector<PeriodInstant> instants_;  // at which they begin and end
  double previous_command_ = 0.0, command_ = 0.0;
  std::int64_t index_ = 0;
  int switches_ = 0;
  SwitchCounts counts_;
};

}  // namespace holdfast
