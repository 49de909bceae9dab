#pragma once

#include <algorithm>
#include <cstdint>

#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/contact/contact_law.hpp"
#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/contact/mode_dynamics.hpp"
#include "holdfast/plant/port_readings.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// The instants at which the drive may enter and leave its backlash.
enum class Switching : std::uint8_t {
  sampled,  ///< only at samples, by the rule of the ContactLaw for sampled values
  exact,    ///< at any time; the laws `kollar`, `immediate` and `play` are then identical
};

/// The contact of a drive with its load: a hybrid automaton with three modes. The plant is affine
/// in each mode (`dynamics`). `sample`, `jumped`, `displaced` and `reached` may change the mode.
///
///     DriveContact<> contact(plant, {ContactLaw::play, 0.0005}, Switching::exact, state);
///
/// **Switching::sampled**: at each sample t_j the law decides whether the command u_j is
/// transmitted. If not, u_j is replaced by 0 after the processing delay, and the force of a drive
/// with a lag decays. If Δz touches a stop of a dead zone at a sample, the stop acts from this
/// sample on. The mode is 0 on the lower stop of a dead zone, 2 on its upper stop, and 1 otherwise.
///
/// **Exact play** (Switching::exact) is the play operator of Δz with the gap width r₀, as a
/// Filippov system. A, b, b_u, c, f, g are defined in LinearPlant. v = Δż = rᵀx is the relative
/// velocity, a(s) = rᵀ(A x + b s + b_u u + c F) the relative acceleration under a transmitted force
/// s. The modes, numbered as in ContactMode, are
///
/// - engaged: the drive's force s_e = f x + g u (u for an ideal drive) is transmitted until v
///   reaches zero. σ is the sign of v before. The gap is then [Δz − r₀, Δz] for σ > 0, [Δz, Δz +
///   r₀] for σ < 0. The next mode is stick if σ a(0) > 0 and σ a(s_e) < 0, else gap;
/// - gap: no force is transmitted until Δz leaves the gap. The next mode is engaged;
/// - stick: v stays 0 under the transmitted force s = −rᵀ(A x + b_u u + c F) / (rᵀb), which lies
///   between 0 and s_e. Without force the relative motion would continue in the old direction, and
///   under s_e it would reverse. The next mode is gap when σ a(0) ≤ 0, engaged when σ a(s_e) ≥ 0.
///
/// With r₀ = 0 the drive is always engaged. The rule of Kollár 2022, Eqs. (7)–(8), is exact play
/// evaluated at the samples only. Source of the force in stick: A. F. Filippov, Differential
/// equations with discontinuous righthand sides, 1988.
///
/// **An exact dead zone** transmits nothing while |Δz| ≤ r₀/2 (mode 1). Outside (modes 0 and 2) it
/// transmits the command, and a stop of stiffness k_c and damping c_c adds the force k_c (Δz ∓
/// r₀/2) + c_c Δż between the masses. There is no stick. The absorber bounces at the end of the gap
/// if the plant pushes it outwards and the command inwards: v reverses with the period 2 |v|
/// (1/|a(0)| + 1/|a(u)|), and damping reduces |v|. All bounces are computed until
/// SwitchCounts::accumulates is set. Source: Shaw and Holmes (1983), see DeadZone.
/// @tparam DrivenPlant  TwoMass<double> or a LinearPlant<double, N>
template <class DrivenPlant = TwoMass<double>>
class DriveContact {
 public:
  using Plant = DrivenPlant;                           ///< plant with the drive
  using State = StateOf<Plant>;                        ///< state x of the plant, N × 1
  using Instant = ContactInstantOf<states_of<Plant>>;  ///< state, command and force at an instant
  using ModeGuards = GuardsOf<states_of<Plant>>;       ///< guards that end a mode

  static constexpr int modes = 3;  ///< number of modes: 0, 1 and 2

