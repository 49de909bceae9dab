#pragma once

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/math/enclosure/enclosed_exponential.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// The two masses, each parameter as the interval of all decimals that round to the given double.
/// @throws InvalidParameter where a parameter is not admissible
inline TwoMass<Enclosure> enclosed(const TwoMass<double>& plant) {
  validate(plant);
  const auto decimal = [](double x) { return Enclosure::of_decimal(x); };
  return {decimal(plant.conductor_mass),     decimal(plant.conductor_stiffness),
          decimal(plant.conductor_damping),  decimal(plant.absorber_mass),
          decimal(plant.absorber_stiffness), decimal(plant.absorber_damping)};
}

/// The sampling with τ and δ as the intervals of all decimals that round to the given doubles.
/// @throws InvalidParameter where τ or δ is not admissible
inline Sampling<Enclosure> enclosed(const Sampling<double>& sampling) {
  validate(sampling);
  return {Enclosure::of_decimal(sampling.period), Enclosure::of_decimal(sampling.processing_delay)};
}

}  // namespace holdfast
