#pragma once

#include <string>

#include "holdfast/core/types.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/orbit/orbit_search.hpp"

namespace holdfast::program {

/// A motion and the orbit that it was found to come to.
struct SettledMotion {
  Vector<double, 4> initial_state;
  OrbitResult search;

  const PeriodicOrbit* orbit() const {
    return search.outcome == OrbitOutcome::certified ? &*search.orbit : nullptr;
  }
};

/// How two motions of one loop end beside one another, by their certified orbits: at different
/// ones, or at one orbit in the same or in another phase; in the words of the page.
std::string meeting_text(const IdealLoop<double>& loop, const SettledMotion& reference,
                         const SettledMotion& other);

/// Why two motions of a loop are still apart, as far as their certified orbits tell.
std::string apart_text(const IdealLoop<double>& loop, const Vector<double, 4>& reference,
                       const Vector<double, 4>& other);

}  // namespace holdfast::program
