#pragma once

#include "holdfast/contact/contact.hpp"
#include "holdfast/motion/real_loop.hpp"
#include "holdfast/orbit/event/event_orbit_search.hpp"

// Compiled in hybrid_orbit.cpp for all files of the program.

namespace holdfast {

extern template HybridOrbitResult<DriveContact<>> find_hybrid_orbit(
    const HybridMotion<DriveContact<>>&, const Rational&, const OrbitLimits&);

}  // namespace holdfast
