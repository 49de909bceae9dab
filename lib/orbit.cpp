// Explicit instantiations of orbit for double.

#include "holdfast/orbit/cyclic_system.hpp"
#include "holdfast/orbit/itinerary_maps.hpp"
#include "holdfast/orbit/modal/modal_orbit_search.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"
#include "holdfast/orbit/region_of_attraction.hpp"

namespace holdfast {

template std::size_t ItineraryMaps<double>::samples_of_block() const;
template std::vector<Matrix<double, 5>> maps_of_blocks(const ItineraryMaps<double>&,
                                                       const Itinerary&);

template OrbitResult detail::orbit_of_motion(const IdealLoop<double>&, const Rational&,
                                             const OrbitLimits&,
                                             const PeriodicallyForcedMotion<double>&);
template OrbitResult find_periodic_orbit(const IdealLoop<double>&, const Vector<double, 4>&,
                                         const OrbitLimits&);

template std::optional<ModalAttraction> modal_attraction(const ModalLoop&,
                                                         const ModalItineraryMaps&,
                                                         const PeriodicOrbit&);
template OrbitResult detail::orbit_by_returns(const ModalLoop&, const Rational&, const OrbitLimits&,
                                              const ModalMotion&,
                                              const detail::ModalRegion<ModalLoop>&);
template OrbitResult find_periodic_orbit(const ModalLoop&, const std::vector<PlantPole>&,
                                         const ModalMotion::Full&, const OrbitLimits&);

template OrbitResult orbit_of_itinerary(const IdealLoop<double>&, const Rational&,
                                        const ItineraryMaps<double>&, const Itinerary&,
                                        const Backlash<double>&);

template class CyclicSystem<double>;
template class CyclicSystem<double, Eigen::Dynamic>;
template std::optional<PeriodicSolution<ItineraryMaps<double>>> periodic_solution(
    const ItineraryMaps<double>&, const Itinerary&, const std::vector<Matrix<double, 5>>&);

template std::vector<AttractionBall> attraction_balls(const IdealLoop<double>&,
                                                      const PeriodicOrbit&);

}  // namespace holdfast
