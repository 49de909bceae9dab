#pragma once

#include "holdfast/core/types.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// Functions that read displacements and velocities from a plant's state x, and that change x.
/// @tparam Plant  plant of order N with `ports()`; the two masses have a specialisation
template <class Plant>
class PortReadings {
 public:
  using Scalar = ScalarOf<Plant>;  ///< the number type of the plant
  using State = StateOf<Plant>;    ///< state x of the plant, N × 1

  /// Constructs the readings by copying the ports.
  explicit PortReadings(const Plant& plant) : ports_(plant.ports()) {}

  /// The displacement z of the conductor at the absorber (m).
  Scalar displacement(const State& x) const { return ports_.displacement.dot(x); }
  /// The velocity ż of the conductor at the absorber (m/s).
  Scalar velocity(const State& x) const { return ports_.velocity.dot(x); }
  /// The state [z, ż, z + Δz, ż + Δż] of both sides of the gap (m, m/s, m, m/s).
  Vector<Scalar, 4> both_sides(const State& x) const {
    const Scalar displacement = ports_.displacement.dot(x), velocity = ports_.velocity.dot(x);
    return {displacement, velocity, displacement + relative_displacement(x),
            velocity + relative_velocity(x)};
  }
  /// The measured displacement (m), which the gain P multiplies.
  Scalar measured_displacement(const State& x) const { return ports_.measured_displacement.dot(x); }
  /// The measured velocity (m/s), which the gain D multiplies.
  Scalar measured_velocity(const State& x) const { return ports_.measured_velocity.dot(x); }
  /// The relative displacement Δz (m) of the absorber against the conductor.
  Scalar relative_displacement(const State& x) const { return ports_.relative_displacement.dot(x); }
  /// The relative velocity Δż (m/s) of the absorber against the conductor.
  Scalar relative_velocity(const State& x) const { return ports_.relative_velocity.dot(x); }
  /// The coefficients of Δz in the state, N × 1.
  State displacement_row() const { return ports_.relative_displacement.transpose(); }
  /// The coefficients of Δż in the state, N × 1.
  State velocity_row() const { return ports_.relative_velocity.transpose(); }

  /// Adds a displacement `by` (m) to the conductor's z by the smallest change of x (least norm).
  void displace_conductor(State& x, const Scalar& by) const {
    x += ports_.displacement.transpose() * (by / ports_.displacement.squaredNorm());
  }
  /// Sets the relative velocity Δż to zero without changing Δz.
  void stop_relative_motion(State& x) const {
    x -= ports_.velocity_lift * ports_.relative_velocity.dot(x);
  }
  /// Sets the relative velocity Δż to zero, and Δz to its value in the state `before`.
  void hold_relative_position(const State& before, State& x) const {
    x += ports_.displacement_lift * (relative_displacement(before) - relative_displacement(x));
    stop_relative_motion(x);
  }

  /// The velocities ż (m/s) of M states, the columns of an N × M matrix. @return 1 × M
  template <class Columns>
  auto velocities(const Columns& x) const {
    return RowVector<Scalar, Columns::ColsAtCompileTime>(ports_.velocity * x);
  }
  /// The measured displacements (m) of M states, the columns of an N × M matrix. @return 1 × M
  template <class Columns>
  auto measured_displacements(const Columns& x) const {
    return RowVector<Scalar, Columns::ColsAtCompileTime>(ports_.measured_displacement * x);
  }
  /// The measured velocities (m/s) of M states, the columns of an N × M matrix. @return 1 × M
  template <class Columns>
  auto measured_velocities(const Columns& x) const {
    return RowVector<Scalar, Columns::ColsAtCompileTime>(ports_.measured_velocity * x);
  }
  /// The relative displacements Δz (m) of M states, the columns of an N × M matrix. @return 1 × M
  template <class Columns>
  auto relative_displacements(const Columns& x) const {
    return RowVector<Scalar, Columns::ColsAtCompileTime>(ports_.relative_displacement * x);
  }
  /// The relative velocities Δż (m/s) of M states, the columns of an N × M matrix. @return 1 × M
  template <class Columns>
  auto relative_velocities(const Columns& x) const {
    return (ports_.relative_velocity * x).eval();
  }
  /// Sets the relative velocity Δż to zero in M states, the columns of an N × M matrix.
  template <class Columns>
  void stop_relative_motions(Columns&& x) const {
    x -= ports_.velocity_lift * (ports_.relative_velocity * x).eval();
  }