  /// @param plant          plant with its drive, without the stops of a dead zone
  /// @param backlash       law of backlash with its parameters
  /// @param switching      whether the contact may change at any time or at samples only
  /// @param initial_state  initial state, N × 1: its Δz decides which stop of an exact dead zone is
  ///                       touched. Exact play begins engaged; σ is the sign of the first Δż ≠ 0
  /// @throws InvalidParameter for an inadmissible plant or backlash, or a state of another size
  DriveContact(const Plant& plant, const BacklashParameters& backlash, Switching switching,
               const State& initial_state)
      : plant_((validate(plant), plant)),
        readings_(plant),
        backlash_(backlash),
        law_(backlash),
        free_(gap_acceleration(plant, released_dynamics(plant))),
        driven_(gap_acceleration(plant, engaged_dynamics(plant))),
        mobility_(gap_mobility(plant)) {
    detail::require_state(initial_state, plant);
    if (backlash.law == ContactLaw::none) backlash_.width = 0.0;
    if (switching == Switching::sampled) return;
    kind_ = backlash.law == ContactLaw::dead_zone ? Kind::stops : Kind::play;
    changes_between_samples_ = kind_ == Kind::stops || backlash_.width > 0.0;
    change_to(kind_ == Kind::play ? 0 : gap, 0);
    if (kind_ == Kind::play) return;
    upper_ = 0.5 * backlash.width;
    lower_ = -upper_;
    const double here = readings_.relative_displacement(initial_state);
    if (here > upper_ || here < lower_) change_to(here > upper_ ? 2 : 0, 0);
  }

  /// The equations of motion in one mode. With Switching::sampled the command has an effect in all
  /// modes; insert commanded(u) for the command u, to make it 0 while the law does not transmit.
  DynamicsOf<Plant> dynamics(int mode) const {
    if (has_stop(mode))
      return dynamics_on_stop(plant_, backlash_.contact_stiffness, backlash_.contact_damping,
                              0.5 * (mode - gap) * backlash_.width);
    if (kind_ == Kind::at_samples || mode == 0) return engaged_dynamics(plant_);
    return mode == gap ? released_dynamics(plant_) : locked_dynamics(plant_);
  }
  /// The plant with the drive.
  const Plant& plant() const { return plant_; }
  /// The plant in one mode, with the spring and the damper of the stop touched in that mode.
  Plant plant(int mode) const {
    return has_stop(mode)
               ? plant_on_stop(plant_, backlash_.contact_stiffness, backlash_.contact_damping)
               : plant_;
  }
  /// Functions that read displacements and velocities from the plant's state.
  const PortReadings<Plant>& readings() const { return readings_; }

  /// The number of the present mode, 0 … `modes` − 1.
  int mode() const { return mode_; }
  /// The present mode as a ContactMode; with Switching::sampled it is initially `engaged`.
  ContactMode word() const { return word_; }
  /// Whether the command is passed to the drive. With Switching::exact always true; with
  /// Switching::sampled true if the law transmitted at the last sample.
  bool transmits_command() const {
    return kind_ != Kind::at_samples || word_ == ContactMode::engaged;
  }
  /// The command (N) that reaches the drive: `command` if transmits_command() is true, else 0.
  double commanded(double command) const { return transmits_command() ? command : 0.0; }
  /// The force (N) that the drive transmits at the instant `now`, without the force of a stop.
  double transmitted(const Instant& now) const {
    if (kind_ == Kind::at_samples) return now.command;
    if (word_ == ContactMode::engaged) return engaged_force(plant_, now);
    return word_ == ContactMode::gap ? 0.0 : -free_(now) / mobility_;
  }

  /// Whether the contact may change between samples: with Switching::exact, except play if r₀ = 0.
  bool changes_between_samples() const { return changes_between_samples_; }
  /// The guards of the present mode: positive functions whose zero ends the mode; none if the
  /// contact does not change between samples. Engaged play: σ Δż (m/s), σ = ±1 the sign of Δż. Gap:
  /// distances of Δz from the upper and lower end (m). Stop: distance of Δz beyond the end of the
  /// gap (m). Stick: σ a(0) and −σ a(s_e) (m/s²) with a(s) and s_e of the class comment.
  ModeGuards guards() const {
    if (!changes_between_samples_) return {};
    if (mode_ == gap) return gap_guards();
    if (kind_ == Kind::stops) return stop_guards();
    return mode_ == 0 ? engaged_guards() : stick_guards();
  }

