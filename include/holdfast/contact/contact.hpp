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
  sampled,  ///< at samples only, by the law's rule for sampled values
  exact,    ///< in continuous time; `kollar`, `immediate` and `play` are then one law
};

/// The contact of a drive with its load as an automaton of three modes. In each mode the plant is
/// affine (`dynamics`), and guards determine when the mode ends. The transitions are `sample`,
/// `jumped` and `reached`.
///
///     DriveContact<> contact(plant, {ContactLaw::play, 0.0005}, Switching::exact, state);
///
/// **At samples** the law decides on the contact up to the next sample. Where the law does not
/// transmit, the command has no effect: u_j = 0 from t_j + δ on, and the force of a drive with
/// a lag decays. The stops of a dead zone act from the sample on. The mode is always 1, except on
/// the stops of a dead zone: 0 on the lower stop, 2 on the upper one.
///
/// **Exact play** is the play operator of Δz as a Filippov system. v = Δż = rᵀx is the relative
/// velocity, a(s) = rᵀ(A x + b s + b_u u + c F) the relative acceleration under a transmitted force
/// s. The modes, numbered as in ContactMode, are
///
/// - engaged: the drive's force s_e is transmitted (u for an ideal drive, f x + g u for one with
///   a lag), until v reaches zero from a sign σ. Then the gap is [Δz − r₀, Δz] for σ > 0, [Δz, Δz
///   + r₀] for σ < 0. The next mode is stick if σ a(0) > 0 and σ a(s_e) < 0, else gap;
/// - gap: no force is transmitted, until Δz leaves the gap; then engaged;
/// - stick: without force the relative motion would continue in the old direction, with s_e it
/// would reverse. Both sides stay together, v = 0, under the transmitted force s = −rᵀ(A x + b_u u
/// + c F) / (rᵀb), which is between 0 and s_e. The mode ends in gap when σ a(0) ≤ 0, in engaged
/// when σ a(s_e) ≥ 0.
///
/// r₀ = 0 is a drive without backlash: always engaged. The rule of Kollár 2022, Eqs. (7)–(8), is
/// this law evaluated at the samples only. Source of the sliding force: A. F. Filippov,
/// Differential equations with discontinuous righthand sides, 1988.
///
/// **An exact dead zone** |Δz| ≤ r₀/2 transmits nothing inside (mode 1); outside (modes 0 and 2)
/// it transmits the command, and the stop adds k_c (Δz ∓ r₀/2) + c_c Δż between the masses. No mode
/// slides. If the plant pushes outwards and the command inwards at the edge, the absorber bounces
/// there: v reverses with the period 2 |v| (1/|a(0)| + 1/|a(u)|), and damping reduces |v| without
/// end. Every bounce is computed until SwitchCounts::accumulates is set. Source: S. W. Shaw, P. J.
/// Holmes, A periodically forced piecewise linear oscillator, J. Sound Vib. 90 (1983).
/// @tparam DrivenPlant  TwoMass<double> or a LinearPlant<double, N>
template <class DrivenPlant = TwoMass<double>>
class DriveContact {
 public:
  using Plant = DrivenPlant;                           ///< plant with the drive
  using State = StateOf<Plant>;                        ///< state x of the plant, N × 1
  using Instant = ContactInstantOf<states_of<Plant>>;  ///< state, command and force at an instant
  using ModeGuards = GuardsOf<states_of<Plant>>;       ///< guards that end a mode

  static constexpr int modes = 3;  ///< number of modes: 0, 1 and 2

  /// @param plant          plant without control and stops
  /// @param backlash       law of backlash with its parameters
  /// @param switching      whether the contact may change between the samples or at them only
  /// @param initial_state  initial state, N × 1: its Δz decides which stop of an exact dead zone is
  ///                       touched; play begins engaged, with σ unknown
  /// @throws InvalidParameter where plant or backlash are not admissible, or the state is of
  /// another size
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

  /// The equations of motion in one mode. With a law at samples the command acts in all modes;
  /// `commanded` removes a command that is not transmitted.
  DynamicsOf<Plant> dynamics(int mode) const {
    if (has_stop(mode))
      return dynamics_on_stop(plant_, backlash_.contact_stiffness, backlash_.contact_damping,
                              0.5 * (mode - gap) * backlash_.width);
    if (kind_ == Kind::at_samples || mode == 0) return engaged_dynamics(plant_);
    return mode == gap ? released_dynamics(plant_) : locked_dynamics(plant_);
  }
  /// The plant with the drive.
  const Plant& plant() const { return plant_; }
  /// The plant in one mode, with the spring and the damper of a stop that the mode touches.
  Plant plant(int mode) const {
    return has_stop(mode)
               ? plant_on_stop(plant_, backlash_.contact_stiffness, backlash_.contact_damping)
               : plant_;
  }
  /// Functions that read displacements and velocities from the plant's state.
  const PortReadings<Plant>& readings() const { return readings_; }

