#pragma once

#include <algorithm>

#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/plant/affine_dynamics.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// The backlash of the drive where it does not wait for the clock: the play operator of Δz as a
/// Filippov system of three modes.
///
/// With r = [0, −1, 0, 1], v = rᵀz = Δż, and a(s) = rᵀ(A z + b s + c F) the relative acceleration
/// while a force s is transmitted:
///
///  - engaged: the command u is transmitted, until v comes to zero from a sign σ. Then the gap is
///    [Δz − r₀, Δz] for σ > 0, [Δz, Δz + r₀] for σ < 0, and the next mode is stick if σ a(0) > 0
///    and σ a(u) < 0, else gap;
///  - stick: without a force the spring would push on in the old direction, with u it would turn
///    back. The sides stay together, v = 0, Δz is constant, and the force transmitted is that which
///    keeps them so, s = −rᵀ(A z + c F) / (rᵀb), between 0 and u. The mode ends in gap when
///    σ a(0) ≤ 0, in engaged when σ a(u) ≥ 0;
///  - gap: no force, until Δz leaves the gap; then engaged.
///
/// r₀ = 0 is a drive without backlash: always engaged. The rule of Kollár 2022, Eqs. (7)–(8), is
/// what becomes of this law when it is asked at the samples alone. Source of the sliding force:
/// A. F. Filippov, Differential equations with discontinuous righthand sides, 1988.
class ExactBacklash {
 public:
  static constexpr int modes = 3;  ///< one for each ContactMode, numbered as they are

  /// Begins engaged, σ not known yet.
  /// @param plant  the two masses, without control
  /// @param width  r₀ (m), ≥ 0
  /// @throws InvalidParameter for another width, or where the plant is not admissible
  ExactBacklash(const TwoDof<double>& plant, double width)
      : plant_(plant),
        width_(width),
        acceleration_{
            plant.state_matrix().row(3).transpose() - plant.state_matrix().row(1).transpose(),
            plant.control_input()[3] - plant.control_input()[1],
            plant.excitation_input()[3] - plant.excitation_input()[1]} {
    validate(plant);
    validate_backlash_width(width);
  }

  /// How the state moves in one of the modes.
  AffineDynamics dynamics(int mode) const {
    AffineDynamics moving{plant_.state_matrix(), plant_.control_input(), plant_.excitation_input()};
    if (mode == index_of(ContactMode::gap)) moving.command.setZero();
    if (mode == index_of(ContactMode::stick)) moving = locked();
    return moving;
  }

  /// The plant whose energy bounds the motion in one of the modes.
  const TwoDof<double>& plant(int) const { return plant_; }

  /// Number of the present mode, 0 … `modes` − 1.
  int mode() const { return index_of(mode_); }
  /// The present mode.
  ContactMode word() const { return mode_; }
  /// u as it goes to the drive: the contact, not the computer, decides what is transmitted.
  double commanded(double command) const { return command; }

  /// What the drive transmits (N).
  double transmitted(const ContactInstant& now) const {
    if (mode_ == ContactMode::engaged) return now.command;
    return mode_ == ContactMode::gap ? 0.0 : -acceleration(now, 0.0) / acceleration_.command;
  }

