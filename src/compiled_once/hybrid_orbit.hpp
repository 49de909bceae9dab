#pragma once

#include "holdfast/motion/real_loop.hpp"
#include "holdfast/orbit/event/event_orbit_search.hpp"

// Compiled in hybrid_orbit.cpp for all files of the program, for every contact that a loop may
// have.

namespace holdfast {

extern template HybridOrbitResult<SampledContactMotion> find_hybrid_orbit(
    const HybridMotion<SampledContactMotion>&, const Rational&, const OrbitLimits&);
extern template HybridOrbitResult<ExactDeadZone> find_hybrid_orbit(
    const HybridMotion<ExactDeadZone>&, const Rational&, const OrbitLimits&);
extern template HybridOrbitResult<ExactBacklash> find_hybrid_orbit(
    const HybridMotion<ExactBacklash>&, const Rational&, const OrbitLimits&);

}  // namespace holdfast
