#pragma once

#include <cmath>
#include <type_traits>
#include <utility>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// A linear plant with N states x: a conductor with an absorber and a drive that has backlash.
///
///     ẋ = A x + b s + b_u u + c F,    s = f x + g u  where the drive transmits,  s = 0 in the gap
///
/// u (N) is the computer's command, F (N) the excitation, and s (N) the drive's force on conductor
/// and absorber. An ideal drive has s = u (f = 0, g = 1, b_u = 0). A drive with a lag adds states:
/// their input is b_u u, and s = f x. The state x may be in any coordinates, as the ports give the
/// measured quantities and the relative motion at the gap as functions of x.
/// @tparam States  N; Eigen::Dynamic where it is known at run time only
template <class Number, int States = Eigen::Dynamic>
struct LinearPlant {
  static_assert(is_real<Number>, "the numbers of a plant are real: LinearPlant<double>");

  Matrix<Number, States> released_matrix;  ///< matrix A, N × N (1/s), without transmitted force
  Vector<Number, States> force_input;      ///< column b (N × 1): rate of the state per newton of s
  Vector<Number, States> command_input;    ///< column b_u (N × 1), per newton of u; 0: ideal drive
  Vector<Number, States> excitation;       ///< column c (N × 1), per newton of the excitation F
  RowVector<Number, States> drive_force;   ///< row f (1 × N): s = f x + g u; 0 for an ideal drive
  Number direct_transmission{1};           ///< factor g of u in s: 1: ideal drive, 0: with a lag
  Ports<Number, States> connections;       ///< measured quantities and relative motion at the gap

  /// The state matrix A + b f where the drive transmits, N × N (1/s). @throws InvalidParameter
  /// for parts of different sizes, as do control_input(), excitation_input() and ports()
  Matrix<Number, States> state_matrix() const {
    require_one_order();
    return released_matrix + force_input * drive_force;
  }
  /// The input b_u + g b of the command u where the drive transmits, N × 1 per newton of u.
  Vector<Number, States> control_input() const {
    require_one_order();
    return command_input + direct_transmission * force_input;
  }
  /// The input c of the excitation, N × 1 per newton of F.
  const Vector<Number, States>& excitation_input() const {
    require_one_order();
    return excitation;
  }
  /// The rows that read the measured quantities and the relative motion at the gap.
  const Ports<Number, States>& ports() const {
    require_one_order();
    return connections;
  }
  /// The order N: the number of states.
  Eigen::Index order() const { return released_matrix.rows(); }

  /// Rejects a plant whose parts have different orders; does nothing where N is a fixed size.
  /// @throws InvalidParameter unless A is N × N, N ≥ 1, and all other parts have length N
  void require_one_order() const {
    if constexpr (States == Eigen::Dynamic) {
      const Eigen::Index n = order();
      const auto fits = [n](const auto&... of) { return ((of.size() == n) && ...); };
      if (n >= 1 && released_matrix.cols() == n && connections.are_of(n) &&
          fits(force_input, command_input, excitation, drive_force))
        return;
      throw InvalidParameter("order of the plant", static_cast<double>(n), "",
                             "the same for all its matrices and ports, and at least 1");
    }
  }
};

/// The two masses as a plant of order 4, x = [z₁, ż₁, z₂, ż₂].
/// @throws InvalidParameter where the masses are not admissible
template <class Scalar>
LinearPlant<Scalar, 4> linear_plant(const TwoMass<Scalar>& plant) {
  detail::require_admissible(plant);
  return {plant.state_matrix(),     plant.control_input(),        Vector<Scalar, 4>::Zero(),
          plant.excitation_input(), RowVector<Scalar, 4>::Zero(), Scalar(1),
          two_mass_ports<Scalar>()};
}
/// The linear plant itself, unchanged.
template <class Scalar, int States>
const LinearPlant<Scalar, States>& linear_plant(const LinearPlant<Scalar, States>& plant) {
  return plant;
}

