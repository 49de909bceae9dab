#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "holdfast/contact/contact.hpp"
#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/control/controlled_plant.hpp"
#include "holdfast/control/controller.hpp"
#include "holdfast/control/digital_loop.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/control/sampling_clock.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/excitation/force_over_samples.hpp"
#include "holdfast/math/roots/first_root.hpp"
#include "holdfast/math/roots/series.hpp"
#include "holdfast/motion/mode_motion.hpp"
#include "holdfast/motion/next_event.hpp"
#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/motion/taylor_step.hpp"
#include "holdfast/plant/affine_dynamics.hpp"
#include "holdfast/plant/port_readings.hpp"
#include "holdfast/plant/ports.hpp"

namespace holdfast {

/// A sample of an EventMotion: state, contact mode and force transmitted under u_j, all at t_j.
/// @tparam States  N, the order of the plant
template <int States>
struct EventSampleOf : MotionSample<double, States> {
  ContactMode mode;  ///< contact mode just after t_j; MotionSample::engaged is (mode == engaged)
};

/// A sample of the motion of two masses.
using EventSample = EventSampleOf<4>;

/// The counts of contact changes in a motion.
struct SwitchCounts {
  std::array<std::int64_t, 3> entered{};  ///< number of changes into each mode, by ContactMode
  std::int64_t grazing = 0;  ///< number of changes at which a GuardOf touches zero tangentially
  bool accumulates = false;  ///< whether a sampling period had more changes than most_switches of
                             ///< EventMotion; later changes were ignored: the motion is invalid
};

/// An observer for EventMotion::advance that does nothing.
struct IgnoreFlow {
  /// Called after each time interval in one contact mode, with the number of the mode, the
  /// beginning (s after the sample) and the length (s).
  void flowed(int, double, double) const {}
  /// Called at t_j + δ, after the processing delay δ: the command u_j replaces u_{j−1}.
  void commanded() const {}
  /// Called at a change of contact, with the mode before, the mode after, the number of the guard
  /// that reached zero (−1: a jump of command or force) and the ContactInstantOf before the change.
  template <class Instant>
  void switched(int, int, int, const Instant&) const {}
};

/// The motion of a sampled loop whose contact may change between the samples.
///
/// `sense()` takes sample j and computes the command u_j. `advance()` moves to the next sample in
/// two parts: under u_{j−1} until t_j + δ (processing delay δ), then under u_j. The contact changes
/// when a guard (GuardOf) reaches zero. If a bound proves that no guard reaches zero in a part, one
/// step with the exact transition matrix covers this part. Otherwise the state is expanded in
/// Taylor series, and the first root of every guard is found (first_root.hpp). None is missed.
///
/// Work per sample without a change of contact: about 80 multiply-adds and a square root; per
/// change some 2000 multiply-adds more. No memory is allocated.
/// @tparam Contact  DriveContact, or a type with the same interface
template <class Contact = DriveContact<>>
class EventMotion {
 public:
  /// The type of the plant with its drive.
  using Plant = typename Contact::Plant;
  /// The order N of the plant.
  static constexpr int states = states_of<Plant>;
  using State = StateOf<Plant>;               ///< state x, N × 1
  using Sample = EventSampleOf<states>;       ///< sample returned by `sense`
  using Instant = ContactInstantOf<states>;   ///< state, command and force at an instant
  using Dynamics = AffineDynamicsOf<states>;  ///< equations of motion in one mode
  using Expansion = TaylorStep<states>;       ///< Taylor series of the motion

  /// The largest number of contact changes that are computed in one sampling period.
  static constexpr int most_switches = 1000;

  /// Constructs the motion before its first sample. @throws InvalidParameter for an inadmissible
  /// loop or state, or too long a sampling period (see ModeMotion::most_turns_per_sample)
  EventMotion(const DigitalLoop& loop, const Contact& contact, const State& initial_state)
      : loop_(loop),
        readings_(contact.readings()),
        controller_(detail::controller_of(loop, contact)),
        clock_(loop.sampling.period, loop.jitter),
        force_(loop.force, loop.hold, loop.sampling.period),
        contact_(contact),
        state_(initial_state) {
    validate(loop);
    for (int mode = 0; mode < Contact::modes; ++mode)
      modes_.emplace_back(contact_.dynamics(mode), loop, force_);
    require_size("size of the initial state", state_.size(),
                 modes_.front().dynamics().state.rows());
    require_finite("initial state", state_.sum(), "");
    for (const double after : {0.0, loop.sampling.processing_delay, loop.sampling.period})
      instants_.push_back(force_.instant(after));
  }

  /// Takes sample j, computes the command u_j and updates the contact; called once per sample.
  Sample sense() {
    const double elapsed = index_ > 0 ? clock_.period_of(index_ - 1) : loop_.sampling.period;
    force_.begin_sample(index_, time());
    switches_ = 0;
    contact_.sample(state_);
    Sample sample;
    sample.index = index_;
    sample.time = time();
    sample.state = state_;
    command_ = contact_.commanded(read(
        {readings_.measured_displacement(state_), readings_.measured_velocity(state_), elapsed}));
    const double force = force_at(0);
    jump({state_, first_command(), force}, IgnoreFlow());
    sample.mode = contact_.word();
    sample.engaged = sample.mode == ContactMode::engaged;
    sample.control_force = contact_.transmitted({state_, command_, force});
    return sample;
  }

