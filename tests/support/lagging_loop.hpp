#pragma once

#include "holdfast/contact/contact.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast::test {

/// Two masses, a measurement filter of first order and a drive that lags by second order,
/// x = [z₁, ż₁, z₂, ż₂, z_f, s, ṡ/ω_d].
inline LinearPlant<double, 7> filtered_and_lagging_plant() {
  return with_drive_lag(with_measurement_filter(linear_plant(kollar2022_plant()), 80.0), 60.0, 0.7);
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

/// A loop with backlash on any plant, far from the edge of stability, with many changes of contact:
/// 5 ms with 1 ms of delay, 0.5 N at 10 Hz, 0.5 mm.
template <class Plant>
ImplementedLoopOf<Plant> lagging_loop(const Plant& plant, Switching switching,
                                      double delay = 0.001) {
  return {plant,
          {{0.005, delay},
           {-200.0, -5.0},
           multi_harmonic_force(HarmonicExcitation<double>{0.5, 10.0}),
           ForceHold::exact},
          {ContactLaw::kollar, 0.0005},
          switching};
}

}  // namespace holdfast::test