 private:
  Ports<Scalar, states_of<Plant>> ports_;
};

/// The readings of the plant of two masses, whose state is x = [z₁, ż₁, z₂, ż₂].
template <class Number>
class PortReadings<TwoMass<Number>> {
 public:
  using Scalar = Number;            ///< the number type of the plant
  using State = Vector<Number, 4>;  ///< state [z₁, ż₁, z₂, ż₂]

  /// Constructs the readings, which are the same for all plants of this type.
  PortReadings() = default;
  /// Constructs the readings, which are the same for all plants of this type.
  explicit PortReadings(const TwoMass<Number>&) {}

  /// The displacement z₁ (m) of the conductor.
  const Scalar& displacement(const State& x) const { return x[0]; }
  /// The velocity ż₁ (m/s) of the conductor.
  const Scalar& velocity(const State& x) const { return x[1]; }
  /// The state [z₁, ż₁, z₂, ż₂] of both sides of the gap: x itself.
  const State& both_sides(const State& x) const { return x; }
  /// The measured displacement z₁ (m).
  const Scalar& measured_displacement(const State& x) const { return x[0]; }
  /// The measured velocity ż₁ (m/s).
  const Scalar& measured_velocity(const State& x) const { return x[1]; }
  /// The relative displacement Δz = z₂ − z₁ (m).
  Scalar relative_displacement(const State& x) const { return holdfast::relative_displacement(x); }
  /// The relative velocity Δż = ż₂ − ż₁ (m/s).
  Scalar relative_velocity(const State& x) const { return holdfast::relative_velocity(x); }
  /// The coefficients [−1, 0, 1, 0] of Δz in the state.
  State displacement_row() const { return {Scalar(-1), Scalar(0), Scalar(1), Scalar(0)}; }
  /// The coefficients [0, −1, 0, 1] of Δż in the state.
  State velocity_row() const { return {Scalar(0), Scalar(-1), Scalar(0), Scalar(1)}; }

  /// Adds a displacement `by` (m) to the conductor's z₁.
  void displace_conductor(State& x, const Scalar& by) const { x[0] += by; }
  /// Sets the relative velocity Δż to zero, by ż₂ = ż₁.
  void stop_relative_motion(State& x) const { x[3] = x[1]; }
  /// Sets ż₂ = ż₁, and the relative displacement z₂ − z₁ to its value in the state `before`.
  void hold_relative_position(const State& before, State& x) const {
    x[2] = x[0] + relative_displacement(before);
    x[3] = x[1];
  }

  /// The velocities ż₁ (m/s) of M states, the columns of a 4 × M matrix. @return 1 × M
  template <class Columns>
  auto velocities(const Columns& x) const {
    return RowVector<Scalar, Columns::ColsAtCompileTime>(x.row(1));
  }
  /// The measured displacements z₁ (m) of M states, the columns of a 4 × M matrix. @return 1 × M
  template <class Columns>
  auto measured_displacements(const Columns& x) const {
    return RowVector<Scalar, Columns::ColsAtCompileTime>(x.row(0));
  }
  /// The measured velocities ż₁ (m/s) of M states, the columns of a 4 × M matrix. @return 1 × M
  template <class Columns>
  auto measured_velocities(const Columns& x) const {
    return RowVector<Scalar, Columns::ColsAtCompileTime>(x.row(1));
  }
  /// The relative displacements z₂ − z₁ (m) of M states, the columns of a matrix. @return 1 × M
  template <class Columns>
  auto relative_displacements(const Columns& x) const {
    return RowVector<Scalar, Columns::ColsAtCompileTime>(x.row(2) - x.row(0));
  }
  /// The relative velocities ż₂ − ż₁ (m/s) of M states, the columns of a matrix. @return 1 × M
  template <class Columns>
  auto relative_velocities(const Columns& x) const {
    return (x.row(3) - x.row(1)).eval();
  }
  /// Sets the relative velocity to zero, by ż₂ = ż₁, in M states, the columns of a 4 × M matrix.
  template <class Columns>
  void stop_relative_motions(Columns&& x) const {
    x.row(3) = x.row(1).eval();
  }
};

}  // namespace holdfast
