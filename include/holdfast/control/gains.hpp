#pragma once

#include <type_traits>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// The readings that a controller receives at sample j.
struct ControlSample {
  double displacement;  ///< displacement z₁ (m); for a LinearPlant the reading of its ports
  double velocity;      ///< velocity ż₁ (m/s); for a LinearPlant the reading of its ports
  double elapsed;       ///< time h_j (s) since the previous sample; τ at the first sample
};

/// The gains of the proportional–differential law u = P z₁ + D ż₁. The class is also a controller
/// without states (control/controlled_plant.hpp).
/// Source: Kollár 2022, Eq. (5) and Eq. (11), whose row matrix D is [P, D, 0, 0].
template <class Scalar>
struct PdGains {
  static_assert(is_real<Scalar>, "a gain is a real number: PdGains<double>");
  static constexpr int states = 0;  ///< number M of states of the controller
  Scalar proportional = Scalar(0);  ///< proportional gain P (N/m), finite
  Scalar differential = Scalar(0);  ///< differential gain D (N s/m), finite

  /// The feedback row K = [P, D, 0, 0], 1 × 4: u = K z for the state z of the two masses.
  RowVector<Scalar, 4> feedback_row() const {
    return {proportional, differential, Scalar(0), Scalar(0)};
  }

  /// The command u_j = P z₁ + D ż₁ (N) of a sample.
  Scalar command(const ControlSample& sample, const Vector<Scalar, 0>&) const {
    return proportional * sample.displacement + differential * sample.velocity;
  }
  /// Jacobian [P, D] of the command by the displacement and the velocity.
  RowVector<Scalar, 2> derivative(const ControlSample&, const Vector<Scalar, 0>&) const {
    return {proportional, differential};
  }
};

/// Validates the gains. @throws InvalidParameter unless both are finite
inline void validate(const PdGains<double>& gains) {
  require_finite("proportional gain P", gains.proportional, "N/m");
  require_finite("differential gain D", gains.differential, "N s/m");
}

/// The proportional gain P = k₂ − m₂ ω² that tunes the absorber to the excitation.
/// Source: Kollár 2022, Eq. (6).
/// @param absorber_stiffness  stiffness k₂ (N/m), > 0
/// @param absorber_mass       mass m₂ (kg), > 0
/// @param frequency           excitation frequency f = ω / 2π (Hz), > 0
/// @return P (N/m); negative above the absorber's natural frequency √(k₂/m₂)/2π
/// @throws InvalidParameter where an argument is outside its range
template <class Scalar>
Scalar tuned_proportional_gain(const Scalar& absorber_stiffness, const Scalar& absorber_mass,
                               const Scalar& frequency) {
  if constexpr (std::is_floating_point_v<Scalar>) {
    require_positive("absorber stiffness k2", static_cast<double>(absorber_stiffness), "N/m");
    require_positive("absorber mass m2", static_cast<double>(absorber_mass), "kg");
    require_positive("frequency", static_cast<double>(frequency), "Hz");
  }
  const Scalar angular_frequency = Scalar(2) * pi<Scalar> * frequency;
  return absorber_stiffness - absorber_mass * angular_frequency * angular_frequency;
}

}  // namespace holdfast
