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

/// When the drive enters and leaves its backlash.
enum class Switching : std::uint8_t {
  sampled,  ///< at samples, by the law's rule for them
  exact,    ///< when it happens; `kollar`, `immediate` and `play` are one law then
};

/// The contact of a drive with its load as an automaton of three modes. In each of them the plant
/// is affine (`dynamics`), guards tell how long it lasts, and `sample`, `jumped` and `reached` are
/// the transitions.
///
///     DriveContact<> contact(plant, {ContactLaw::play, 0.0005}, Switching::exact, state);
///
/// **At samples** any law decides what holds up to the next one; where it does not transmit, the
/// command of that sample is without effect, u_j = 0 from t_j + δ on. A drive with states of its
/// own follows that command: what it transmits fades with them. The stops of a dead zone touch from
/// the sample on. Modes: 1, for a dead zone 0 and 2 on its lower and upper stop.
///
/// **Exact play** is the play operator of Δz as a Filippov system. With v = Δż = rᵀx and
/// a(s) = rᵀ(A x + b s + b_u u + c F), the relative acceleration while a force s is transmitted,
/// its modes, numbered as ContactMode is, are
///
///  - engaged: the drive's force s_e is transmitted (u of an ideal drive, f x + g u of one with
///    states), until v comes to zero from a sign σ. Then the gap is [Δz − r₀, Δz] for σ > 0,
///    [Δz, Δz + r₀] for σ < 0, and the next mode is stick if σ a(0) > 0 and σ a(s_e) < 0, else gap;
///  - gap: no force, until Δz leaves the gap; then engaged;
///  - stick: without a force the spring would push on in the old direction, with s_e it would turn
///    back. The sides stay together, v = 0, and the force transmitted is that which keeps them so,
///    s = −rᵀ(A x + b_u u + c F) / (rᵀb), between 0 and s_e. The mode ends in gap when
///    σ a(0) ≤ 0, in engaged when σ a(s_e) ≥ 0.
///
/// r₀ = 0 is a drive without backlash: always engaged. The rule of Kollár 2022, Eqs. (7)–(8), is
/// what becomes of this law when it is asked at the samples alone. Source of the sliding force:
/// A. F. Filippov, Differential equations with discontinuous righthand sides, 1988.
///
/// **An exact dead zone** |Δz| ≤ r₀/2 transmits nothing inside (mode 1); outside (0 and 2) the
/// command, and the stop adds k_c (Δz ∓ r₀/2) + c_c Δż between the masses. No mode slides: where
/// the plant pushes out over the edge and the command in again, the absorber bounces on it, v
/// reversing with a period of 2 |v| (1/|a(0)| + 1/|a(u)|), and damping makes |v| smaller without
/// end. Every bounce is followed, as far as SwitchCounts::accumulates. Source: S. W. Shaw, P. J.
/// Holmes, A periodically forced piecewise linear oscillator, J. Sound Vib. 90 (1983).
/// @tparam DrivenPlant  TwoMass<double> or a LinearPlant<double, N>
template <class DrivenPlant = TwoMass<double>>
class DriveContact {
 public:
  using Plant = DrivenPlant;                           ///< what the drive moves
  using State = StateOf<Plant>;                        ///< x, N × 1
  using Instant = ContactInstantOf<states_of<Plant>>;  ///< what a change depends on
  using ModeGuards = GuardsOf<states_of<Plant>>;       ///< what ends a mode

  static constexpr int modes = 3;  ///< numbered 0, 1, 2

  /// @param plant          without control and stops
  /// @param backlash       the law and its parameters
  /// @param switching      between the samples, or at them alone
  /// @param initial_state  where the motion begins, N × 1: its Δz decides which stop of an exact
  ///                       dead zone is touched; play begins engaged, σ not known yet
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

  /// How the state moves in one of the modes. The command is in force in all modes of a law at
  /// samples: it is `commanded` that leaves out what is not transmitted.
  DynamicsOf<Plant> dynamics(int mode) const {
    if (has_stop(mode))
      return dynamics_on_stop(plant_, backlash_.contact_stiffness, backlash_.contact_damping,
                              0.5 * (mode - gap) * backlash_.width);
    if (kind_ == Kind::at_samples || mode == 0) return engaged_dynamics(plant_);
    return mode == gap ? released_dynamics(plant_) : locked_dynamics(plant_);
  }
  /// The plant that the drive moves.
  const Plant& plant() const { return plant_; }
  /// The two masses whose energy bounds the motion in one of the modes; a stop is part of it.
  Plant plant(int mode) const {
    return has_stop(mode)
               ? plant_on_stop(plant_, backlash_.contact_stiffness, backlash_.contact_damping)
               : plant_;
  }
  /// How states of the plant are read.
  const PortReadings<Plant>& readings() const { return readings_; }

