// Explicit instantiations of orbit/event, for every contact that a loop may have.
#include "holdfast/orbit/event/event_motion_region.hpp"
#include "holdfast/orbit/event/event_orbit_search.hpp"

namespace holdfast {

template EventOrbitResult<DriveContact<>> find_event_orbit(const EventMotion<DriveContact<>>&,
                                                           const OrbitLimits&);
template EventOrbitResult<DriveContact<ControlledPlant>> find_event_orbit(
    const EventMotion<DriveContact<ControlledPlant>>&, const OrbitLimits&);

template OrbitResultOf<EventOrbit> continued_orbit(const ImplementedLoop&, const EventOrbit&);

}  // namespace holdfast
