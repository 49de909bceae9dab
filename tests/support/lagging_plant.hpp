#pragma once

#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast::test {

/// Two masses, a measurement filter of first order and a drive that lags by second order,
/// x = [z₁, ż₁, z₂, ż₂, z_f, s, ṡ/ω_d].
/// @param filter   its corner (Hz)
/// @param drive    ω_d (Hz)
/// @param damping  ζ_d
inline LinearPlant<double, 7> filtered_and_lagging_plant(
    double filter = 80.0, double drive = 60.0, const TwoMass<double>& masses = kollar2022_plant(),
    double damping = 0.7) {
  return with_drive_lag(with_measurement_filter(linear_plant(masses), filter), drive, damping);
}

/// The same, its order known at run time alone.
template <int States>
LinearPlant<double> of_dynamic_order(const LinearPlant<double, States>& plant) {
  const Ports<double, States>& ports = plant.connections;
  return {plant.released_matrix,
          plant.force_input,
          plant.command_input,
          plant.excitation,
          plant.drive_force,
          plant.direct_transmission,
          {ports.displacement, ports.velocity, ports.measured_displacement, ports.measured_velocity,
           ports.relative_displacement, ports.relative_velocity, ports.displacement_lift,
           ports.velocity_lift}};
}

/// Two masses whose state is read through ports, their order known at run time alone. Tests take
/// plants of such an order, whose solvers are compiled once, and those of a fixed one where that
/// itself is tested.
inline LinearPlant<double> through_ports(const TwoMass<double>& masses) {
  return of_dynamic_order(linear_plant(masses));
}

/// filtered_and_lagging_plant(), of which the compiler does not know the order.
inline LinearPlant<double> lagging_plant(double filter = 80.0, double drive = 60.0,
                                         const TwoMass<double>& masses = kollar2022_plant(),
                                         double damping = 0.7) {
  return of_dynamic_order(filtered_and_lagging_plant(filter, drive, masses, damping));
}

}  // namespace holdfast::test
