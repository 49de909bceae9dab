#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "holdfast/cable/elements.hpp"
#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/excitation/harmonic_input.hpp"
#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/plant/port_readings.hpp"
#include "holdfast/sundials/cvode.hpp"

namespace holdfast::cvode {

/// The controller, drive and excitation of a cable modelled by finite elements.
struct ElementsLoop {
  Sampling<double> sampling;              ///< sampling period τ (s), > 0; delay δ (s), 0 … τ
  PdGains<double> gains;                  ///< controller gains P (N/m) and D (N s/m)
  HarmonicExcitation<double> excitation;  ///< amplitude (N), frequency (Hz): cable at the absorber
  double backlash_width = 0.0;            ///< width r₀ (m) of the backlash, ≥ 0
  ForceHold hold = ForceHold::sampled;    ///< excitation held between samples, or exact
};

/// The motion of a nonlinear cable, modelled by finite elements, and of the absorber on its spring.
/// The sampled drive with its backlash acts between cable and absorber. The model includes large
/// sag, large motion and waves, and serves as reference for models with fewer states.
///
/// As in `SampledMotion`, `sense()` decides at t_j on the contact and the drive's force u_j, and
/// `advance()` moves to t_{j+1}. CVODE is restarted at each jump of a force. Work per sample: some
/// tens of BDF steps, each linear in the number of elements.
class ElementsMotion {
 public:
  static constexpr int states = 4;  ///< number of entries of State
  using State = Vector<double, 4>;  ///< [z, ż, z₂, ż₂] of state() (m, m/s, m, m/s)
  using Readings = PortReadings<TwoMass<double>>;  ///< type of `readings()`

  /// @param cable       cable with the absorber as a spring–mass; must outlive this object
  /// @param loop        controller, drive and excitation
  /// @param start       initial state of cable and absorber, such as `cable.held_by(force).state`
  /// @param tolerances  tolerances of the local error per step, and the limit of steps
  /// @throws InvalidParameter for no spring–mass absorber, or τ, δ, r₀ or a tolerance out of range
  ElementsMotion(const CableElements& cable, const ElementsLoop& loop, const Eigen::VectorXd& start,
                 const Tolerances& tolerances = {})
      : loop_(loop),
        law_(loop.backlash_width),
        system_{cable, loop.excitation.angular_frequency()},
        integrator_(system_, start, tolerances) {
    require_positive("sampling period tau", loop.sampling.period, "s");
    require_within("processing delay", loop.sampling.processing_delay, "s", 0.0,
                   loop.sampling.period);
    require_non_negative("backlash width r0", loop.backlash_width, "m");
    if (!cable.is_sprung())
      throw InvalidParameter("reading of the absorber", 0.0, "", "AbsorberReading::spring_mass");
    system_.amplitude = loop.hold == ForceHold::exact ? loop.excitation.amplitude : 0.0;
  }

  /// Takes sample j and decides on the contact and the drive's force u_j; call it once per sample.
  MotionSample<double> sense() {
    const State seen = state();
    const bool engaged = law_.step(seen[2] - seen[0], seen[3] - seen[1]);
    present_force_ =
        engaged ? loop_.gains.proportional * seen[0] + loop_.gains.differential * seen[1] : 0.0;
    return {index_, time(), seen, present_force_, engaged};
  }

  /// Integrates from t_j to t_{j+1}, with the drive's force u_{j−1} until t_j + δ, then with u_j.
  /// Call it once after each `sense()`, and only while `outcome()` is `completed`.
  void advance() {
    const double begin = time(), late = loop_.sampling.processing_delay;
    if (loop_.hold == ForceHold::sampled)
      system_.held = loop_.excitation.amplitude * std::cos(system_.angular_frequency * begin);
    if (late > 0.0) move(previous_force_, begin + late);
    ++index_;
    if (late < loop_.sampling.period) move(present_force_, time());
    previous_force_ = present_force_;
  }

  /// Index j of the present sample; `advance()` increments it.
  std::int64_t index() const { return index_; }
  /// Time t_j (s) of sample j.
  double time() const { return static_cast<double>(index_) * loop_.sampling.period; }
  /// State [z, ż, z₂, ż₂] (m, m/s, m, m/s) at the instant last reached: drops from the equilibrium
  /// and velocities of the cable at the absorber (z) and of the absorber (z₂), downward positive.
  State state() const { return system_.cable.at_absorber(integrator_.state()); }
  /// Functions that read displacements and velocities from a State.
  Readings readings() const { return {}; }
  /// `completed` while CVODE has not failed and all bars are in tension; else why it ended.
  IntegrationOutcome outcome() const { return integrator_.outcome(); }
  /// Name of CVODE's return flag, and its message, if it ended the integration; else empty.
  const std::string& words() const { return integrator_.words(); }
  /// Numbers of steps and evaluations since CVODE's last restart, at a jump of a force.
  IntegrationCost cost() const { return integrator_.cost(); }

 private:
  /// Differential equations of the cable's elements with the forces of drive and excitation.
  struct System {
    const CableElements& cable;
    double angular_frequency;
    double amplitude = 0.0, held = 0.0, drive = 0.0;

    int states() const { return cable.states(); }
    int half_bandwidth() const { return cable.half_bandwidth(); }
    double margin(const double* state) const { return cable.margin(state); }
    template <class Set>
    void jacobian(const double* state, Set&& set) const {
      cable.jacobian(state, set);
    }
    void rate(double time, const double* state, double* rate_of_state) const {
      cable.rate(state, rate_of_state);
      const double force = held + amplitude * std::cos(angular_frequency * time);
      cable.push(rate_of_state, force + drive, -drive);
    }
  };

  void move(double drive, double to) {
    constexpr double unresolved = 8.0 * std::numeric_limits<double>::epsilon();
    if (!(to - integrator_.time() > unresolved * to)) return;
    system_.drive = drive;
    integrator_.restart();
    integrator_.advance_to(to);
  }

  ElementsLoop loop_;
  Backlash<double> law_;
  System system_;
  Integrator<System> integrator_;
  double present_force_ = 0.0, previous_force_ = 0.0;
  std::int64_t index_ = 0;
};

}  // namespace holdfast::cvode
