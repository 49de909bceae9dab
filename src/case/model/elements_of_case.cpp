#include "case/model/elements_of_case.hpp"

#include "case/model/cable_of_case.hpp"

namespace holdfast::program {

RayleighDamping rayleigh_damping_of(const Case& the_case) {
  return rayleigh_damping(the_case.conductor.damping_ratio, the_case.reduction.first_frequency,
                          the_case.reduction.second_frequency);
}

CableElements elements_of(const Case& the_case, int elements, AbsorberReading reading) {
  const HangingAbsorber absorber{reading, the_case.absorber.mass, the_case.plant.absorber_stiffness,
                                 the_case.plant.absorber_damping};
  return {conductor_of(the_case), the_case.absorber.position, elements, absorber,
          rayleigh_damping_of(the_case)};
}

}  // namespace holdfast::program