  /// Advances from t_j to t_{j+1}: under u_{j−1} until t_j + δ, then under u_j of `sense()`.
  void advance() { advance(IgnoreFlow()); }

  /// Advances to the next sample and calls these members of an observer, explained at IgnoreFlow:
  ///
  ///     flowed(mode, begin, length)             after a time interval in one contact mode
  ///     commanded()                             at t_j + δ, when u_j replaces u_{j−1}
  ///     switched(from, to, guard, instant)      at a change of contact
  template <class Observer>
  void advance(Observer&& observer) {
    const double period = clock_.period_of(index_), delay = loop_.sampling.processing_delay;
    if (delay > 0.0) flow({previous_command_, 0.0, std::min(delay, period), 0}, observer);
    observer.commanded();
    if (delay < period) {
      if (delay > 0.0) jump({state_, command_, force_at(1)}, observer);
      flow({command_, delay, period, 1}, observer);
    }
    previous_command_ = command_;
    ++index_;
  }

  /// Shifts the conductor suddenly by a displacement (m); to be called before `sense()`.
  void displace_conductor(double displacement) {
    readings_.displace_conductor(state_, displacement);
    contact_.displaced();
  }

  /// The number j of the sample that `sense()` will take or has taken.
  std::int64_t index() const { return index_; }
  /// The instant t_j (s) of sample j = index().
  double time() const { return clock_.time(index_); }
  /// The state x_j, N × 1; for two masses z_j = [z₁, ż₁, z₂, ż₂] at t_j (m, m/s, m, m/s).
  const State& state() const { return state_; }
  /// The command u_{j−1} (N), in force until t_j + δ, the end of the processing delay.
  double previous_command() const { return previous_command_; }
  /// The command u_j (N), available after `sense()` took sample j.
  double command() const { return command_; }
  /// The contact of the drive, in its present mode.
  const Contact& contact() const { return contact_; }
  /// The functions that read displacements and velocities from the plant's state.
  const PortReadings<Plant>& readings() const { return readings_; }
  /// The controller, which stores the displacement measured at the last sample.
  const auto& controller() const { return controller_; }
  /// The digital loop with sampling, controller and excitation, as passed to the constructor.
  const DigitalLoop& loop() const { return loop_; }
  /// The counts of contact changes since the motion began or since `restart_counts()`.
  const SwitchCounts& counts() const { return counts_; }
  /// The excitation, which `sense()` sets to the present sample.
  const ForceOverSamples& force() const { return force_; }
  /// The length h_j = t_{j+1} − t_j (s) of the present sampling period.
  double period() const { return clock_.period_of(index_); }
  /// The rate (1/s) of a mode, given by its number: one Taylor series covers a time ≤ 1/rate.
  double rate(int mode) const { return modes_[at(mode)].rate(); }
  /// The equations of motion in a mode of the contact, given by its number.
  const Dynamics& dynamics(int mode) const { return modes_[at(mode)].dynamics(); }

  /// Resets the counts of contact changes to zero.
  void restart_counts() { counts_ = {}; }

  /// Sets the displacement (m) that the controller stores as measured at the previous sample.
  void remember_reading(double displacement) { controller_.restore({displacement, true}); }

  /// Sets the motion to sample j = `index`, with the state (N × 1), the command u_{j−1} (N) and the
  /// contact. The displacement stored in the controller is set by remember_reading().
  /// @throws InvalidParameter where the size of the state is not N
  void restore(std::int64_t index, const State& state, double previous_command,
               const Contact& contact) {
    require_size("size of the state", state.size(), state_.size());
    index_ = index;
    state_ = state;
    previous_command_ = previous_command;
    contact_ = contact;
  }

 private:
  using ModeGuard = GuardOf<states>;
  using ModeGuards = GuardsOf<states>;

  static constexpr std::size_t at(int mode) { return static_cast<std::size_t>(mode); }

  /// The command at a sample. If the plant contains a controller, its states advance too.
  double read(const ControlSample& sample) {
    if constexpr (detail::HasController<Plant>::value) {
      auto own = state_.tail(controller_.states());
      const OwnController::Column decided = controller_.command(sample, own);
      own = decided.tail(own.size());
      return decided[0];
    } else {
      return controller_.command(sample.displacement, sample.velocity, sample.elapsed);
    }
  }

  /// The excitation force F (N) at the sample (0), at t_j + δ (1) or at the next sample (2).
  double force_at(std::size_t end) const {
    const PeriodInstant& instant = instants_[end];
    return loop_.jitter.half_width > 0.0 ? force_.at(instant.after) : force_.at(instant);
  }

