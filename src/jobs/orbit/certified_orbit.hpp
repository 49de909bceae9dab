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

/// The search for the periodic orbit that a motion comes to.
template <class Moving>
auto orbit_of(const Moving& moving, const OrbitLimits& limits) {
  if constexpr (Moving::by_events)
    return find_event_orbit(motion_of(moving), limits);
  else
    return find_periodic_orbit(moving.loop, moving.state, limits);
}

/// The periodic orbit that a loop's motion comes to; on a conductor by its modes with the ten
/// largest of its multipliers, and in the model that switches between the samples as conductor and
/// absorber show it. Warns where a switching surface is near. Throws NoAnswer, saying why, where
/// there is none, or none with a certificate.
/// @param largest_period  samples
PeriodicOrbit certified_orbit(const JobContext& context, const SampledMasses& moving,
                              std::int64_t largest_period);
EventOrbit certified_orbit(const JobContext& context, const BuiltMasses& moving,
                           std::int64_t largest_period);
PeriodicOrbit certified_orbit(const JobContext& context, const SampledModes& moving,
                              std::int64_t largest_period);
EventOrbit certified_orbit(const JobContext& context, const BuiltPlant& moving,
                           std::int64_t largest_period);

/// The certified orbit and where it begins, in the model that switches between the samples.
EventOrbitResult<DriveContact<>> certified_event_orbit(const JobContext& context,
                                                       const BuiltMasses& moving,
                                                       std::int64_t largest_period);

/// How far from the orbit every motion is sure to come to it.
struct CaptureRadii {
  double smallest;  ///< m, 0 where none was found; ∞ without backlash
  double largest;   ///< m
};

/// Radii on a conductor by its modes: of a ball of all deviations, and of the ellipsoid around it.
CaptureRadii capture_radii_of(const ModalLoop& loop, const PeriodicOrbit& orbit);

/// Certificate of an orbit.
struct OrbitCertificate {
  CaptureRadii radii;
  OrbitVerification verification;  ///< in extended precision
};

OrbitCertificate certificate_of(const IdealLoop<double>& loop, const PeriodicOrbit& orbit);

}  // namespace holdfast::program
