#pragma once

#include "compiled_once/hybrid_lyapunov.hpp"
#include "compiled_once/hybrid_orbit.hpp"
#include "compiled_once/periodic_orbit.hpp"
#include "holdfast/chaos/event_classification.hpp"
#include "holdfast/chaos/sampled_classification.hpp"

// Compiled in verdict.cpp for all files of the program.

namespace holdfast {

extern template MotionVerdict classify_motion(const ForcedLoop<double>&, const Vector<double, 4>&,
                                              const OrbitLimits&);
extern template HybridVerdict classify_motion(const RealLoop&, const Vector<double, 4>&,
                                              const OrbitLimits&);

}  // namespace holdfast