namespace detail {

template <class Plant, class = void>
struct IsDriven : std::false_type {};
/// Whether `linear_plant` accepts a plant, so that its drive's input and its gap are known.
template <class Plant>
struct IsDriven<Plant, std::void_t<decltype(linear_plant(std::declval<const Plant&>()))>>
    : std::true_type {};

/// The plant with `more` states added after its own; the new rows and columns are zero.
/// @tparam More  the value of `more`, or Eigen::Dynamic
template <int More, class Scalar, int States>
LinearPlant<Scalar, larger_size(States, More)> enlarged(const LinearPlant<Scalar, States>& plant,
                                                        Eigen::Index more = More) {
  plant.require_one_order();
  constexpr int size = larger_size(States, More);
  const Eigen::Index n = plant.order();
  const auto column = [&](const Vector<Scalar, States>& of) {
    Vector<Scalar, size> result = Vector<Scalar, size>::Zero(n + more);
    result.template head<States>(n) = of;
    return result;
  };
  const auto row = [&](const RowVector<Scalar, States>& of) {
    return RowVector<Scalar, size>(column(of.transpose()).transpose());
  };
  Matrix<Scalar, size> matrix = Matrix<Scalar, size>::Zero(n + more, n + more);
  matrix.template topLeftCorner<States, States>(n, n) = plant.released_matrix;
  const Ports<Scalar, States>& ports = plant.connections;
  return {
      matrix,
      column(plant.force_input),
      column(plant.command_input),
      column(plant.excitation),
      row(plant.drive_force),
      plant.direct_transmission,
      {row(ports.displacement), row(ports.velocity), row(ports.measured_displacement),
       row(ports.measured_velocity), row(ports.relative_displacement), row(ports.relative_velocity),
       column(ports.displacement_lift), column(ports.velocity_lift)}};
}

}  // namespace detail

/// The plant with a measurement filter of first order:
///
///     ż_f = ω_f (z − z_f);   the computer reads z_f and ż_f
///
/// z (m) is the plant's measured displacement. The filter adds one state, z_f (m).
/// @param plant   plant whose readings are filtered
/// @param cutoff  cutoff frequency ω_f/2π (Hz) of the filter, > 0
/// @throws InvalidParameter where the cutoff is not admissible
template <class Scalar, int States>
LinearPlant<Scalar, larger_size(States, 1)> with_measurement_filter(
    const LinearPlant<Scalar, States>& plant, const Scalar& cutoff) {
  require_positive("measurement filter", static_cast<double>(cutoff), "Hz");
  const Eigen::Index n = plant.order();
  const Scalar rate = Scalar(2) * pi<Scalar> * cutoff;
  auto filtered = detail::enlarged<1>(plant);
  filtered.released_matrix.row(n) = rate * filtered.connections.measured_displacement;
  filtered.released_matrix(n, n) = -rate;
  filtered.connections.measured_velocity = filtered.released_matrix.row(n);
  filtered.connections.measured_displacement.setZero();
  filtered.connections.measured_displacement[n] = Scalar(1);
  return filtered;
}

/// The plant with a first-order lag of the drive, ṡ = ω_d (u − s). One state is added: the drive's
/// force s (N), which follows the command u (N).
/// @param plant      plant with an ideal drive
/// @param bandwidth  bandwidth ω_d/2π (Hz) of the drive, > 0
/// @throws InvalidParameter where the bandwidth is not admissible
template <class Scalar, int States>
LinearPlant<Scalar, larger_size(States, 1)> with_drive_lag(const LinearPlant<Scalar, States>& plant,
                                                           const Scalar& bandwidth) {
  require_positive("drive bandwidth", static_cast<double>(bandwidth), "Hz");
  const Eigen::Index n = plant.order();
  const Scalar rate = Scalar(2) * pi<Scalar> * bandwidth;
  auto driven = detail::enlarged<1>(plant);
  driven.released_matrix(n, n) = -rate;
  driven.command_input[n] = rate;
  driven.drive_force[n] = Scalar(1);
  driven.direct_transmission = Scalar(0);
  return driven;
}

