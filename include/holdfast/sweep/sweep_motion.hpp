#pragma once

#include <array>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// One motion of a sweep: its loop and its initial state.
struct SweepMotion {
  IdealLoop<double> loop;           ///< loop, which may differ from motion to motion
  Vector<double, 4> initial_state;  ///< initial state [z₁, ż₁, z₂, ż₂] (m, m/s, m, m/s)
};

/// The parameters m₁, k₁, c₁, m₂, k₂, c₂ of a plant (kg, N/m, N s/m; 1: conductor, 2: absorber).
inline std::array<double, 6> numbers_of(const TwoMass<double>& plant) {
  return {plant.conductor_mass, plant.conductor_stiffness, plant.conductor_damping,
          plant.absorber_mass,  plant.absorber_stiffness,  plant.absorber_damping};
}

/// Validates a motion of a sweep: the loop must be admissible and the state finite.
/// @throws InvalidParameter naming the first quantity that is not admissible
inline void validate(const SweepMotion& motion) {
  validate(motion.loop);
  for (const double entry : motion.initial_state) require_finite("initial state", entry, "SI");
}

}  // namespace holdfast