  /// The guards of the present mode: Δż while engaged, none then for r₀ = 0; the way (m) to either
  /// end of the gap; in stick the accelerations that keep the sides together.
  Guards guards() const {
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
  void sample(const Vector<double, 4>&) {}

  /// The force or the command has jumped, or may have.
  void jumped(const ContactInstant& now) {
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
  void keep(const Vector<double, 4>& before, Vector<double, 4>& after) const {
    if (mode_ != ContactMode::stick) return;
    after[2] = after[0] + relative_displacement(before);
    after[3] = after[1];
  }

  /// Some time has passed since the last change.
  void flowed() { zeros_ = 0; }

  /// The sign that the relative velocity has taken, ±1.
  void learn_sign(double sign) { sign_ = sign; }

  /// A guard has come to zero: the contact changes. Rounding is taken out of the state.
  void reached(int guard, ContactInstant& now) {
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
  /// Moves both ends by a displacement (m).
  void shift_gap(double by) {
    lower_ += by;
    upper_ += by;
  }

 private:
  struct RelativeAcceleration {
    Vector<double, 4> state;
    double command, force;
  };

  static constexpr int index_of(ContactMode mode) { return static_cast<int>(mode); }

  /// a(s).
  double acceleration(const ContactInstant& now, double transmitted_force) const {
    return acceleration_.state.dot(now.state) + acceleration_.command * transmitted_force +
           acceleration_.force * now.force;
  }

  /// Both masses move as one: the internal forces drop out of m₁ + m₂.
  AffineDynamics locked() const {
    const double mass = plant_.conductor_mass + plant_.absorber_mass;
    AffineDynamics moving{Matrix<double, 4>::Zero(), Vector<double, 4>::Zero(),
                          Vector<double, 4>::Zero()};
    moving.state(0, 1) = moving.state(2, 1) = 1.0;
    for (const int row : {1, 3}) {
      moving.state(row, 0) = -plant_.conductor_stiffness / mass;
      moving.state(row, 1) = -plant_.conductor_damping / mass;
      moving.force[row] = 1.0 / mass;
    }
    return moving;
  }

  Guards engaged_guards() const {
    Guards result;
    if (!(width_ > 0.0)) return result;
    const double sign = sign_ == 0.0 ? 1.0 : sign_;
    result.guard[0] = {velocity_row() * sign, 0.0, 0.0, 0.0, zeros_, sign_ == 0.0};
    result.count = 1;
    return result;
  }

  /// The zeros belong to the end of the gap at which the motion turned.
  Guards gap_guards() const {
    Guards result;
    result.guard[0] = {-displacement_row(), 0.0, 0.0, upper_, sign_ > 0.0 ? zeros_ : 0};
    result.guard[1] = {displacement_row(), 0.0, 0.0, -lower_, sign_ < 0.0 ? zeros_ : 0};
    result.count = 2;
    return result;
  }

  Guards stick_guards() const {
    Guards result;
    const auto& a = acceleration_;
    result.guard[0] = {a.state * sign_, 0.0, a.force * sign_, 0.0};
    result.guard[1] = {-a.state * sign_, -a.command * sign_, -a.force * sign_, 0.0};
    result.count = 2;
    return result;
  }

  void change_to(ContactMode mode, int zeros) {
    mode_ = mode;
    zeros_ = zeros;
  }

  /// The gap ends where the drive is, on the side of σ.
  void open_gap(const ContactInstant& now) {
    const double here = relative_displacement(now.state);
    lower_ = sign_ > 0.0 ? here - width_ : here;
    upper_ = sign_ > 0.0 ? here : here + width_;
  }

  /// Beyond an end of the gap. A drive that was displaced there may move away from the end: it has
  /// dragged its far side along and is in the gap again.
  void leave_gap(double side, const ContactInstant& now) {
    sign_ = side;
    if (side * relative_velocity(now.state) < 0.0) {
      open_gap(now);
      return change_to(ContactMode::gap, 1);
    }
    change_to(ContactMode::engaged, 0);
  }

  void reverse(ContactInstant& now) {
    now.state[3] = now.state[1];
    open_gap(now);
    // Where one of them is zero its derivative decides: a guard of stick that begins at zero ends
    // it at once or not at all.
    const bool pushed_on = !(sign_ * acceleration(now, 0.0) < 0.0);
    const bool turned_back = !(sign_ * acceleration(now, now.command) > 0.0);
    if (pushed_on && turned_back && now.command != 0.0)
      change_to(ContactMode::stick, 0);
    else
      change_to(ContactMode::gap, 2);
  }

  /// Ends stick where its condition does not hold any more; else leaves the mode as it is.
  /// @param now    the instant, under the command and the force from then on
  /// @param zeros  of the velocity where the drive engages: one where the command jumped past what
  ///               holds the sides together, two where that came to the command
  void leave_stick(const ContactInstant& now, int zeros) {
    if (!(sign_ * acceleration(now, 0.0) > 0.0))
      change_to(ContactMode::gap, zeros + 1);
    else if (!(sign_ * acceleration(now, now.command) < 0.0))
      change_to(ContactMode::engaged, zeros);
  }

  TwoDof<double> plant_;
  double width_;
  RelativeAcceleration acceleration_;
  ContactMode mode_ = ContactMode::engaged;
  double sign_ = 0.0;
  double lower_ = 0.0, upper_ = 0.0;
  int zeros_ = 0;
};

}  // namespace holdfast
