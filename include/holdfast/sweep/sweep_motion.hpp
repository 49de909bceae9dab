#pragma once

#include <array>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// One motion of a sweep: its loop and where it begins.
struct SweepMotion {
  IdealLoop<double> loop;           ///< its own, every parameter of which may differ
  Vector<double, 4> initial_state;  ///< [z₁, ż₁, z₂, ż₂] (m, m/s, m, m/s)
};

/// m₁, k₁, c₁, m₂, k₂, c₂ in SI units, to be compared.
inline std::array<double, 6> numbers_of(const TwoMass<double>& plant) {
  return {plant.conductor_mass, plant.conductor_stiffness, plant.conductor_damping,
          plant.absorber_mass,  plant.absorber_stiffness,  plant.absorber_damping};
}

/// @throws InvalidParameter where the loop is not admissible or the state not finite
inline void validate(const SweepMotion& motion) {
  validate(motion.loop);
  for (const double entry : motion.initial_state) require_finite("initial state", entry, "SI");
}

}  // namespace holdfast