  /// Number of the present mode, 0 … `modes` − 1.
  int mode() const { return mode_; }
  /// Contact mode of the drive at present; of a law at samples `engaged` before the first one.
  ContactMode word() const { return word_; }
  /// Whether the command of the present sample takes effect: unless a law at samples found it not
  /// transmitted.
  bool transmits_command() const {
    return kind_ != Kind::at_samples || word_ == ContactMode::engaged;
  }
  /// u_j (N) as it goes to the drive, of a sample's command.
  double commanded(double command) const { return transmits_command() ? command : 0.0; }
  /// Force that the drive transmits (N); a stop's own force is not in it.
  double transmitted(const Instant& now) const {
    if (kind_ == Kind::at_samples) return now.command;
    if (word_ == ContactMode::engaged) return engaged_force(plant_, now);
    return word_ == ContactMode::gap ? 0.0 : -free_(now) / mobility_;
  }

  /// Whether it may change between the samples: of an exact law but play of r₀ = 0.
  bool changes_between_samples() const { return changes_between_samples_; }
  /// Guards that end the present mode between the samples: Δż while play is engaged; the way (m) to
  /// either end of the gap, or on a stop how far Δz is beyond it; in stick the accelerations that
  /// keep the sides together.
  ModeGuards guards() const {
    if (!changes_between_samples_) return {};
    if (mode_ == gap) return gap_guards();
    if (kind_ == Kind::stops) return stop_guards();
    return mode_ == 0 ? engaged_guards() : stick_guards();
  }

  /// Takes a sample: a law at samples decides on its Δz and Δż.
  void sample(const State& state) {
    if (kind_ != Kind::at_samples) return;
    const bool engaged =
        law_.step(readings_.relative_displacement(state), readings_.relative_velocity(state));
    word_ = engaged ? ContactMode::engaged : ContactMode::gap;
    mode_ = gap + law_.side();
  }
  /// The force or the command has jumped, or may have.
  void jumped(const Instant& now) {
    if (kind_ != Kind::play) return;
    if (word_ == ContactMode::stick) return leave_stick(now, 1);
    // Further zeros at a change of contact are those of the force and the command before the jump.
    zeros_ = std::min(zeros_, mode_ == gap ? 2 : 1);
  }
  /// The absorber was displaced against the conductor: stick ends, and a stop that was passed is
  /// found at once, its guard being below zero.
  void displaced() {
    if (word_ == ContactMode::stick) change_to(gap, 0);
    zeros_ = 0;
    displaced_ = true;
  }
  /// Restores what the mode keeps, without rounding: Δż = 0 and Δz in stick.
  void keep(const State& before, State& after) const {
    if (word_ == ContactMode::stick) readings_.hold_relative_position(before, after);
  }
  /// Some time has passed since the last change.
  void flowed() {
    zeros_ = 0;
    displaced_ = false;
  }
  /// The sign, ±1, that a guard has taken whose sign was not known: that of the relative velocity.
  void learn_sign(int /*guard*/, double sign) { sign_ = sign; }
  /// A guard has come to zero: the contact changes. Rounding is taken out of the state.
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

  /// The mode in which Δż = 0; −1: there is none.
  int sticking_mode() const { return kind_ == Kind::play ? stick : -1; }
  /// Whether the gap lies where the drive reversed, at Δz = g, in a mode: its surface is that of
  /// Δz − g, else that of Δż for a moving gap and of Δz for stops.
  bool is_anchored(int mode) const { return kind_ == Kind::play && mode != 0; }
  /// Whether the drive is in a gap that lies where it last reversed.
  bool remembers_gap() const { return kind_ == Kind::play && mode_ == gap; }
  /// σ of exact play; 0 before Δż was first unlike zero.
  double sign() const { return sign_; }
  /// Lower end of an exact law's gap, Δz (m); of play it has no meaning while engaged.
  double lower() const { return lower_; }
  /// Upper end likewise.
  double upper() const { return upper_; }
  /// g, the place of play's last reversal, Δz (m), where its gap begins; while engaged the one
  /// before.
  double reversal() const { return sign_ > 0.0 ? upper_ : lower_; }
  /// Play crosses the gap that began where it reversed.
  /// @param at    g (m)
  /// @param sign  ±1, σ: the gap lies below g for +1
  void cross_gap(double at, double sign) {
    sign_ = sign;
    open_gap(at);
    change_to(gap, 0);
  }
  /// Moves both ends by a displacement (m); without effect on another law.
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

  /// The zeros belong to the end of the gap at which the motion turned or came in.
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

  /// The gap ends where the drive is, at Δz = `here`, on the side of σ.
  void open_gap(double here) {
    lower_ = sign_ > 0.0 ? here - backlash_.width : here;
    upper_ = sign_ > 0.0 ? here : here + backlash_.width;
  }

  /// Beyond an end of the gap. A drive that was displaced there may move away from the end: it has
  /// dragged its far side along and is in the gap again.
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

  /// Ends stick where its condition does not hold any more; else leaves the mode as it is.
  /// @param now    the instant, under the command and the force from then on
  /// @param zeros  of the velocity where the drive engages: one where the command jumped past what
  ///               holds the sides together, two where that came to the command
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
