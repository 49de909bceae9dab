#pragma once

#include <cvode/cvode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/sundials/cvode_session.hpp"

namespace holdfast::cvode {

/// A motion whose backlash switches between the samples, found by numerical integration.
struct SwitchingReference {
  IntegrationOutcome outcome;  ///< `completed`, or why the states end before
  std::string words;           ///< why it was not completed, in CVODE's own words where it gave up
  /// [z₁, ż₁, z₂, ż₂] (m, m/s, m, m/s) at t_j = j τ, j = 0, 1, …; all that are asked for where it
  /// was completed.
  std::vector<Vector<double, 4>> states;
  std::vector<ContactSwitch> switches;  ///< in order of time; before the first one it is engaged
};

namespace detail {

/// The motion of two masses and the drive between them in y = [z₁, ż₁, d, v], d = z₂ − z₁, v = ḋ,
/// by Newton's law of each mass, s being the force that the drive transmits:
///
///     m₁ z̈₁ = −k₁ z₁ − c₁ ż₁ + p + F,   m₂ z̈₂ = −p,   p = k₂ d + c₂ v + s,   v̇ = z̈₂ − z̈₁
///
/// Sticking, v = 0 and both masses move as one: (m₁ + m₂) z̈₁ = −k₁ z₁ − c₁ ż₁ + F.
/// With v itself a component of the state a reversal suffers no cancellation, and while the drive
/// sticks v is zero to the last bit.
class DriveDynamics {
 public:
  struct Accelerations {
    double conductor, relative;  // z̈₁, v̇ (m/s²)
  };

  explicit DriveDynamics(const IdealLoop<double>& loop) : loop_(loop) {}

  /// From the sample j at t_j = j τ on; whole cycles are removed, so that j may be large.
  void begin_period(std::int64_t sample) {
    const double cycles =
        static_cast<double>(sample) * (loop_.excitation.frequency * loop_.sampling.period);
    phase_ = 2.0 * pi<double> * (cycles - std::floor(cycles));
  }

  Accelerations moving(double after_sample, const double* y, double transmitted) const {
    const TwoMass<double>& part = loop_.plant;
    const double between =
        part.absorber_stiffness * y[2] + part.absorber_damping * y[3] + transmitted;
    const double conductor = (on_conductor(after_sample, y) + between) / part.conductor_mass;
    return {conductor, -between / part.absorber_mass - conductor};
  }

  Accelerations sticking(double after_sample, const double* y) const {
    return {
        on_conductor(after_sample, y) / (loop_.plant.conductor_mass + loop_.plant.absorber_mass),
        0.0};
  }

  /// While the drive sticks, the rate (m/s³) at which v̇ under any constant transmitted force would
  /// change.
  double relative_jerk_sticking(double after_sample, const double* y) const {
    const TwoMass<double>& part = loop_.plant;
    return (part.conductor_stiffness * y[1] +
            part.conductor_damping * sticking(after_sample, y).conductor -
            excitation_rate(after_sample)) /
           part.conductor_mass;
  }

 private:
  double on_conductor(double after_sample, const double* y) const {
    return -loop_.plant.conductor_stiffness * y[0] - loop_.plant.conductor_damping * y[1] +
           excitation(after_sample);
  }
  double phase(double after_sample) const {
    return loop_.hold == ForceHold::sampled
               ? phase_
               : phase_ + loop_.excitation.angular_frequency() * after_sample;
  }
  double excitation(double after_sample) const {
    return loop_.excitation.amplitude * std::cos(phase(after_sample));
  }
  double excitation_rate(double after_sample) const {
    if (loop_.hold == ForceHold::sampled) return 0.0;
    return -loop_.excitation.amplitude * loop_.excitation.angular_frequency() *
           std::sin(phase(after_sample));
  }

  const IdealLoop<double>& loop_;
  double phase_ = 0.0;
};

/// The drive's modes over CVODE. Time counts from the last sample, so that the instants of the
/// switches are found to the precision of a sampling period and not of the whole motion.
///
/// Every mode watches its guards and, as CVODE sees a sign change between the ends of its steps
/// only, the extrema of its guards: their sign changes part a step in which a guard has two.
///
///     mode      guard 0                guard 1                 its extremum
///     engaged   σ v                    –                       σ a(u)
///     gap       distance to far end    distance to near end    σ v
///     stick     σ a(0)                 σ a(u)                  σ ȧ
///
/// CVODE cannot judge a guard that is zero where its mode begins, the less where it is a multiple
/// zero. Therefore v is set to zero exactly at a reversal, σ v is watched in the direction opposite
/// to the one in which it then leaves zero, and the near end of the gap, on which d begins, only
/// once v has turned back towards it.
class SwitchingMotion : public Session {
 public:
  SwitchingMotion(const IdealLoop<double>& loop, const Vector<double, 4>& initial_state,
                  const Tolerances& tolerances);

