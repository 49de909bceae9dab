// Explicit instantiations of orbit for double.

#include "holdfast/orbit/itinerary_maps.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"
#include "holdfast/orbit/periodic_solution.hpp"
#include "holdfast/orbit/region_of_attraction.hpp"

namespace holdfast {

template ContactMaps<double>::ContactMaps(const ForcedLoop<double>&, const Rational&);
template double ContactMaps<double>::spread_of(const Matrix<double, 5>&) const;
template std::vector<AffineMap<double>> affine_blocks(const ContactMaps<double>&, const Contacts&);

template OrbitResult detail::OrbitSearch<double>::run();
template OrbitResult find_periodic_orbit(const ForcedLoop<double>&, const Vector<double, 4>&,
                                         const OrbitLimits&);

template OrbitCandidate orbit_of_contacts(const ForcedLoop<double>&, const Rational&,
                                          const ContactMaps<double>&, const Contacts&,
                                          const Backlash<double>&);

template EndRelation<double> relation_of_ends(const std::vector<AffineMap<double>>&);
template std::optional<PeriodicSolution<double>> periodic_solution(const ContactMaps<double>&,
                                                                   const Contacts&,
                                                                   const EndRelation<double>&);

template std::vector<CapturePoint> capture_points(const ForcedLoop<double>&, const PeriodicOrbit&);

}  // namespace holdfast