/// The plant with a second-order lag of the drive, s̈ = ω_d² (u − s) − 2 ζ_d ω_d ṡ. Two states are
/// added: the drive's force s (N), which follows the command u (N), and ṡ/ω_d (N).
/// @param plant      plant with an ideal drive
/// @param bandwidth  bandwidth ω_d/2π (Hz) of the drive, > 0
/// @param damping    damping ratio ζ_d of the drive's lag, > 0
/// @throws InvalidParameter where an argument is outside its range
template <class Scalar, int States>
LinearPlant<Scalar, larger_size(States, 2)> with_drive_lag(const LinearPlant<Scalar, States>& plant,
                                                           const Scalar& bandwidth,
                                                           const Scalar& damping) {
  require_positive("drive bandwidth", static_cast<double>(bandwidth), "Hz");
  require_positive("drive damping", static_cast<double>(damping), "");
  const Eigen::Index n = plant.order();
  const Scalar rate = Scalar(2) * pi<Scalar> * bandwidth;
  auto driven = detail::enlarged<2>(plant);
  driven.released_matrix(n, n + 1) = rate;
  driven.released_matrix(n + 1, n) = -rate;
  driven.released_matrix(n + 1, n + 1) = Scalar(-2) * damping * rate;
  driven.command_input[n + 1] = rate;
  driven.drive_force[n] = Scalar(1);
  driven.direct_transmission = Scalar(0);
  return driven;
}

/// Rejects a plant with which no control loop can be formed.
/// @throws InvalidParameter unless all entries are finite, the sizes agree, the drive's force
/// depends on the command or the state, and this force directly accelerates the relative motion at
/// the gap (r b ≠ 0 for the row r of the relative velocity)
template <int States>
void validate(const LinearPlant<double, States>& plant) {
  const Ports<double, States>& ports = plant.ports();
  double sum = plant.released_matrix.sum() + plant.direct_transmission;
  const auto take = [&](const auto& row_or_column) { sum += row_or_column.sum(); };
  take(plant.force_input), take(plant.command_input), take(plant.excitation);
  take(plant.drive_force), take(ports.displacement), take(ports.velocity);
  take(ports.measured_displacement), take(ports.measured_velocity);
  take(ports.relative_displacement), take(ports.relative_velocity);
  take(ports.displacement_lift), take(ports.velocity_lift);
  require_finite("sum of the entries of the plant", sum, "");
  if (plant.control_input().isZero(0.0) && plant.drive_force.isZero(0.0))
    throw InvalidParameter("direct transmission g", plant.direct_transmission, "",
                           "nonzero where command input b_u and drive force row f are zero");
  const double answer = plant.ports().relative_velocity.dot(plant.force_input);
  if (!(std::abs(answer) > 0.0))
    throw InvalidParameter("relative acceleration per newton of the drive", answer, "1/kg",
                           "nonzero");
}

/// Converts a plant to another number type, for instance `long double`.
template <class To, class From, int States>
LinearPlant<To, States> converted(const LinearPlant<From, States>& plant) {
  const Ports<From, States>& ports = plant.connections;
  return {
      plant.released_matrix.template cast<To>(),
      plant.force_input.template cast<To>(),
      plant.command_input.template cast<To>(),
      plant.excitation.template cast<To>(),
      plant.drive_force.template cast<To>(),
      To(plant.direct_transmission),
      {ports.displacement.template cast<To>(), ports.velocity.template cast<To>(),
       ports.measured_displacement.template cast<To>(), ports.measured_velocity.template cast<To>(),
       ports.relative_displacement.template cast<To>(), ports.relative_velocity.template cast<To>(),
       ports.displacement_lift.template cast<To>(), ports.velocity_lift.template cast<To>()}};
}

}  // namespace holdfast
