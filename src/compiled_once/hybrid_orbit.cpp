#include "compiled_once/hybrid_orbit.hpp"

#include "compiled_once/periodic_orbit.hpp"
#include "compiled_once/sampled_loop.hpp"

namespace holdfast {

template HybridOrbitResult<DriveContact<>> find_hybrid_orbit(const HybridMotion<DriveContact<>>&,
                                                             const Rational&, const OrbitLimits&);

}  // namespace holdfast
