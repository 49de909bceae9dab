#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/orbit/itinerary_maps.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"
#include "holdfast/orbit/switching_borders.hpp"

namespace holdfast {

/// How a certificate of a periodic orbit stands in another number type.
struct OrbitVerification {
  bool same_itinerary = false;  ///< the orbit solved there reproduces the itinerary
  double displacement_difference = std::numeric_limits<double>::infinity();  ///< largest (m)
  double velocity_difference = std::numeric_limits<double>::infinity();      ///< largest (m/s)
  double closure_error = std::numeric_limits<double>::infinity();  ///< ‖z_N − z₀‖ there (SI)
};

/// Computes an orbit again from its itinerary, all of it in the number type `Precise`:
/// matrix exponentials, forcing, solution and backlash.
///
///     verify_orbit<long double>(loop, orbit).same_itinerary
///
/// @param loop   the one that the orbit was found for
/// @param orbit  certified
/// @return infinite differences where the sequence is singular there
template <class Precise>
OrbitVerification verify_orbit(const IdealLoop<double>& loop, const PeriodicOrbit& orbit) {
  using std::abs;
  const ItineraryMaps<Precise> maps(converted<Precise>(loop), orbit.ratio);
  const auto solution =
      periodic_solution(maps, orbit.itinerary, affine_blocks(maps, orbit.itinerary));
  OrbitVerification verification;
  if (!solution) return verification;
  const BacklashMemory<double>& memory = orbit.memory;
  const Backlash<Precise> law(Precise(loop.backlash_width),
                              {memory.inside, Precise(memory.lower), Precise(memory.upper),
                               Precise(memory.previous_velocity)});
  Vector<Precise, 4> largest = Vector<Precise, 4>::Zero();
  for (std::size_t j = 0; j < orbit.states.size(); ++j) {
    const Vector<Precise, 5> difference =
        solution->states[j] - orbit.states[j].template cast<Precise>();
    largest = largest.cwiseMax(difference.template head<4>().cwiseAbs());
  }
  verification.same_itinerary =
      has_itinerary(switching_pattern(solution->states, law), orbit.itinerary);
  verification.displacement_difference = static_cast<double>(std::max(largest[0], largest[2]));
  verification.velocity_difference = static_cast<double>(std::max(largest[1], largest[3]));
  verification.closure_error = static_cast<double>(solution->closure_error);
  return verification;
}

}  // namespace holdfast
