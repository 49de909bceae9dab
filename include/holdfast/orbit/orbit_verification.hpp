#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "holdfast/motion/forced_loop.hpp"
#include "holdfast/orbit/itinerary_maps.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"
#include "holdfast/orbit/periodic_solution.hpp"
#include "holdfast/orbit/switching_borders.hpp"

namespace holdfast {

/// How a certificate of a periodic orbit stands in another number type.
struct OrbitRecheck {
  bool same_contacts = false;  ///< the orbit solved there reproduces the sequence of contacts
  double displacement_difference = std::numeric_limits<double>::infinity();  ///< largest (m)
  double velocity_difference = std::numeric_limits<double>::infinity();      ///< largest (m/s)
  double closure_error = std::numeric_limits<double>::infinity();  ///< ‖z_N − z₀‖ there (SI)
};

/// Computes an orbit anew from its sequence of contacts, all of it in the number type `Precise`:
/// matrix exponentials, forcing, solution and backlash.
///
///     recheck_orbit<long double>(loop, orbit).same_contacts
///
/// @param loop   the one that the orbit was found for
/// @param orbit  certified
/// @return infinite differences where the sequence is singular there
template <class Precise>
OrbitRecheck recheck_orbit(const ForcedLoop<double>& loop, const PeriodicOrbit& orbit) {
  using std::abs;
  const ContactMaps<Precise> maps(converted<Precise>(loop), orbit.ratio);
  const auto ends = relation_of_ends(affine_blocks(maps, orbit.contacts));
  const auto solution = periodic_solution(maps, orbit.contacts, ends);
  OrbitRecheck recheck;
  if (!solution) return recheck;
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
  recheck.same_contacts = has_contacts(switching_pattern(solution->states, law), orbit.contacts);
  recheck.displacement_difference = static_cast<double>(std::max(largest[0], largest[2]));
  recheck.velocity_difference = static_cast<double>(std::max(largest[1], largest[3]));
  recheck.closure_error = static_cast<double>(solution->closure_error);
  return recheck;
}

}  // namespace holdfast