  /// Takes the sample j and moves to the sample j + 1.
  IntegrationOutcome advance_period(std::int64_t sample);

  Vector<double, 4> state() const {
    const double* y = values();
    return {y[0], y[1], y[0] + y[2], y[1] + y[3]};
  }
  const std::vector<ContactSwitch>& switches() const { return switches_; }

 private:
  static constexpr int guard_count = 3;
  using Guards = std::array<double, guard_count>;
  /// No motion of a real drive has as many switches in one sampling period.
  static constexpr int largest_number_of_events = 1000;
  /// In a smooth piece of the motion; more of them are round-off in a guard that stays near zero.
  static constexpr int largest_number_of_extrema = 16;

  static int rate(sunrealtype time, N_Vector state, N_Vector rate_of_state, void* self);
  static int guards(sunrealtype time, N_Vector state, sunrealtype* values, void* self);
  Guards guards_at(double time, const double* y) const;

  void hold(double command, double from, double to);
  void restart(double to);
  void take_command(double command);
  void note_direction();
  void react();
  void note_extremum();
  std::array<int, guard_count> directions_of_guards() const;
  void reverse();
  void enter_gap();
  void enter(ContactMode mode);

  double* values() const { return N_VGetArrayPointer(state_.get()); }
  /// σ a(s): positive where the drive, transmitting s, accelerates away from its gap.
  double outward_acceleration(double transmitted) const {
    return direction_ * dynamics_.moving(time_, values(), transmitted).relative;
  }
  double inward_distance(const double* y) const { return direction_ * (near_end_ - y[2]); }

