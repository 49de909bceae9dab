#pragma once

#include <algorithm>

#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/contact/mode_dynamics.hpp"
#include "holdfast/plant/port_readings.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// The backlash of the drive where it does not wait for the clock: the play operator of Δz as a
/// Filippov system of three modes.
///
/// With v = Δż = rᵀx and a(s) = rᵀ(A x + b s + b_u u + c F), the relative acceleration while a
/// force s is transmitted:
///
///  - engaged: the drive's force s_e is transmitted (s_e = u of an ideal drive, f x + g u of one
///  with
///    states), until v comes to zero from a sign σ. Then the gap is [Δz − r₀, Δz] for σ > 0,
///    [Δz, Δz + r₀] for σ < 0, and the next mode is stick if σ a(0) > 0 and σ a(s_e) < 0, else gap;
///  - stick: without a force the spring would push on in the old direction, with s_e it would turn
///    back. The sides stay together, v = 0, Δz is constant, and the force transmitted is that which
///    keeps them so, s = −rᵀ(A x + b_u u + c F) / (rᵀb), between 0 and s_e. The mode ends in gap
///    when σ a(0) ≤ 0, in engaged when σ a(s_e) ≥ 0;
///  - gap: no force, until Δz leaves the gap; then engaged.
///
/// r₀ = 0 is a drive without backlash: always engaged. The rule of Kollár 2022, Eqs. (7)–(8), is
/// what becomes of this law when it is asked at the samples alone. Source of the sliding force:
/// A. F. Filippov, Differential equations with discontinuous righthand sides, 1988.
/// @tparam DrivenPlant  TwoMass<double> or a LinearPlant<double, N>
template <class DrivenPlant>
class ExactBacklashOf {
 public:
  using Plant = DrivenPlant;                           ///< what the drive moves
  using State = StateOf<Plant>;                        ///< x, N × 1
  using Instant = ContactInstantOf<states_of<Plant>>;  ///< what a change depends on
  using ModeGuards = GuardsOf<states_of<Plant>>;       ///< what ends a mode

  static constexpr int modes = 3;  ///< one for each ContactMode, numbered as they are

  /// Begins engaged, σ not known yet.
  /// @param plant  without control
  /// @param width  r₀ (m), ≥ 0
  /// @throws InvalidParameter for another width, or where the plant is not admissible
  ExactBacklashOf(const Plant& plant, double width)
      : plant_(plant),
        readings_(plant),
        width_(width),
        free_(gap_acceleration(plant, released_dynamics(plant))),
        driven_(gap_acceleration(plant, engaged_dynamics(plant))),
        mobility_(gap_mobility(plant)) {
    validate(plant);
    validate_backlash_width(width);
  }

  /// How the state moves in one of the modes.
  DynamicsOf<Plant> dynamics(int mode) const {
    if (mode == index_of(ContactMode::gap)) return released_dynamics(plant_);
    if (mode == index_of(ContactMode::stick)) return locked_dynamics(plant_);
    return engaged_dynamics(plant_);
  }

  /// The plant whose energy bounds the motion in one of the modes.
  const Plant& plant(int) const { return plant_; }

  /// How states of the plant are read.
  const PortReadings<Plant>& readings() const { return readings_; }

  /// Number of the present mode, 0 … `modes` − 1.
  int mode() const { return index_of(mode_); }
  /// The present mode.
  ContactMode word() const { return mode_; }
  /// u as it goes to the drive: the contact, not the computer, decides what is transmitted.
  double commanded(double command) const { return command; }

  /// What the drive transmits (N).
  double transmitted(const Instant& now) const {
    if (mode_ == ContactMode::engaged) return engaged_force(plant_, now);
    return mode_ == ContactMode::gap ? 0.0 : -free_(now) / mobility_;
  }

  /// The guards of the present mode: Δż while engaged, none then for r₀ = 0; the way (m) to either
  /// end of the gap; in stick the accelerations that keep the sides together.
  ModeGuards guards() const {
    switch (mode_) {
      case ContactMode::engaged:
        return engaged_guards();
      case ContactMode::gap:
        return gap_guards();
      case ContactMode::stick:
        return stick_guards();
    }
    return {};
  }

  /// Takes a sample: this law does not wait for one.
  void sample(const State&) {}

  /// The force or the command has jumped, or may have.
  void jumped(const Instant& now) {
    if (mode_ == ContactMode::stick) return leave_stick(now, 1);
    // What else is zero at a change of contact is so by the force and the command before the jump.
    zeros_ = std::min(zeros_, mode_ == ContactMode::gap ? 2 : 1);
  }

  /// The absorber was displaced against the conductor.
  void displaced() {
    if (mode_ == ContactMode::stick) mode_ = ContactMode::gap;
    zeros_ = 0;
  }