  double first_command() const {
    return loop_.sampling.processing_delay > 0.0 ? previous_command_ : command_;
  }

  template <class Observer>
  void jump(const Instant& now, Observer&& observer) {
    const int before = contact_.mode();
    contact_.jumped(now);
    if (contact_.mode() == before) return;
    count(contact_.word());
    observer.switched(before, contact_.mode(), -1, now);
  }

  void count(ContactMode entered) {
    ++counts_.entered[static_cast<std::size_t>(entered)];
    if (++switches_ > most_switches) counts_.accumulates = true;
  }

  struct Part {
    double command;      // N
    double begin, end;   // s after the sample
    std::size_t number;  // 0 before t_j + δ, 1 after it
  };

  template <class Observer>
  void flow(const Part& part, Observer& observer) {
    if (flow_without_event(part.command, part.end - part.begin, part.number)) {
      observer.flowed(contact_.mode(), part.begin, part.end - part.begin);
      return;
    }
    double reached = part.begin;
    while (reached < part.end) reached = flow_to_event(part, reached, observer);
  }

  /// Advances over a whole part of the period if a bound proves that the contact does not change.
  /// @return whether the motion was advanced
  bool flow_without_event(double command, double length, std::size_t part) {
    if (!force_.is_regular() || loop_.jitter.half_width > 0.0) return false;
    const int mode = contact_.mode();
    ModeMotion<Plant>& here = modes_[at(mode)];
    State after = here.step(part).state(state_, command, force_.held(), force_.phases());
    contact_.keep(state_, after);
    if (contact_.changes_between_samples()) {
      const ModeGuards guards = contact_.guards();
      for (int g = 0; g < guards.count; ++g)
        if (!may_have_no_event(guards.guard[at(g)])) return false;
      const double drop_below_chord = here.bound(contact_, mode, guards.guard[0], force_)
                                          .drop_below_chord(state_, command, length);
      for (int g = 0; g < guards.count; ++g) {
        const ModeGuard& guard = guards.guard[at(g)];
        double begin = guard.state.dot(state_), end = guard.state.dot(after);
        if (guard.force != 0.0) {
          begin += guard.force * force_at(part);
          end += guard.force * force_at(part + 1);
        }
        const double least = std::min(begin, end) + guard.command * command + guard.constant;
        if (!(least > drop_below_chord)) return false;
      }
    }
    state_ = after;
    contact_.flowed();
    return true;
  }

  static bool may_have_no_event(const ModeGuard& guard) {
    return guard.zeros == 0 && !guard.unsigned_yet;
  }

  /// Advances to the next change of contact, by at most 1/rate, and at most to the next break of
  /// the force or the end of the part. @return the instant reached (s after the sample)
  template <class Observer>
  double flow_to_event(const Part& part, double begin, Observer& observer) {
    const int mode = contact_.mode();
    const ModeMotion<Plant>& here = modes_[at(mode)];
    const double wanted = std::min(part.end, force_.next_break(begin)) - begin;
    const double length = std::min(wanted, 1.0 / here.rate());
    ModeStretch<states> stretch{state_, part.command, Series(terms_for(here.rate() * length)),
                                length};
    force_.expand(begin, length, stretch.force);
    const NextEvent<states> event = next_event(
        here.dynamics(), switches_ > most_switches ? ModeGuards{} : contact_.guards(), stretch);
    for (int g = 0; g < 2; ++g)
      if (event.signs[at(g)] != 0.0) contact_.learn_sign(g, event.signs[at(g)]);
    const bool whole = event.guard < 0;
    const double passed = whole ? length : event.root.at * length;
    const double reached = begin + passed;
    observer.flowed(mode, begin, passed);
    state_ = event.state;
    if (passed > 0.0) contact_.flowed();
    if (!whole) {
      const double force = value_and_slope(stretch.force, event.root.at).value;
      change(event.guard, {state_, part.command, force}, observer);
      if (event.root.outcome == RootOutcome::grazing) ++counts_.grazing;
      return reached;
    }
    if (length == part.end - begin) return part.end;
    if (length == wanted) jump({state_, part.command, force_.at(reached)}, observer);
    return reached;
  }

  template <class Observer>
  void change(int guard, const Instant& before, Observer& observer) {
    const int left = contact_.mode();
    Instant now = before;
    contact_.reached(guard, now);
    observer.switched(left, contact_.mode(), guard, before);
    state_ = now.state;
    count(contact_.word());
  }

  DigitalLoop loop_;
  PortReadings<Plant> readings_;
  detail::ControllerOf<Plant> controller_;
  SamplingClock clock_;
  ForceOverSamples force_;
  Contact contact_;
  State state_;
  std::vector<ModeMotion<Plant>> modes_;
  std::vector<PeriodInstant> instants_;  // t_j, t_j + δ and t_j + τ
  double previous_command_ = 0.0, command_ = 0.0;
  std::int64_t index_ = 0;
  int switches_ = 0;
  SwitchCounts counts_;
};

}  // namespace holdfast
