#pragma once

#include <vector>

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/plant/conductor_with_absorber.hpp"
#include "holdfast/plant/loop_hardware.hpp"
#include "holdfast/plant/modal_plant.hpp"
#include "holdfast/plant/plant_poles.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "support/random.hpp"

namespace holdfast::test {

/// Kollár 2022, Table 1, with what of it moves with the conductor (kg).
inline Absorber<double> papers_absorber(double clamp_mass) {
  const TwoMass<double> masses = kollar2022_plant();
  return {masses.absorber_mass, masses.absorber_stiffness, masses.absorber_damping, clamp_mass};
}

/// The paper's string by its modes at the absorber's place.
inline std::vector<PlaceMode<double>> papers_modes(int count) {
  return string_modes(taut_string(kollar2022_conductor()), 0.64, count);
}

/// The paper's string by its modes, with the absorber and the poles of both.
/// @param damping  ratio of all modes
/// @param place    of the absorber (m)
inline ConductorWithAbsorber string_with_absorber(
    int modes, double damping, const LoopHardware& hardware = {}, double place = 0.64,
    const Absorber<double>& absorber = papers_absorber(0.01)) {
  auto string = taut_string(kollar2022_conductor());
  string.damping_ratio = damping;
  ConductorWithAbsorber conductor{string_modes(string, place, modes), absorber, {}, hardware};
  conductor.poles = plant_poles(conductor.modes, absorber);
  return conductor;
}

/// The two masses that a conductor of one mode is, with an absorber without a clamp mass.
inline TwoMass<double> two_masses_of(const PlaceMode<double>& mode,
                                     const Absorber<double>& absorber) {
  const double mass = mode.mass / (mode.shape * mode.shape), omega = mode.angular_frequency;
  return {mass,          mass * omega * omega, 2.0 * mode.damping_ratio * omega * mass,
          absorber.mass, absorber.stiffness,   absorber.damping};
}

/// Up to twelve modes at any distances, every fourth with a node at the absorber.
inline std::vector<PlaceMode<double>> random_modes(Random& random, double largest_damping) {
  std::vector<PlaceMode<double>> modes;
  double omega = random.log_uniform(0.1, 10.0);
  const auto count = static_cast<int>(random.uniform(1.0, 12.0));
  for (int n = 0; n < count; ++n) {
    const double shape = n % 4 == 3 ? 0.0 : random.uniform(-1.0, 1.0);
    modes.push_back(
        {omega, random.log_uniform(1e-4, largest_damping), shape, random.uniform(0.1, 2.0)});
    omega *= random.uniform(1.05, 2.0);
  }
  return modes;
}

}  // namespace holdfast::test
