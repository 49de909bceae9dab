#pragma once

#include "case/model/cable_of_case.hpp"
#include "holdfast/cable/elements.hpp"

namespace holdfast::program {

/// The continuous cable, with the damping ratio of the conductor at the two frequencies of
/// [reduction]; the spring and damper of `spring_mass` are those of [plant].
inline CableElements elements_of(const Case& the_case, int elements, AbsorberReading reading) {
  const HangingAbsorber absorber{reading, the_case.absorber.mass, the_case.plant.absorber_stiffness,
                                 the_case.plant.absorber_damping};
  return {conductor_of(the_case), the_case.absorber.position, elements, absorber,
          rayleigh_damping(the_case.conductor.damping_ratio, the_case.reduction.first_frequency,
                           the_case.reduction.second_frequency)};
}

}  // namespace holdfast::program
