// Explicit instantiations of orbit/event, for every contact that a loop may have.
#include "holdfast/orbit/event/event_orbit_search.hpp"

namespace holdfast {

template EventOrbitResult<DriveContact<>> find_event_orbit(const EventMotion<DriveContact<>>&,
                                                           const Rational&, const OrbitLimits&);

}  // namespace holdfast