  /// What the mode keeps: Δż = 0 without rounding, and Δz, in stick.
  void keep(const State& before, State& after) const {
    if (mode_ != ContactMode::stick) return;
    readings_.hold_relative_position(before, after);
  }

  /// Some time has passed since the last change.
  void flowed() { zeros_ = 0; }

  /// The sign that the relative velocity has taken, ±1.
  void learn_sign(double sign) { sign_ = sign; }

  /// A guard has come to zero: the contact changes. Rounding is taken out of the state.
  void reached(int guard, Instant& now) {
    switch (mode_) {
      case ContactMode::engaged:
        reverse(now);
        break;
      case ContactMode::gap:
        leave_gap(guard == 0 ? 1.0 : -1.0, now);
        break;
      case ContactMode::stick:
        leave_stick(now, 2);
        if (mode_ == ContactMode::stick)
          change_to(guard == 0 ? ContactMode::gap : ContactMode::engaged, guard == 0 ? 3 : 2);
    }
  }

  /// σ; 0 before Δż was first unlike zero.
  double sign() const { return sign_; }
  /// Lower end of the gap, Δz (m); has no meaning while engaged.
  double lower() const { return lower_; }
  /// Upper end of the gap, Δz (m); has no meaning while engaged.
  double upper() const { return upper_; }
  /// Whether the ends of the gap are what the contact remembers.
  bool remembers_gap() const { return mode_ == ContactMode::gap; }
  /// Moves both ends by a displacement (m).
  void shift_gap(double by) {
    lower_ += by;
    upper_ += by;
  }

 private:
  static constexpr int index_of(ContactMode mode) { return static_cast<int>(mode); }

  ModeGuards engaged_guards() const {
    ModeGuards result;
    if (!(width_ > 0.0)) return result;
    const double sign = sign_ == 0.0 ? 1.0 : sign_;
    result.guard[0] = {readings_.velocity_row() * sign, 0.0, 0.0, 0.0, zeros_, sign_ == 0.0};
    result.count = 1;
    return result;
  }

  /// The zeros belong to the end of the gap at which the motion turned.
  ModeGuards gap_guards() const {
    ModeGuards result;
    result.guard[0] = {-readings_.displacement_row(), 0.0, 0.0, upper_, sign_ > 0.0 ? zeros_ : 0};
    result.guard[1] = {readings_.displacement_row(), 0.0, 0.0, -lower_, sign_ < 0.0 ? zeros_ : 0};
    result.count = 2;
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

  void change_to(ContactMode mode, int zeros) {
    mode_ = mode;
    zeros_ = zeros;
  }

  /// The gap ends where the drive is, on the side of σ.
  void open_gap(const Instant& now) {
    const double here = readings_.relative_displacement(now.state);
    lower_ = sign_ > 0.0 ? here - width_ : here;
    upper_ = sign_ > 0.0 ? here : here + width_;
  }

  /// Beyond an end of the gap. A drive that was displaced there may move away from the end: it has
  /// dragged its far side along and is in the gap again.
  void leave_gap(double side, const Instant& now) {
    sign_ = side;
    if (side * readings_.relative_velocity(now.state) < 0.0) {
      open_gap(now);
      return change_to(ContactMode::gap, 1);
    }
    change_to(ContactMode::engaged, 0);
  }

  void reverse(Instant& now) {
    readings_.stop_relative_motion(now.state);
    open_gap(now);
    // Where one of them is zero its derivative decides: a guard of stick that begins at zero ends
    // it at once or not at all.
    const bool pushed_on = !(sign_ * free_(now) < 0.0);
    const bool turned_back = !(sign_ * driven_(now) > 0.0);
    if (pushed_on && turned_back && engaged_force(plant_, now) != 0.0)
      change_to(ContactMode::stick, 0);
    else
      change_to(ContactMode::gap, 2);
  }

  /// Ends stick where its condition does not hold any more; else leaves the mode as it is.
  /// @param now    the instant, under the command and the force from then on
  /// @param zeros  of the velocity where the drive engages: one where the command jumped past what
  ///               holds the sides together, two where that came to the command
  void leave_stick(const Instant& now, int zeros) {
    if (!(sign_ * free_(now) > 0.0))
      change_to(ContactMode::gap, zeros + 1);
    else if (!(sign_ * driven_(now) < 0.0))
      change_to(ContactMode::engaged, zeros);
  }

  Plant plant_;
  PortReadings<Plant> readings_;
  double width_;
  GapAcceleration<states_of<Plant>> free_, driven_;  // a(0) and a(s_e)
  double mobility_;                                  // rᵀb
  ContactMode mode_ = ContactMode::engaged;
  double sign_ = 0.0;
  double lower_ = 0.0, upper_ = 0.0;
  int zeros_ = 0;
};

/// That of the two masses.
using ExactBacklash = ExactBacklashOf<TwoMass<double>>;

}  // namespace holdfast
