#pragma once

#include <cstdint>

#include "holdfast/control/controlled_plant.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/motion/modal/natural_motions.hpp"
#include "holdfast/orbit/event/event_orbit.hpp"
#include "holdfast/orbit/event/event_orbit_search.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"
#include "process/job_context.hpp"

namespace holdfast::program {

/// The periodic orbit that the motion of the loop, one of `with_motion_of`, comes to from the
/// case's initial state; on a conductor by its modes with the ten largest of its multipliers, and
/// in the model that switches between the samples as conductor and absorber show it. Warns where a
/// switching surface is near. Throws NoAnswer, saying why, where there is none, or none with a
/// certificate.
/// @param largest_period  samples
PeriodicOrbit certified_orbit(const JobContext& context, const IdealLoop<double>& loop,
                              std::int64_t largest_period);
EventOrbit certified_orbit(const JobContext& context, const ImplementedLoop& loop,
                           std::int64_t largest_period);
PeriodicOrbit certified_orbit(const JobContext& context, const ModalLoop& loop,
                              std::int64_t largest_period);
EventOrbit certified_orbit(const JobContext& context,
                           const ImplementedLoopOf<ControlledPlant>& loop,
                           std::int64_t largest_period);

/// The same with where it begins, in the model that switches between the samples.
EventOrbitResult<DriveContact<>> certified_event_orbit(const JobContext& context,
                                                       const ImplementedLoop& loop,
                                                       std::int64_t largest_period);

/// How far from the orbit every motion is sure to come to it.
struct CaptureRadii {
  double smallest;  ///< m, 0 where none was found; ∞ without backlash
  double largest;   ///< m
};

/// Of a conductor by its modes: of a ball of all deviations, and of the ellipsoid that it lies in.
CaptureRadii capture_radii_of(const ModalLoop& loop, const PeriodicOrbit& orbit);

/// What a certificate says beside the orbit itself.
struct OrbitCertificate {
  CaptureRadii radii;
  OrbitVerification verification;  ///< in extended precision
};

OrbitCertificate certificate_of(const IdealLoop<double>& loop, const PeriodicOrbit& orbit);

}  // namespace holdfast::program
