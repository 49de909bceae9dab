#include "jobs/orbit/orbit_certificate.hpp"

#include <algorithm>
#include <limits>

#include "holdfast/orbit/region_of_attraction.hpp"

namespace holdfast::program {

OrbitCertificate certificate_of(const IdealLoop<double>& loop, const PeriodicOrbit& orbit) {
  const auto points = attraction_balls(loop, orbit);
  double smallest = std::numeric_limits<double>::infinity(), largest = 0.0;
  for (const AttractionBall& point : points) {
    const double radius = attraction_radius(point, point.memory);
    smallest = std::min(smallest, radius);
    largest = std::max(largest, radius);
  }
  return {points.empty() ? 0.0 : smallest, largest, verify_orbit<long double>(loop, orbit)};
}

}  // namespace holdfast::program
