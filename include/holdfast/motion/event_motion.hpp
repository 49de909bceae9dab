#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "holdfast/contact/contact.hpp"
#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/control/controller.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/control/sampling_clock.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/excitation/force_over_samples.hpp"
#include "holdfast/excitation/multi_harmonic_force.hpp"
#include "holdfast/math/roots/first_root.hpp"
#include "holdfast/math/roots/series.hpp"
#include "holdfast/motion/no_event_bound.hpp"
#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/motion/subinterval_step.hpp"
#include "holdfast/motion/taylor_step.hpp"
#include "holdfast/plant/decaying_norm.hpp"
#include "holdfast/plant/energy.hpp"
#include "holdfast/plant/port_readings.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// The digital side of a loop and its excitation: all that a motion depends on beside its contact
/// and its initial state.
struct DigitalLoop {
  Sampling<double> sampling;            ///< τ and δ
  PdGains<double> gains;                ///< P and D
  MultiHarmonicForce force;             ///< F(t), the excitation of the conductor
  ForceHold hold = ForceHold::sampled;  ///< how F is taken over a sample, a record included
  ControllerLimits limits = {};         ///< of the sensors and the drive
  Jitter jitter = {};                   ///< of the clock; 2 J + δ ≤ τ
};

/// @throws InvalidParameter where any part is not admissible
inline void validate(const DigitalLoop& loop) {
  validate(loop.sampling, loop.jitter);
  validate(loop.gains);
  validate(loop.force);
  validate(loop.limits);
}

/// What is known of a motion at one sample, with the mode of its contact from then on.
/// @tparam States  N, the order of the plant
template <int States>
struct EventSampleOf : MotionSample<double, States> {
  ContactMode mode;  ///< from t_j on; `engaged` of the sample is mode == ContactMode::engaged
};

/// That of the two masses.
using EventSample = EventSampleOf<4>;

/// What a motion has met with.
struct SwitchCounts {
  std::array<std::int64_t, 3> entered{};  ///< how often each ContactMode began
  std::int64_t grazing = 0;  ///< changes of contact that rounding decides: a guard touches zero
  bool accumulates = false;  ///< more than `most_switches` changes in one sampling period: those
                             ///< after them, up to its end, were not followed, and from there on
                             ///< the motion is not to be trusted
};