  IdealLoop<double> loop_;
  DriveDynamics dynamics_{loop_};
  std::int64_t sample_ = 0;
  double time_ = 0.0;          // s after the sample
  double command_ = 0.0;       // u, held (N)
  double next_command_ = 0.0;  // of the last sample
  ContactMode mode_ = ContactMode::engaged;
  double direction_ = 0.0;  // σ: the sign of v before the last reversal or at present; 0 unknown
  double near_end_ = 0.0;   // of the gap: d at the reversal (m)
  bool turned_ = false;     // in the gap: v has been zero since the entry
  int extrema_ = 0;         // found in the present smooth piece of the motion
  std::vector<ContactSwitch> switches_;
};

inline SwitchingMotion::SwitchingMotion(const IdealLoop<double>& loop,
                                        const Vector<double, 4>& initial_state,
                                        const Tolerances& tolerances)
    : Session(tolerances), loop_(loop) {
  const Vector<double, 4>& z = initial_state;
  const Eigen::Vector4d y(z[0], z[1], z[2] - z[0], z[3] - z[1]);
  open(CV_ADAMS, &SwitchingMotion::rate, y, tolerances, this);
  use_fixed_point();
}

inline int SwitchingMotion::rate(sunrealtype time, N_Vector state, N_Vector rate_of_state,
                                 void* self) {
  const auto& motion = *static_cast<SwitchingMotion*>(self);
  const double* y = N_VGetArrayPointer(state);
  const bool sticks = motion.mode_ == ContactMode::stick;
  const double transmitted = motion.mode_ == ContactMode::engaged ? motion.command_ : 0.0;
  const auto acceleration =
      sticks ? motion.dynamics_.sticking(time, y) : motion.dynamics_.moving(time, y, transmitted);
  double* rates = N_VGetArrayPointer(rate_of_state);
  rates[0] = y[1];
  rates[1] = acceleration.conductor;
  rates[2] = y[3];
  rates[3] = acceleration.relative;
  return std::isfinite(rates[1]) && std::isfinite(rates[3]) ? 0 : 1;
}

inline SwitchingMotion::Guards SwitchingMotion::guards_at(double time, const double* y) const {
  const auto outward = [&](double transmitted) {
    return direction_ * dynamics_.moving(time, y, transmitted).relative;
  };
  const bool parts = extrema_ < largest_number_of_extrema;
  switch (mode_) {
    case ContactMode::gap:
      if (!turned_) return {loop_.backlash_width - inward_distance(y), 1.0, direction_ * y[3]};
      return {loop_.backlash_width - inward_distance(y), inward_distance(y),
              parts ? direction_ * y[3] : 1.0};
    case ContactMode::stick:
      return {outward(0.0), outward(command_),
              parts ? direction_ * dynamics_.relative_jerk_sticking(time, y) : 1.0};
    case ContactMode::engaged:
      break;
  }
  // At the very start from rest, as long as v has no sign, v itself is watched for any crossing.
  if (direction_ == 0.0) return {y[3], 1.0, 1.0};
  return {direction_ * y[3], 1.0, parts ? outward(command_) : 1.0};
}

inline int SwitchingMotion::guards(sunrealtype time, N_Vector state, sunrealtype* values,
                                   void* self) {
  const Guards found =
      static_cast<SwitchingMotion*>(self)->guards_at(time, N_VGetArrayPointer(state));
  std::copy(found.begin(), found.end(), values);
  return 0;
}

inline IntegrationOutcome SwitchingMotion::advance_period(std::int64_t sample) {
  if (outcome_ != IntegrationOutcome::completed) return outcome_;
  sample_ = sample;
  dynamics_.begin_period(sample);
  const double previous_command = next_command_;
  next_command_ = loop_.gains.proportional * values()[0] + loop_.gains.differential * values()[1];
  hold(previous_command, 0.0, loop_.sampling.processing_delay);
  hold(next_command_, loop_.sampling.processing_delay, loop_.sampling.period);
  return outcome_;
}

/// Moves under a held command. A shorter time than CVODE can tell from none is left out.
inline void SwitchingMotion::hold(double command, double from, double to) {
  const double shortest = 16.0 * std::numeric_limits<double>::epsilon() * loop_.sampling.period;
  if (to - from <= shortest) return;
  time_ = from;
  extrema_ = 0;
  take_command(command);
  int events = 0;
  while (outcome_ == IntegrationOutcome::completed && to - time_ > shortest) {
    note_direction();
    restart(to);
    if (outcome_ != IntegrationOutcome::completed) return;
    const int flag = CVode(memory_.get(), to, state_.get(), &time_, CV_NORMAL);
    if (flag != CV_ROOT_RETURN) {
      check(flag);
    } else if (++events <= largest_number_of_events) {
      react();
    } else {
      outcome_ = IntegrationOutcome::too_much_work;
      words_ = "too many switches within one sampling period";
    }
  }
}

/// Begins a smooth piece of the motion, with the guards of its mode.
inline void SwitchingMotion::restart(double to) {
  check(CVodeReInit(memory_.get(), time_, state_.get()));
  check(CVodeSetStopTime(memory_.get(), to));
  // Root functions taken away and given again: CVODE would else remember which were zero before.
  check(CVodeRootInit(memory_.get(), 0, nullptr));
  if (loop_.backlash_width == 0.0) return;
  check(CVodeRootInit(memory_.get(), guard_count, &SwitchingMotion::guards));
  check(CVodeSetNoInactiveRootWarn(memory_.get()));
  std::array<int, guard_count> directions = directions_of_guards();
  check(CVodeSetRootDirection(memory_.get(), directions.data()));
}

/// +1 where a guard matters when it becomes positive, −1 negative, 0 either.
inline std::array<int, SwitchingMotion::guard_count> SwitchingMotion::directions_of_guards() const {
  switch (mode_) {
    case ContactMode::gap:
      return {-1, -1, turned_ ? 0 : +1};
    case ContactMode::stick:
      return {-1, +1, 0};
    case ContactMode::engaged:
      break;
  }
  return {direction_ == 0.0 ? 0 : -1, 0, +1};
}

/// The switches that a new command, or a new value of a held excitation, brings at once.
inline void SwitchingMotion::take_command(double command) {
  command_ = command;
  if (loop_.backlash_width == 0.0) return;
  if (mode_ == ContactMode::stick) {
    if (outward_acceleration(0.0) <= 0.0)
      enter_gap();
    else if (outward_acceleration(command_) >= 0.0)
      enter(ContactMode::engaged);
  } else if (mode_ == ContactMode::gap && !turned_ && direction_ * values()[3] >= 0.0 &&
             outward_acceleration(0.0) > 0.0) {
    note_extremum();
  }
}

/// Finds σ as soon as v has a sign, and a reversal that begins with v = 0.
inline void SwitchingMotion::note_direction() {
  const double velocity = values()[3];
  if (direction_ == 0.0 && velocity != 0.0) direction_ = velocity > 0.0 ? 1.0 : -1.0;
  if (loop_.backlash_width > 0.0 && mode_ == ContactMode::engaged && direction_ * velocity <= 0.0 &&
      outward_acceleration(command_) < 0.0)
    reverse();
}

/// What CVODE has found: a switch, or else an extremum, which changes nothing.
inline void SwitchingMotion::react() {
  std::array<int, guard_count> crossed{};
  check(CVodeGetRootInfo(memory_.get(), crossed.data()));
  if (crossed[0] == 0 && crossed[1] == 0) return note_extremum();
  switch (mode_) {
    case ContactMode::engaged:
      if (direction_ == 0.0) direction_ = crossed[0] < 0 ? 1.0 : -1.0;
      return reverse();
    case ContactMode::stick:
      return crossed[0] != 0 ? enter_gap() : enter(ContactMode::engaged);
    case ContactMode::gap:
      if (crossed[0] != 0) direction_ = -direction_;
      return enter(ContactMode::engaged);
  }
}

inline void SwitchingMotion::note_extremum() {
  ++extrema_;
  if (mode_ != ContactMode::gap || turned_) return;
  turned_ = true;
  // An excursion too short to be told from none is over where v turns.
  if (inward_distance(values()) <= 0.0) enter(ContactMode::engaged);
}

/// Engaged, v has become zero: σ a(u) < 0. Where it is not, v touches zero to the precision of the
/// integration, and the rate of a(u) tells whether it falls below zero or rises again.
inline void SwitchingMotion::reverse() {
  values()[3] = 0.0;
  near_end_ = values()[2];
  if (outward_acceleration(0.0) <= 0.0)
    enter_gap();
  else if (outward_acceleration(command_) < 0.0 ||
           direction_ * dynamics_.relative_jerk_sticking(time_, values()) < 0.0)
    enter(ContactMode::stick);
}

inline void SwitchingMotion::enter_gap() {
  enter(ContactMode::gap);
  turned_ = false;
}

inline void SwitchingMotion::enter(ContactMode mode) {
  mode_ = mode;
  extrema_ = 0;
  switches_.push_back({static_cast<double>(sample_) * loop_.sampling.period + time_, mode});
}

}  // namespace detail

/// The motion with exact switching by CVODE (Adams' method) with root finding: an independent
/// reference for the closed-form one. It shares with the library the parameters alone; the motion
/// follows from Newton's law of each mass.
///
/// With v = ż₂ − ż₁, d = z₂ − z₁, u the held command and a(s) = v̇ under the transmitted force s:
///
///  - engaged (s = u) until v reaches 0 from the sign σ. The gap is then [d − r₀, d] for σ > 0 and
///    [d, d + r₀] for σ < 0; there follows stick if σ a(0) > 0 and σ a(u) < 0, else gap. Where v
///    but touches zero and σ a(0) > 0 it stays engaged.
///  - stick: v = 0, s between 0 and u. Ends in gap when σ a(0) ≤ 0, else in engaged when
///    σ a(u) ≥ 0. A sample changes u and may end it at once.
///  - gap (s = 0) until d leaves it; then engaged.
///
/// It starts engaged; r₀ = 0 means always engaged. The command u_j = P z₁(t_j) + D ż₁(t_j) is
/// computed at every sample t_j = j τ in every mode and held from t_j + δ to t_{j+1} + δ; before
/// δ it is zero. The excitation is F_m cos(2π f t) in continuous time, or with
/// `ForceHold::sampled` its value at t_j held over [t_j, t_{j+1}).
///
/// Source: Filippov 1988, Differential Equations with Discontinuous Righthand Sides, for the
/// sticking of Kollár 2022, Eqs. (7)–(8), taken to continuous time.
/// @param loop           with its excitation and backlash
/// @param initial_state  [z₁, ż₁, z₂, ż₂] (m, m/s, m, m/s), finite
/// @param samples        ≥ 1
/// @param tolerances     local error per step, at best about 1e-13 relative
inline SwitchingReference switching_reference(const IdealLoop<double>& loop,
                                              const Vector<double, 4>& initial_state,
                                              std::int64_t samples, const Tolerances& tolerances) {
  detail::SwitchingMotion motion(loop, initial_state, tolerances);
  SwitchingReference result{motion.outcome(), "", {initial_state}, {}};
  for (std::int64_t j = 0; j + 1 < samples; ++j) {
    if (motion.advance_period(j) != IntegrationOutcome::completed) break;
    result.states.push_back(motion.state());
  }
  result.outcome = motion.outcome();
  result.words = motion.words();
  result.switches = motion.switches();
  return result;
}

}  // namespace holdfast::cvode
