#pragma once

#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/contact/mode_dynamics.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/plant/port_readings.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// A dead zone |Δz| ≤ r₀/2 that is left and entered between the samples.
///
/// Inside no force is transmitted; outside the command is, and the stop adds
/// k_c (Δz ∓ r₀/2) + c_c Δż between the masses. Source: S. W. Shaw, P. J. Holmes, A periodically
/// forced piecewise linear oscillator, J. Sound Vib. 90 (1983).
///
/// The force depends on a displacement, so that no mode slides: where the plant pushes out over the
/// edge and the command pushes in again, the absorber bounces on it, v = Δż reversing with a period
/// of 2 |v| (1/|a(0)| + 1/|a(u)|), and damping makes |v| smaller without end but not zero in any
/// finite time. Every bounce is followed, as far as SwitchCounts::accumulates.
/// @tparam DrivenPlant  TwoMass<double> or a LinearPlant<double, N>
template <class DrivenPlant>
class ExactDeadZoneOf {
 public:
  using Plant = DrivenPlant;                           ///< what the drive moves
  using State = StateOf<Plant>;                        ///< x, N × 1
  using Instant = ContactInstantOf<states_of<Plant>>;  ///< what a change depends on
  using ModeGuards = GuardsOf<states_of<Plant>>;       ///< what ends a mode

  static constexpr int modes = 3;  ///< on the lower stop, between the stops, on the upper one

  /// @param plant      without control and stops
  /// @param width      r₀ (m), ≥ 0
  /// @param stiffness  k_c (N/m), ≥ 0
  /// @param damping    c_c (N s/m), ≥ 0
  /// @param state      where the motion begins, N × 1: its Δz decides which stop is touched
  /// @throws InvalidParameter where one of them, or the plant, is not admissible
  ExactDeadZoneOf(const Plant& plant, double width, double stiffness, double damping,
                  const State& state)
      : plant_(plant),
        readings_(plant),
        half_width_(0.5 * width),
        stiffness_(stiffness),
        damping_(damping) {
    validate(plant);
    require_non_negative("backlash width r0", width, "m");
    require_non_negative("contact stiffness", stiffness, "N/m");
    require_non_negative("contact damping", damping, "N s/m");
    find_side(state);
  }

  /// How the state moves in one of the modes: on a stop with its spring and damper, between the
  /// stops without the command.
  DynamicsOf<Plant> dynamics(int mode) const {
    if (mode != inside)
      return dynamics_on_stop(plant_, stiffness_, damping_, (mode - inside) * half_width_);
    return released_dynamics(plant_);
  }
  /// The two masses whose energy bounds the motion in one of the modes; on a stop that is part of
  /// it.
  Plant plant(int mode) const {
    return mode == inside ? plant_ : plant_on_stop(plant_, stiffness_, damping_);
  }

  /// How states of the plant are read.
  const PortReadings<Plant>& readings() const { return readings_; }

  /// Number of the present mode, 0 … `modes` − 1.
  int mode() const { return mode_; }
  /// `gap` between the stops, `engaged` on either.
  ContactMode word() const { return mode_ == inside ? ContactMode::gap : ContactMode::engaged; }
  /// u as it goes to the drive: the contact, not the computer, decides what is transmitted.
  double commanded(double command) const { return command; }
  /// What the drive transmits of the command (N); the stop's own force is not in it.
  double transmitted(const Instant& now) const {
    return mode_ == inside ? 0.0 : engaged_force(plant_, now);
  }

  /// The way (m) to either stop; on a stop, how far Δz is beyond its end of the gap.
  ModeGuards guards() const {
    ModeGuards result;
    if (mode_ != inside) {
      const double side = mode_ - inside;
      result.guard[0] = {readings_.displacement_row() * side, 0.0, 0.0, -half_width_, zeros_};
      result.count = 1;
      return result;
    }
    result.guard[0] = {-readings_.displacement_row(), 0.0, 0.0, half_width_,
                       left_ > inside ? zeros_ : 0};
    result.guard[1] = {readings_.displacement_row(), 0.0, 0.0, half_width_,
                       left_ < inside ? zeros_ : 0};
    result.count = 2;
    return result;
  }

  /// Takes a sample: this law does not wait for one.
  void sample(const State&) {}
  /// The force or the command has jumped, or may have: Δz has not, and nothing changes.
  void jumped(const Instant&) {}
  /// The contact stays what it was; a stop that was passed is found at once, its guard being below
  /// zero.
  void displaced() {
    zeros_ = 0;
    displaced_ = true;
  }
  /// What the mode keeps of the state: nothing.
  void keep(const State&, State&) const {}
  /// Some time has passed since the last change.
  void flowed() {
    zeros_ = 0;
    displaced_ = false;
  }
  /// Never called: the signs of the guards are known.
  void learn_sign(double) {}

  /// A guard has come to zero: a stop is met or left. The state stays as it is.
  void reached(int guard, Instant&) {
    left_ = mode_;
    mode_ = mode_ != inside ? inside : guard == 0 ? inside + 1 : inside - 1;
    zeros_ = displaced_ ? 0 : 1;  // it may lie far beyond the end
  }

 private:
  static constexpr int inside = 1;  // 0 and 2: on the lower and on the upper stop

  void find_side(const State& state) {
    const double here = readings_.relative_displacement(state);
    mode_ = here > half_width_ ? inside + 1 : here < -half_width_ ? inside - 1 : inside;
  }

  Plant plant_;
  PortReadings<Plant> readings_;
  double half_width_, stiffness_, damping_;
  int mode_ = inside;
  int left_ = inside;
  int zeros_ = 0;
  bool displaced_ = false;
};

/// That of the two masses.
using ExactDeadZone = ExactDeadZoneOf<TwoMass<double>>;

}  // namespace holdfast