  /// Updates the contact at a sample from Δz and Δż of the state; no effect with Switching::exact.
  void sample(const State& state) {
    if (kind_ != Kind::at_samples) return;
    const bool engaged =
        law_.step(readings_.relative_displacement(state), readings_.relative_velocity(state));
    word_ = engaged ? ContactMode::engaged : ContactMode::gap;
    mode_ = gap + law_.side();
  }
  /// Updates the contact after a possible jump of excitation or command; `now`: values after it.
  void jumped(const Instant& now) {
    if (kind_ != Kind::play) return;
    if (word_ == ContactMode::stick) return leave_stick(now, 1);
    // Further zeros at a change of contact are those of the force and the command before the jump.
    zeros_ = std::min(zeros_, mode_ == gap ? 2 : 1);
  }
  /// Updates the contact after a jump of Δz: stick changes to gap. If Δz is now beyond an end of
  /// the gap, a guard is negative, and EventMotion changes the mode at the start of its next step.
  void displaced() {
    if (word_ == ContactMode::stick) change_to(gap, 0);
    zeros_ = 0;
    displaced_ = true;
  }
  /// In stick, removes round-off: sets Δż of `after` to 0 and Δz of `after` to Δz of `before`.
  void keep(const State& before, State& after) const {
    if (word_ == ContactMode::stick) readings_.hold_relative_position(before, after);
  }
  /// Records that time has passed since the contact changed: guards that were 0 may be nonzero now.
  void flowed() {
    zeros_ = 0;
    displaced_ = false;
  }
  /// Sets the sign σ = ±1 of the relative velocity Δż when it first differs from zero.
  void learn_sign(int /*guard*/, double sign) { sign_ = sign; }
  /// Changes the contact after a guard, given by its number in guards(), has reached zero. At a
  /// reversal in exact play, sets Δż of `now` to exactly zero.
  void reached(int guard, Instant& now) {
    if (kind_ == Kind::stops) {
      sign_ = mode_ - gap;
      // Displaced, it may lie far beyond the end.
      return change_to(mode_ != gap ? gap : guard == 0 ? 2 : 0, displaced_ ? 0 : 1);
    }
    if (mode_ == 0) return reverse(now);
    if (mode_ == gap) return leave_gap(guard == 0 ? 1.0 : -1.0, now);
    leave_stick(now, 2);
    if (mode_ == stick) change_to(guard == 0 ? gap : 0, guard == 0 ? 3 : 2);
  }

  /// The number of the mode stick, in which Δż = 0; −1 for a law without this mode.
  int sticking_mode() const { return kind_ == Kind::play ? stick : -1; }
  /// Whether a mode depends on g, the Δz at the last reversal. True in exact play for the gap, with
  /// the ends g and g − σ r₀, and for stick, with Δz = g. False for engaged play and dead zones.
  bool is_anchored(int mode) const { return kind_ == Kind::play && mode != 0; }
  /// Whether the drive is in the gap of exact play, whose ends depend on the last reversal.
  bool remembers_gap() const { return kind_ == Kind::play && mode_ == gap; }
  /// Sign σ = ±1 of Δż while exact play is (or was last) engaged; 0 until Δż is first nonzero.
  double sign() const { return sign_; }
  /// The lower end Δz (m) of the gap with Switching::exact; undefined for play while engaged.
  double lower() const { return lower_; }
  /// The upper end Δz (m) of the gap with Switching::exact; undefined for play while engaged.
  double upper() const { return upper_; }
  /// The relative displacement g (m) at which exact play last reversed, one end of its gap;
  /// undefined while engaged and for other laws.
  double reversal() const { return sign_ > 0.0 ? upper_ : lower_; }
  /// Puts a drive with exact play into the gap that follows a given reversal.
  /// @param at    relative displacement g (m) at the reversal
  /// @param sign  sign σ of Δż before the reversal; gap [g − r₀, g] for +1, [g, g + r₀] for −1
  void cross_gap(double at, double sign) {
    sign_ = sign;
    open_gap(at);
    change_to(gap, 0);
  }
  /// Adds `by` (m) to both ends of the gap of exact play; no effect on other contacts.
  void shift_gap(double by) {
    if (kind_ != Kind::play) return;
    lower_ += by;
    upper_ += by;
  }

 private:
  enum class Kind : std::uint8_t { at_samples, play, stops };

  static constexpr int gap = 1, stick = 2;

