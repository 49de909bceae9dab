#pragma once

#include <cstdint>

#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/motion/modal/natural_motions.hpp"
#include "holdfast/orbit/event/event_orbit.hpp"
#include "holdfast/orbit/event/event_orbit_search.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"
#include "process/job_context.hpp"

namespace holdfast::program {

/// The periodic orbit that the motion of the loop, in either model, comes to from the case's
/// initial state. Warns where a switching surface is near. Throws NoAnswer, saying why, where there
/// is none, or none with a certificate.
/// @param largest_period  samples
PeriodicOrbit certified_orbit(const JobContext& context, const IdealLoop<double>& loop,
                              std::int64_t largest_period);
EventOrbit certified_orbit(const JobContext& context, const ImplementedLoop& loop,
                           std::int64_t largest_period);

/// The same with where it begins, in the model that switches between the samples.
EventOrbitResult<DriveContact<>> certified_event_orbit(const JobContext& context,
                                                       const ImplementedLoop& loop,
                                                       std::int64_t largest_period);

/// That of a conductor by its modes in the paper's model, with the ten largest of its multipliers.
PeriodicOrbit certified_orbit(const JobContext& context, const ModalLoop& loop,
                              std::int64_t largest_period);

/// That of a modal case in any other, as the conductor at the absorber and the absorber show it,
/// with the ten largest of its multipliers.
EventOrbit certified_orbit_of_modes(const JobContext& context, Switching switching,
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
