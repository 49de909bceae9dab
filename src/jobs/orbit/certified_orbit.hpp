#pragma once

#include <cstdint>

#include "case/job_context.hpp"
#include "case/model/moving_loop.hpp"
#include "holdfast/orbit/event/event_orbit.hpp"
#include "holdfast/orbit/event/event_orbit_search.hpp"
#include "holdfast/orbit/modal/modal_orbit_search.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"

namespace holdfast::program {

/// Searches for the periodic orbit to which a loop's motion converges.
template <class Moving>
auto orbit_of(const Moving& moving, const OrbitLimits& limits) {
  if constexpr (Moving::by_events)
    return find_event_orbit(motion_of(moving), limits);
  else
    return find_periodic_orbit(moving.loop, moving.state, limits);
}

/// Certified periodic orbit to which a loop's motion converges. Of SampledModes and BuiltPlant it
/// has only the ten largest multipliers, of BuiltPlant only the states of conductor and absorber.
/// Warns where a switching surface is near; throws NoAnswer, with the reason, where none is found.
/// @param largest_period  longest period searched (samples)
PeriodicOrbit certified_orbit(const JobContext& context, const SampledMasses& moving,
                              std::int64_t largest_period);
EventOrbit certified_orbit(const JobContext& context, const BuiltMasses& moving,
                           std::int64_t largest_period);
PeriodicOrbit certified_orbit(const JobContext& context, const SampledModes& moving,
                              std::int64_t largest_period);
EventOrbit certified_orbit(const JobContext& context, const BuiltPlant& moving,
                           std::int64_t largest_period);

/// Certified orbit of two masses with exact switching, with the full result of its search.
EventOrbitResult<DriveContact<>> certified_event_orbit(const JobContext& context,
                                                       const BuiltMasses& moving,
                                                       std::int64_t largest_period);

/// Radii of capture: every motion within this distance of the orbit converges to it.
struct CaptureRadii {
  double smallest;  ///< smallest radius along the orbit (m); 0: none found; ∞: no backlash
  double largest;   ///< largest radius along the orbit (m)
};

/// Capture radii of a modal conductor: `largest` is that of an ellipsoid of attraction in the space
/// of all states, `smallest` that of the largest ball in it. Both are 0 if none is found.
CaptureRadii capture_radii_of(const ModalLoop& loop, const PeriodicOrbit& orbit);

/// Capture radii of two masses, over the balls of attraction_balls() along the orbit.
CaptureRadii capture_radii_of(const IdealLoop<double>& loop, const PeriodicOrbit& orbit);

}  // namespace holdfast::program
