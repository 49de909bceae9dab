#pragma once

#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/orbit/orbit_verification.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"

namespace holdfast::program {

/// What a certificate says beside the orbit itself.
struct OrbitCertificate {
  double smallest_radius;          ///< of capture (m), 0 where none was found; ∞ without backlash
  double largest_radius;           ///< m
  OrbitVerification verification;  ///< in extended precision
};

OrbitCertificate certificate_of(const IdealLoop<double>& loop, const PeriodicOrbit& orbit);

}  // namespace holdfast::program
