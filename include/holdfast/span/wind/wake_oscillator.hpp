#pragma once

#include <Eigen/Core>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/span/wind/turbulent_wind.hpp"

namespace holdfast {

/// The wake oscillator coupled to its cylinder (Facchinetti, de Langre & Biolley, J. Fluids Struct.
/// 19 (2004) 123–140), with the lift variable q = 2 C_L/C_L0:
///
///     q̈ + ε ω_s (q² − 1) q̇ + ω_s² q = (A/d) ÿ,   ω_s = 2π St U/d
///     (μ + C_M ρ π d²/4) ÿ + … + γ ρ d² ω_s ẏ = ¼ ρ U² d C_L0 q   (N/m)
///
/// with all terms of the article: coupling by acceleration, stall as a fluid damping, and the added
/// mass. ε and A were fitted by its authors to forced cylinders; nothing is fitted here. St belongs
/// to the setting, 0.2 in the article. The model is two-dimensional: wakes at different places
/// interact by the span's motion only.
struct WakeOscillatorLaw {
  double coupling = 12.0;         ///< A, ≥ 0
  double nonlinearity = 0.3;      ///< ε, > 0
  double lift_coefficient = 0.3;  ///< C_L0 of a fixed cylinder, ≥ 0
  double stall = 0.8;             ///< γ = C_D/(4π St), ≥ 0
  double added_mass = 1.0;        ///< C_M, ≥ 0
  double fluid_density = 1.225;   ///< ρ (kg/m³), > 0

  /// The added mass C_M ρ π d²/4 (kg/m).
  double added_mass_per_length(double diameter) const {
    return added_mass * fluid_density * pi<double> * diameter * diameter / 4.0;
  }
  /// The damping ratio ζ of a mode by stall: γ ρ d² ω_s/(2 m ω).
  /// @param diameter         d (m)
  /// @param mass_per_length  m (kg/m), with the added mass
  /// @param shedding         ω_s (rad/s)
  /// @param angular_frequency ω of the mode (rad/s)
  double stall_damping(double diameter, double mass_per_length, double shedding,
                       double angular_frequency) const {
    return stall * fluid_density * diameter * diameter * shedding /
           (2.0 * mass_per_length * angular_frequency);
  }
};

/// Rejects a law outside the ranges stated at its members.
/// @throws InvalidParameter naming the first member that is not admissible
inline void validate(const WakeOscillatorLaw& law) {
  require_non_negative("coupling A of the wake", law.coupling, "");
  require_positive("nonlinearity epsilon of the wake", law.nonlinearity, "");
  require_non_negative("lift coefficient C_L0", law.lift_coefficient, "");
  require_non_negative("stall parameter gamma", law.stall, "");
  require_non_negative("added mass coefficient C_M", law.added_mass, "");
  require_positive("density of the fluid", law.fluid_density, "kg/m^3");
}

/// The wakes at the stations of a span. With p = q̇ − (A/d) ẏ the acceleration of the span is not
/// needed:
///
///     q̇ = p + (A/d) ẏ,   ṗ = −ε ω_s (q² − 1) q̇ − ω_s² q
///
/// A step uses ẏ at its middle. It consists of half a step of q, a whole step of p by the
/// trapezoidal rule at this q, and half a step of q: of second order, stable for any q. Without
/// correction the wake's frequency would be too high by (ω_s h)²/24. In the restoring term ω_s² is
/// therefore replaced by (4/h²) sin²(ω_s h/2), so that the frequency is St U/d to within 10⁻⁵.
template <class Scalar = double>
class WakeOscillators {
 public:
  using Column = Eigen::Array<Scalar, Eigen::Dynamic, 1>;  ///< one number for each station

  /// Starts from lifts of random size and phase, about a twentieth of a fixed cylinder's lift.
  /// @param law       law that passed `validate`
  /// @param diameter  d (m)
  /// @param strouhal  St
  /// @param stations  number of stations
  /// @param wind      wind with its mean speed and seed
  WakeOscillators(const WakeOscillatorLaw& law, double diameter, double strouhal, int stations,
                  const TurbulentWind& wind)
      : coupling_(law.coupling / diameter),
        nonlinearity_(law.nonlinearity),
        turn_(2.0 * pi<double> * strouhal / diameter),
        pressure_(0.25 * law.fluid_density * diameter * law.lift_coefficient),
        q_(stations),
        p_(stations) {
    NormalNumbers numbers(~wind.seed);
    for (Eigen::Index j = 0; j < q_.size(); ++j) {
      q_[j] = Scalar(0.1 * numbers.next());
      p_[j] = Scalar(0.1 * turn_ * wind.mean_speed * numbers.next());
    }
  }

  /// Performs one step h of all wakes.
  /// @param velocities  ẏ (m/s) in the middle of the step
  /// @param speeds      U (m/s) at the stations
  /// @param step        h (s)
  void step(const Column& velocities, const Column& speeds, double step) {
    const Scalar half(0.5 * step);
    moved_ = Scalar(coupling_) * velocities;
    shedding_ = Scalar(turn_) * speeds;
    q_ += half * (p_ + moved_);
    damping_ = half * Scalar(nonlinearity_) * shedding_ * (q_.square() - Scalar(1));
    turned_ = (Scalar(step) * shedding_).square();
    turned_ *= Scalar(1) - turned_ * (Scalar(1) - turned_ / Scalar(30)) / Scalar(12);
    p_ = ((p_ + moved_) * (Scalar(1) - damping_) - Scalar(1 / step) * turned_ * q_) /
             (Scalar(1) + damping_) -
         moved_;
    q_ += half * (p_ + moved_);
  }

  /// Writes the lift force ¼ ρ U² d C_L0 q (N/m) of each wake to `force`.
  void lift(const Column& speeds, Column& force) const {
    force = Scalar(pressure_) * speeds.square() * q_;
  }

 private:
  double coupling_, nonlinearity_, turn_, pressure_;
  Column q_, p_, moved_, shedding_, turned_, damping_;
};

}  // namespace holdfast