/// Does not look at what happens between the samples.
struct IgnoreFlow {
  /// A part of the sampling period was passed: the mode's number, its begin (s after the sample)
  /// and its length (s).
  void flowed(int, double, double) const {}
  /// At t_j + δ u_j took the place of u_{j−1}.
  void commanded() const {}
  /// The contact changed: the numbers of the mode before and after, that of the guard that came to
  /// zero (−1: a jump of the command or the force did it), the instant.
  template <class Instant>
  void switched(int, int, int, const Instant&) const {}
};

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
  static constexpr double most_turns_per_sample = 1e6;

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
    for (int mode = 0; mode < Contact::modes; ++mode) prepare(mode);
    for (const double after : {0.0, loop.sampling.processing_delay, loop.sampling.period})
      instants_.push_back(force_.instant(after));
  }

  /// Takes sample j: the command, and the contact where it depends on it. Call once per sample.
  Sample sense() {
    const double elapsed = index_ > 0 ? clock_.period_of(index_ - 1) : loop_.sampling.period;
    force_.begin_sample(index_, time());
    switches_ = 0;
    contact_.sample(state_);
    command_ = contact_.commanded(controller_.command(
        readings_.measured_displacement(state_), readings_.measured_velocity(state_), elapsed));
    const Instant now{state_, first_command(), force_at(0)};
    jump(now);
    Sample sample;
    sample.index = index_;
    sample.time = time();
    sample.state = state_;
    sample.mode = contact_.word();
    sample.engaged = sample.mode == ContactMode::engaged;
    sample.control_force = contact_.transmitted({state_, command_, now.force});
    return sample;
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
    const double period = clock_.period_of(index_), delay = loop_.sampling.processing_delay;
    if (delay > 0.0) flow(previous_command_, 0.0, std::min(delay, period), 0, observer);
    observer.commanded();
    if (delay < period) {
      if (delay > 0.0) jump({state_, command_, force_at(1)}, &observer);
      flow(command_, delay, period, 1, observer);
    }
    previous_command_ = command_;
    ++index_;
  }

  /// Adds a displacement (m) to the conductor at the present instant; call before `sense()`.
  void displace_conductor(double displacement) {
    readings_.displace_conductor(state_, displacement);
    contact_.displaced();
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
  double rate(int mode) const { return rate_[at(mode)]; }
  /// The motion in one of the modes of the contact.
  const Dynamics& dynamics(int mode) const { return dynamics_[at(mode)]; }

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
  /// The norm that bounds the motion: energy, or that of Lyapunov's equation.
  using Norm = std::conditional_t<detail::HasPorts<Plant>::value, DecayingNorm<states>, EnergyNorm>;
  using Bound = NoEventBoundOf<Norm, states>;
  using ModeGuard = GuardOf<states>;
  using ModeGuards = GuardsOf<states>;

  static constexpr std::size_t at(int mode) { return static_cast<std::size_t>(mode); }

  void prepare(int mode) {
    const Dynamics dynamics = contact_.dynamics(mode);
    dynamics_[at(mode)] = dynamics;
    const double fastest =
        std::max(balanced_norm(dynamics.state), force_.highest_angular_frequency());
    rate_[at(mode)] = fastest;
    const Sampling<double>& sampling = loop_.sampling;
    if (!(fastest * sampling.period <= most_turns_per_sample))
      throw InvalidParameter("fastest rate of the motion times the sampling period",
                             fastest * sampling.period, "", "at most 1e6");
    const double parts[] = {0.0, sampling.processing_delay, sampling.period};
    for (std::size_t part = 0; part < 2; ++part)
      steps_[part].emplace_back(dynamics, loop_.force.harmonics, parts[part],
                                parts[part + 1] - parts[part]);
  }

  /// F at one of the ends of the two parts of the period.
  double force_at(std::size_t end) const {
    const PeriodInstant& instant = instants_[end];
    return loop_.jitter.half_width > 0.0 ? force_.at(instant.after) : force_.at(instant);
  }

  /// The command in force at the sample itself.
  double first_command() const {
    return loop_.sampling.processing_delay > 0.0 ? previous_command_ : command_;
  }

  void jump(const Instant& now) { jump(now, static_cast<const IgnoreFlow*>(nullptr)); }

  template <class Observer>
  void jump(const Instant& now, Observer* observer) {
    const int before = contact_.mode();
    contact_.jumped(now);
    if (contact_.mode() == before) return;
    count();
    if (observer != nullptr) observer->switched(before, contact_.mode(), -1, now);
  }

  void count() {
    ++counts_.entered[static_cast<std::size_t>(contact_.word())];
    if (++switches_ > most_switches) counts_.accumulates = true;
  }

  template <class Observer>
  void flow(double command, double begin, double end, std::size_t part, Observer&& observer) {
    if (flow_quietly(command, end - begin, part)) {
      observer.flowed(contact_.mode(), begin, end - begin);
      return;
    }
    double reached = begin;
    while (reached < end) reached = flow_to_event(command, reached, end, observer);
  }

  /// A whole part of the period at once, if it is sure that the contact does not change in it.
  bool flow_quietly(double command, double length, std::size_t part) {
    if (!force_.is_regular() || loop_.jitter.half_width > 0.0) return false;
    const ModeGuards guards = contact_.guards();
    for (int g = 0; g < guards.count; ++g)
      if (!may_have_no_event(guards.guard[at(g)])) return false;
    const int mode = contact_.mode();
    State after = steps_[part][at(mode)].state(state_, command, force_.held(), force_.phases());
    contact_.keep(state_, after);
    if (guards.count > 0) {
      if (bounds_[at(mode)] == std::nullopt) make_bound(mode, guards.guard[0]);
      const double drop_below_chord = bounds_[at(mode)]->drop_below_chord(state_, command, length);
      for (int g = 0; g < guards.count; ++g)
        if (!(least_at_ends(guards.guard[at(g)], after, command, part) > drop_below_chord))
          return false;
    }
    state_ = after;
    contact_.flowed();
    return true;
  }

  void make_bound(int mode, const ModeGuard& guard) {
    const Dynamics& dynamics = dynamics_[at(mode)];
    if constexpr (detail::HasPorts<Plant>::value) {
      bounds_[at(mode)].emplace(dynamics, dynamics.state, guard, force_.bounds());
    } else {
      bounds_[at(mode)].emplace(dynamics, contact_.plant(mode), guard, force_.bounds());
    }
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

  /// Goes on to the next change of contact, or to `end`. @return where it came to
  template <class Observer>
  double flow_to_event(double command, double begin, double end, Observer&& observer) {
    const int mode = contact_.mode();
    const double wanted = std::min(end, force_.next_break(begin)) - begin;
    const double length = std::min(wanted, 1.0 / rate_[at(mode)]);
    Series force(terms_for(rate_[at(mode)] * length));
    force_.expand(begin, length, force);
    const Expansion motion(dynamics_[at(mode)], state_, command, force, length);
    const auto [guard, root] = earliest(motion, command, force);
    const bool whole = root.outcome == RootOutcome::none;
    const double passed = whole ? length : root.at * length;
    const double reached = whole && length == wanted ? begin + wanted : begin + passed;
    observer.flowed(mode, begin, passed);
    state_ = motion.state(whole ? 1.0 : root.at);
    if (passed > 0.0) contact_.flowed();
    if (whole) {
      if (length == end - begin) return end;
      if (length == wanted) jump({state_, command, force_.at(reached)}, &observer);
      return reached;
    }
    change(guard, command, force_value(force, root.at), observer);
    if (root.outcome == RootOutcome::grazing) ++counts_.grazing;
    return reached;
  }

  struct Earliest {
    int guard;
    FirstRoot root;
  };

  Earliest earliest(const Expansion& motion, double command, const Series& force) {
    Earliest first{-1, {RootOutcome::none, 1.0, 0}};
    if (switches_ > most_switches) return first;
    const ModeGuards guards = contact_.guards();
    for (int g = 0; g < guards.count; ++g) {
      const Series series = series_of(guards.guard[at(g)], motion, command, force);
      const FirstRoot root = first_root(series);
      if (root.outcome != RootOutcome::none && (first.guard < 0 || root.at < first.root.at))
        first = {g, root};
    }
    return first;
  }

  Series series_of(const ModeGuard& guard, const Expansion& motion, double command,
                   const Series& force) {
    Series series = (guard.state.transpose() * motion.coefficients()).transpose();
    if (guard.force != 0.0) series += guard.force * force;
    series[0] += guard.command * command + guard.constant;
    const Eigen::Index zeros = std::min<Eigen::Index>(guard.zeros, series.size());
    series.head(zeros).setZero();
    clear_rounding(guard, motion, command, force, series);
    return guard.unsigned_yet ? signed_series(series) : series;
  }

  /// The series with the sign that its guard takes first, which the contact learns. A force that
  /// begins at zero does so to rounding only: what is that small beside the rest decides nothing.
  Series signed_series(Series series) {
    const double rounding = 1e-12 * series.cwiseAbs().sum();
    Eigen::Index leading = 0;
    while (leading < series.size() && std::abs(series[leading]) <= rounding) ++leading;
    series.head(leading).setZero();
    if (leading == series.size()) return series;
    const double sign = series[leading] > 0.0 ? 1.0 : -1.0;
    contact_.learn_sign(sign);
    return sign * series;
  }

  /// Leading coefficients that are nothing but rounding are zero: just after a change of contact
  /// the guard may not have come out of its own rounding yet.
  static void clear_rounding(const ModeGuard& guard, const Expansion& motion, double command,
                             const Series& force, Series& series) {
    constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
    double known = std::abs(guard.command * command) + std::abs(guard.constant);
    for (Eigen::Index k = 0; k < series.size(); ++k, known = 0.0) {
      const double size = guard.state.cwiseAbs().dot(motion.coefficients().col(k).cwiseAbs()) +
                          std::abs(guard.force * force[k]) + known;
      if (std::abs(series[k]) > rounding * size) return;
      series[k] = 0.0;
    }
  }

  static double force_value(const Series& force, double x) {
    return value_and_slope(force, x).value;
  }

  template <class Observer>
  void change(int guard, double command, double force, Observer&& observer) {
    const int before = contact_.mode();
    Instant now{state_, command, force};
    contact_.reached(guard, now);
    observer.switched(before, contact_.mode(), guard, Instant{state_, command, force});
    state_ = now.state;
    count();
  }

  DigitalLoop loop_;
  PortReadings<Plant> readings_;
  Controller controller_;
  SamplingClock clock_;
  ForceOverSamples force_;
  Contact contact_;
  State state_;
  std::array<Dynamics, Contact::modes> dynamics_;
  std::array<double, Contact::modes> rate_{};
  std::array<std::vector<SubintervalStepOf<states>>, 2>
      steps_;                            // of the parts before and after t_j + δ
  std::vector<PeriodInstant> instants_;  // at which they begin and end
  std::array<std::optional<Bound>, Contact::modes> bounds_;
  double previous_command_ = 0.0, command_ = 0.0;
  std::int64_t index_ = 0;
  int switches_ = 0;
  SwitchCounts counts_;
};

}  // namespace holdfast
