#pragma once

#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/plant/affine_dynamics.hpp"
#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/plant/port_readings.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// The equations of motion of a plant in one mode of its contact.
template <class Plant>
using DynamicsOf = AffineDynamicsOf<states_of<Plant>>;

/// Equations of motion with an engaged drive, whose force is f x + g u for the state x and command
/// u: ẋ = (A + b f) x + (b_u + g b) u + c F, with the matrices of LinearPlant.
template <class Plant>
DynamicsOf<Plant> engaged_dynamics(const Plant& plant) {
  const auto matrix = plant.state_matrix();
  return {matrix, plant.control_input(), plant.excitation_input(),
          StateOf<Plant>::Zero(matrix.rows())};
}

/// Equations of motion with the drive in its gap: ẋ = A x + b_u u + c F (see LinearPlant).
template <class Plant>
DynamicsOf<Plant> released_dynamics(const Plant& plant) {
  const auto& linear = linear_plant(plant);
  return {linear.released_matrix, linear.command_input, linear.excitation,
          StateOf<Plant>::Zero(linear.order())};
}

/// The equations of motion in stick. The transmitted force s keeps the relative velocity Δż = rᵀx
/// at zero; the other symbols are those of LinearPlant:
///
///     s = −rᵀ(A x + b_u u + c F) / (rᵀb),   ẋ = (I − b rᵀ/(rᵀb)) (A x + b_u u + c F)
///
/// @param plant  plant with rᵀb ≠ 0
template <int States>
AffineDynamicsOf<States> locked_dynamics(const LinearPlant<double, States>& plant) {
  const RowVector<double, States>& r = plant.ports().relative_velocity;
  const Vector<double, States> pushed = plant.force_input / r.dot(plant.force_input);
  return {plant.released_matrix - pushed * (r * plant.released_matrix),
          plant.command_input - pushed * r.dot(plant.command_input),
          plant.excitation - pushed * r.dot(plant.excitation),
          Vector<double, States>::Zero(plant.order())};
}
/// Equations of motion of the two masses in stick, moving as one body of mass m₁ + m₂.
template <class Scalar>
AffineDynamicsOf<4> locked_dynamics(const TwoMass<Scalar>& plant) {
  const Scalar mass = plant.conductor_mass + plant.absorber_mass;
  AffineDynamicsOf<4> moving{Matrix<Scalar, 4>::Zero(), Vector<Scalar, 4>::Zero(),
                             Vector<Scalar, 4>::Zero()};
  moving.state(0, 1) = moving.state(2, 1) = 1.0;
  for (const int row : {1, 3}) {
    moving.state(row, 0) = -plant.conductor_stiffness / mass;
    moving.state(row, 1) = -plant.conductor_damping / mass;
    moving.force[row] = 1.0 / mass;
  }
  return moving;
}

/// The two masses while the absorber touches a stop. The stop's stiffness (N/m) and damping (N s/m)
/// are added to k₂ and c₂ between the masses.
template <class Scalar>
TwoMass<Scalar> plant_on_stop(TwoMass<Scalar> plant, double stiffness, double damping) {
  plant.absorber_stiffness += stiffness;
  plant.absorber_damping += damping;
  return plant;
}

/// The equations of motion in contact with a stop at Δz = `at` (m). Its force k_c (Δz − at) + c_c
/// Δż has the same input b as the drive's force; k_c: `stiffness` (N/m), c_c: `damping` (N s/m).
template <int States>
AffineDynamicsOf<States> dynamics_on_stop(const LinearPlant<double, States>& plant,
                                          double stiffness, double damping, double at) {
  AffineDynamicsOf<States> pressed = engaged_dynamics(plant);
  const Ports<double, States>& ports = plant.connections;
  pressed.state += plant.force_input *
                   (stiffness * ports.relative_displacement + damping * ports.relative_velocity);
  pressed.drift = plant.force_input * (-stiffness * at);
  return pressed;
}
/// Equations of motion of two masses in contact with a stop at Δz = `at` (m), which has the given
/// stiffness (N/m) and damping (N s/m).
template <class Scalar>
AffineDynamicsOf<4> dynamics_on_stop(const TwoMass<Scalar>& plant, double stiffness, double damping,
                                     double at) {
  const TwoMass<Scalar> pressed = plant_on_stop(plant, stiffness, damping);
  return {pressed.state_matrix(), plant.control_input(), plant.excitation_input(),
          -plant.control_input() * (stiffness * at)};
}

/// The force s = f x + g u (N) of an engaged drive, for the plant's state x and the command u.
template <int States>
double engaged_force(const LinearPlant<double, States>& plant,
                     const ContactInstantOf<States>& now) {
  return plant.drive_force.dot(now.state) + plant.direct_transmission * now.command;
}
/// The force (N) that the engaged ideal drive of the two masses transmits: the command u.
template <class Scalar>
double engaged_force(const TwoMass<Scalar>&, const ContactInstantOf<4>& now) {
  return now.command;
}

/// The relative acceleration Δz̈ = state · x + command u + force F (m/s²) in one mode.
template <int States>
struct GapAcceleration {
  Vector<double, States> state;  ///< coefficients of the state x, N × 1
  double command;                ///< coefficient of the command u, per newton
  double force;                  ///< coefficient of the excitation F, per newton

  /// The relative acceleration (m/s²) at an instant.
  double operator()(const ContactInstantOf<States>& now) const {
    return state.dot(now.state) + command * now.command + force * now.force;
  }
};

/// The relative acceleration Δz̈ = rᵀẋ by given equations of motion; r: row of the relative
/// velocity Δż. The drift of `dynamics` is taken as zero.
template <class Plant>
GapAcceleration<states_of<Plant>> gap_acceleration(const Plant& plant,
                                                   const DynamicsOf<Plant>& dynamics) {
  const auto r = ports_of(plant).relative_velocity;
  return {(r * dynamics.state).transpose(), r.dot(dynamics.command), r.dot(dynamics.force)};
}

/// The relative acceleration Δz̈ per newton of the drive's force: rᵀb (1/kg), with the row r of the
/// relative velocity Δż and the input b of this force. For two masses: −1/m₁ − 1/m₂.
template <class Plant>
double gap_mobility(const Plant& plant) {
  return ports_of(plant).relative_velocity.dot(linear_plant(plant).force_input);
}

}  // namespace holdfast