  bool has_stop(int mode) const { return kind_ != Kind::play && mode != gap; }

  ModeGuards engaged_guards() const {
    ModeGuards result;
    const double sign = sign_ == 0.0 ? 1.0 : sign_;
    result.guard[0] = {readings_.velocity_row() * sign, 0.0, 0.0, 0.0, zeros_, sign_ == 0.0};
    result.count = 1;
    return result;
  }

  /// The guards of the gap. Just after a reversal, the guard at the end where the gap begins is 0.
  ModeGuards gap_guards() const {
    ModeGuards result;
    result.guard[0] = {-readings_.displacement_row(), 0.0, 0.0, upper_, sign_ > 0.0 ? zeros_ : 0};
    result.guard[1] = {readings_.displacement_row(), 0.0, 0.0, -lower_, sign_ < 0.0 ? zeros_ : 0};
    result.count = 2;
    return result;
  }

  ModeGuards stop_guards() const {
    ModeGuards result;
    const double side = mode_ - gap;
    result.guard[0] = {readings_.displacement_row() * side, 0.0, 0.0, lower_, zeros_};
    result.count = 1;
    return result;
  }

  ModeGuards stick_guards() const {
    ModeGuards result;
    const auto &on = free_, &back = driven_;
    result.guard[0] = {on.state * sign_, on.command * sign_, on.force * sign_, 0.0};
    result.guard[1] = {-back.state * sign_, -back.command * sign_, -back.force * sign_, 0.0};
    result.count = 2;
    return result;
  }

  void change_to(int mode, int zeros) {
    mode_ = mode;
    zeros_ = zeros;
    word_ = kind_ == Kind::play ? static_cast<ContactMode>(mode)
            : mode == gap       ? ContactMode::gap
                                : ContactMode::engaged;
  }

  /// Opens a gap of width r₀ that begins at the present Δz = `here` and extends in direction −σ.
  void open_gap(double here) {
    lower_ = sign_ > 0.0 ? here - backlash_.width : here;
    upper_ = sign_ > 0.0 ? here : here + backlash_.width;
  }

  /// Leaves the gap beyond its upper (+1) or lower (−1) end. If a displaced drive is moving back
  /// from beyond this end, a new gap begins at its present Δz.
  void leave_gap(double side, const Instant& now) {
    sign_ = side;
    if (side * readings_.relative_velocity(now.state) < 0.0) {
      open_gap(readings_.relative_displacement(now.state));
      return change_to(gap, 1);
    }
    change_to(0, 0);
  }

  void reverse(Instant& now) {
    readings_.stop_relative_motion(now.state);
    open_gap(readings_.relative_displacement(now.state));
    // Where one is zero its derivative decides: a guard of stick at zero ends it at once or never.
    const bool pushed_on = !(sign_ * free_(now) < 0.0);
    const bool turned_back = !(sign_ * driven_(now) > 0.0);
    const bool sticks = pushed_on && turned_back && engaged_force(plant_, now) != 0.0;
    change_to(sticks ? stick : gap, sticks ? 0 : 2);
  }

  /// Ends stick where its condition is violated; otherwise the mode is unchanged.
  /// @param now    the present instant, with command and force just after it
  /// @param zeros  number of v, v̇, … that vanish if the drive engages: one after a jump of command
  ///               or force, two if the force in stick reached the drive's force continuously
  void leave_stick(const Instant& now, int zeros) {
    if (!(sign_ * free_(now) > 0.0))
      change_to(gap, zeros + 1);
    else if (!(sign_ * driven_(now) < 0.0))
      change_to(0, zeros);
  }

  Plant plant_;
  PortReadings<Plant> readings_;
  BacklashParameters backlash_;
  SampledContact law_;
  GapAcceleration<states_of<Plant>> free_, driven_;  // a(0) and a(s_e)
  double mobility_;                                  // rᵀb
  Kind kind_ = Kind::at_samples;
  bool changes_between_samples_ = false;
  ContactMode word_ = ContactMode::engaged;
  int mode_ = gap;
  int zeros_ = 0;      // of the guards, just after a change
  double sign_ = 0.0;  // σ; of stops the one that was left last
  double lower_ = 0.0, upper_ = 0.0;
  bool displaced_ = false;
};

}  // namespace holdfast
