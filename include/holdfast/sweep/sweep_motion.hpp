#pragma once

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/forced_loop.hpp"

namespace holdfast {

/// One motion of a sweep: its loop and where it begins.
struct SweepMotion {
  ForcedLoop<double> loop;
  Vector<double, 4> initial_state;  ///< [z₁, ż₁, z₂, ż₂] (m, m/s, m, m/s)
};

/// @throws InvalidParameter where the loop is not admissible or the state not finite
inline void validate(const SweepMotion& motion) {
  validate(motion.loop);
  for (const double entry : motion.initial_state) require_finite("initial state", entry, "SI");
}

}  // namespace holdfast
