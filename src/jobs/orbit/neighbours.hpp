#pragma once

#include <string>

#include "holdfast/core/types.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/orbit/orbit_search.hpp"

namespace holdfast::program {

/// Motion and the result of the search for its periodic orbit.
struct SettledMotion {
  Vector<double, 4> initial_state;
  OrbitResult search;

  const PeriodicOrbit* orbit() const {
    return search.outcome == OrbitOutcome::certified ? &*search.orbit : nullptr;
  }
};

/// Text that compares the final motions of two initial states of one loop by their certified
/// orbits: different orbits, or the same orbit in the same or in a shifted phase.
std::string meeting_text(const IdealLoop<double>& loop, const SettledMotion& reference,
                         const SettledMotion& other);

/// Reason why two motions of a loop stay apart, from their certified orbits, as a text.
std::string apart_text(const IdealLoop<double>& loop, const Vector<double, 4>& reference,
                       const Vector<double, 4>& other);

}  // namespace holdfast::program
