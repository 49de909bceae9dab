#pragma once

#include "holdfast/plant/modal_plant.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast::test {

/// Kollár 2022, Table 1, with what of it moves with the conductor (kg).
inline Absorber<double> papers_absorber(double clamp_mass) {
  const TwoMass<double> masses = kollar2022_plant();
  return {masses.absorber_mass, masses.absorber_stiffness, masses.absorber_damping, clamp_mass};
}

}  // namespace holdfast::test