  /// The number of the present mode, 0 … `modes` − 1.
  int mode() const { return mode_; }
  /// The present contact mode of the drive. A law at samples begins with `engaged`.
  ContactMode word() const { return word_; }
  /// Whether the command of the present sample has an effect: always, except where a law at samples
  /// decided not to transmit it.
  bool transmits_command() const {
    return kind_ != Kind::at_samples || word_ == ContactMode::engaged;
  }
  /// The command u_j (N) that reaches the drive: `command`, or 0 if the command is not transmitted.
  double commanded(double command) const { return transmits_command() ? command : 0.0; }
  /// Force (N) that the drive transmits, without the force of a stop.
  double transmitted(const Instant& now) const {
    if (kind_ == Kind::at_samples) return now.command;
    if (word_ == ContactMode::engaged) return engaged_force(plant_, now);
    return word_ == ContactMode::gap ? 0.0 : -free_(now) / mobility_;
  }

  /// Whether the contact may change between samples: true for exact laws except play with r₀ = 0.
  bool changes_between_samples() const { return changes_between_samples_; }
  /// The guards that end the present mode between the samples. Engaged play: the velocity σ Δż
  /// (m/s). Gap: the distances (m) of Δz from both ends. Stop: the distance (m) of Δz beyond the
  /// end of the gap. Stick: the accelerations (m/s²) σ a(0) and −σ a(s_e).
  ModeGuards guards() const {
    if (!changes_between_samples_) return {};
    if (mode_ == gap) return gap_guards();
    if (kind_ == Kind::stops) return stop_guards();
    return mode_ == 0 ? engaged_guards() : stick_guards();
  }

  /// Applies a sampled state: a law at samples decides from its Δz and Δż; exact laws ignore it.
  void sample(const State& state) {
    if (kind_ != Kind::at_samples) return;
    const bool engaged =
        law_.step(readings_.relative_displacement(state), readings_.relative_velocity(state));
    word_ = engaged ? ContactMode::engaged : ContactMode::gap;
    mode_ = gap + law_.side();
  }
  /// Updates the contact after a jump, or possible jump, of the force or the command.
  void jumped(const Instant& now) {
    if (kind_ != Kind::play) return;
    if (word_ == ContactMode::stick) return leave_stick(now, 1);
    // Further zeros at a change of contact are those of the force and the command before the jump.
    zeros_ = std::min(zeros_, mode_ == gap ? 2 : 1);
  }
  /// Updates the contact after a jump of the absorber's displacement against the conductor: stick
  /// ends, and a stop that was passed is detected at once, since its guard is negative.
  void displaced() {
    if (word_ == ContactMode::stick) change_to(gap, 0);
    zeros_ = 0;
    displaced_ = true;
  }
  /// Restores the constraints of stick, Δż = 0 and the former Δz, exactly; other modes: no effect.
  void keep(const State& before, State& after) const {
    if (word_ == ContactMode::stick) readings_.hold_relative_position(before, after);
  }
  /// Records that time has passed since the last change of contact.
  void flowed() {
    zeros_ = 0;
    displaced_ = false;
  }
  /// Sets the unknown sign σ = ±1 of the relative velocity.
  void learn_sign(int /*guard*/, double sign) { sign_ = sign; }
  /// Changes the contact after a guard has reached zero; at a reversal Δż becomes exactly zero.
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

  /// Number of the mode stick, in which Δż = 0; −1 for a law without this mode.
  int sticking_mode() const { return kind_ == Kind::play ? stick : -1; }
  /// Whether a mode's switching surface is Δz = g or Δz = g ∓ r₀, g being the Δz (m) at play's last
  /// reversal. Other surfaces are Δż = 0 (engaged play) and a fixed Δz (stops).
  bool is_anchored(int mode) const { return kind_ == Kind::play && mode != 0; }
  /// Whether the drive is in a gap that begins at play's last reversal.
  bool remembers_gap() const { return kind_ == Kind::play && mode_ == gap; }
  /// Sign σ = ±1 of Δż in exact play; 0 until Δż is nonzero for the first time.
  double sign() const { return sign_; }
  /// The lower end of an exact law's gap, Δz (m); undefined for play while engaged.
  double lower() const { return lower_; }
  /// The upper end of an exact law's gap, Δz (m); undefined for play while engaged.
  double upper() const { return upper_; }
  /// Relative displacement g = Δz (m) at play's last reversal, where the gap begins; while engaged,
  /// at the previous reversal.
  double reversal() const { return sign_ > 0.0 ? upper_ : lower_; }
  /// Puts a drive with exact play into the gap that begins at a given reversal.
  /// @param at    relative displacement g (m) at the reversal
  /// @param sign  σ = ±1: the gap is below g for +1
  void cross_gap(double at, double sign) {
    sign_ = sign;
    open_gap(at);
    change_to(gap, 0);
  }
  /// Shifts both ends of the gap of play by a displacement (m); no effect on other laws.
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

  /// Opens the gap that begins at the present Δz = `here` and extends against the sign σ.
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
    // Where one of them is zero its derivative decides: a guard of stick that begins at zero ends
    // it at once or not at all.
    const bool pushed_on = !(sign_ * free_(now) < 0.0);
    const bool turned_back = !(sign_ * driven_(now) > 0.0);
    const bool sticks = pushed_on && turned_back && engaged_force(plant_, now) != 0.0;
    change_to(sticks ? stick : gap, sticks ? 0 : 2);
  }

  /// Ends stick where its condition is violated; otherwise the mode is unchanged.
  /// @param now    the instant, with the command and the force from then on
  /// @param zeros  number of v, v̇, … that vanish if the drive engages: one if the command jumped
  ///               beyond the force of stick, two if that force reached the command
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
