#pragma once

#include "holdfast/core/types.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// Reads the states of a plant of order N through its ports, and moves them there.
/// @tparam Plant  with `ports()`; the two masses have their own readings, by subscripts
template <class Plant>
class PortReadings {
 public:
  using Scalar = ScalarOf<Plant>;  ///< the number type of the plant
  using State = StateOf<Plant>;    ///< x, N × 1

  /// Copies the ports.
  explicit PortReadings(const Plant& plant) : ports_(plant.ports()) {}

  /// z of the conductor at the absorber (m).
  Scalar displacement(const State& x) const { return ports_.displacement.dot(x); }
  /// ż there (m/s).
  Scalar velocity(const State& x) const { return ports_.velocity.dot(x); }
  /// [z, ż, z + Δz, ż + Δż], both sides of the gap (m, m/s, m, m/s).
  Vector<Scalar, 4> both_sides(const State& x) const {
    const Scalar displacement = ports_.displacement.dot(x), velocity = ports_.velocity.dot(x);
    return {displacement, velocity, displacement + relative_displacement(x),
            velocity + relative_velocity(x)};
  }
  /// Measured displacement, which P multiplies (m).
  Scalar measured_displacement(const State& x) const { return ports_.measured_displacement.dot(x); }
  /// Measured velocity, which D multiplies (m/s).
  Scalar measured_velocity(const State& x) const { return ports_.measured_velocity.dot(x); }
  /// Δz (m).
  Scalar relative_displacement(const State& x) const { return ports_.relative_displacement.dot(x); }
  /// Δż (m/s).
  Scalar relative_velocity(const State& x) const { return ports_.relative_velocity.dot(x); }
  /// Δz as a functional of the state, N × 1.
  State displacement_row() const { return ports_.relative_displacement.transpose(); }
  /// Δż as a functional of the state, N × 1.
  State velocity_row() const { return ports_.relative_velocity.transpose(); }

  /// Adds a displacement (m) to the conductor's z: the least change of the state that does so.
  void displace_conductor(State& x, const Scalar& by) const {
    x += ports_.displacement.transpose() * (by / ports_.displacement.squaredNorm());
  }
  /// Makes Δż zero, Δz as it is.
  void stop_relative_motion(State& x) const {
    x -= ports_.velocity_lift * ports_.relative_velocity.dot(x);
  }
  /// Makes Δż zero, and Δz what it was before.
  void hold_relative_position(const State& before, State& x) const {
    x += ports_.displacement_lift * (relative_displacement(before) - relative_displacement(x));
    stop_relative_motion(x);
  }

  /// ż of states as columns of a matrix, N × M. @return 1 × M
  template <class Columns>
  auto velocities(const Columns& x) const {
    return RowVector<Scalar, Columns::ColsAtCompileTime>(ports_.velocity * x);
  }
  /// Measured displacements of deviations, the columns of an N × M matrix. @return 1 × M
  template <class Columns>
  auto measured_displacements(const Columns& x) const {
    return RowVector<Scalar, Columns::ColsAtCompileTime>(ports_.measured_displacement * x);
  }
  /// Measured velocities of deviations likewise.
  template <class Columns>
  auto measured_velocities(const Columns& x) const {
    return RowVector<Scalar, Columns::ColsAtCompileTime>(ports_.measured_velocity * x);
  }
  /// Δz, of deviations likewise.
  template <class Columns>
  auto relative_displacements(const Columns& x) const {
    return RowVector<Scalar, Columns::ColsAtCompileTime>(ports_.relative_displacement * x);
  }
  /// Δż, of deviations likewise.
  template <class Columns>
  auto relative_velocities(const Columns& x) const {
    return (ports_.relative_velocity * x).eval();
  }
  /// Makes Δż zero of deviations likewise.
  template <class Columns>
  void stop_relative_motions(Columns&& x) const {
    x -= ports_.velocity_lift * (ports_.relative_velocity * x).eval();
  }

 private:
  Ports<Scalar, states_of<Plant>> ports_;
};

/// Readings of the two masses.
template <class Number>
class PortReadings<TwoMass<Number>> {
 public:
  using Scalar = Number;            ///< the number type of the plant
  using State = Vector<Number, 4>;  ///< [z₁, ż₁, z₂, ż₂]

  /// All plants of this type have the same readings.
  PortReadings() = default;
  /// The same.
  explicit PortReadings(const TwoMass<Number>&) {}

  /// z₁ (m).
  const Scalar& displacement(const State& x) const { return x[0]; }
  /// ż₁ (m/s).
  const Scalar& velocity(const State& x) const { return x[1]; }
  /// x itself.
  const State& both_sides(const State& x) const { return x; }
  /// z₁ (m).
  const Scalar& measured_displacement(const State& x) const { return x[0]; }
  /// ż₁ (m/s).
  const Scalar& measured_velocity(const State& x) const { return x[1]; }
  /// Δz = z₂ − z₁ (m).
  Scalar relative_displacement(const State& x) const { return holdfast::relative_displacement(x); }
  /// Δż = ż₂ − ż₁ (m/s).
  Scalar relative_velocity(const State& x) const { return holdfast::relative_velocity(x); }
  /// [−1, 0, 1, 0].
  State displacement_row() const { return {Scalar(-1), Scalar(0), Scalar(1), Scalar(0)}; }
  /// [0, −1, 0, 1].
  State velocity_row() const { return {Scalar(0), Scalar(-1), Scalar(0), Scalar(1)}; }

  /// Adds a displacement (m) to z₁.
  void displace_conductor(State& x, const Scalar& by) const { x[0] += by; }
  /// ż₂ = ż₁.
  void stop_relative_motion(State& x) const { x[3] = x[1]; }
  /// ż₂ = ż₁, and z₂ − z₁ what it was before.
  void hold_relative_position(const State& before, State& x) const {
    x[2] = x[0] + relative_displacement(before);
    x[3] = x[1];
  }

  /// The second row of a matrix whose columns are states, 4 × M. @return 1 × M
  template <class Columns>
  auto velocities(const Columns& x) const {
    return RowVector<Scalar, Columns::ColsAtCompileTime>(x.row(1));
  }
  /// The first row of a matrix whose columns are deviations of the state, 4 × M. @return 1 × M
  template <class Columns>
  auto measured_displacements(const Columns& x) const {
    return RowVector<Scalar, Columns::ColsAtCompileTime>(x.row(0));
  }
  /// Its second row.
  template <class Columns>
  auto measured_velocities(const Columns& x) const {
    return RowVector<Scalar, Columns::ColsAtCompileTime>(x.row(1));
  }
  /// Its third row less the first.
  template <class Columns>
  auto relative_displacements(const Columns& x) const {
    return RowVector<Scalar, Columns::ColsAtCompileTime>(x.row(2) - x.row(0));
  }
  /// Its last row less the second.
  template <class Columns>
  auto relative_velocities(const Columns& x) const {
    return (x.row(3) - x.row(1)).eval();
  }
  /// Makes the last row the second.
  template <class Columns>
  void stop_relative_motions(Columns&& x) const {
    x.row(3) = x.row(1).eval();
  }
};

}  // namespace holdfast
