// Explicit instantiations of orbit/event, for every contact that a loop may have.
#include "holdfast/orbit/event/event_orbit_search.hpp"

namespace holdfast {

template HybridOrbitResult<DriveContact<>> find_hybrid_orbit(const HybridMotion<DriveContact<>>&,
                                                             const Rational&, const OrbitLimits&);

}  // namespace holdfast
