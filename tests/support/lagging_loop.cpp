#include "support/lagging_loop.hpp"

#ifdef HOLDFAST_EXTERN_TEMPLATES
namespace holdfast {

template EventOrbitResult<DriveContact<LinearPlant<double>>> find_event_orbit(
    const EventMotion<DriveContact<LinearPlant<double>>>&, const OrbitLimits&);

}  // namespace holdfast
#endif
