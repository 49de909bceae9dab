#pragma once

#include "holdfast/contact/contact.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/orbit/event/event_orbit_search.hpp"
#include "support/lagging_plant.hpp"

namespace holdfast::test {

/// A loop with backlash on any plant, far from the edge of stability, with many changes of contact:
/// 5 ms with 1 ms of delay, 0.5 N at 10 Hz, 0.5 mm.
template <class Plant>
ImplementedLoopOf<Plant> lagging_loop(const Plant& plant, Switching switching,
                                      double delay = 0.001) {
  return {plant,
          {{0.005, delay},
           {-200.0, -5.0},
           multi_harmonic_force(HarmonicExcitation<double>{0.5, 10.0}),
           ForceHold::exact},
          {ContactLaw::kollar, 0.0005},
          switching};
}

}  // namespace holdfast::test

// The orbits of a plant whose order is known at run time alone, compiled once for all folders.
#ifdef HOLDFAST_EXTERN_TEMPLATES
namespace holdfast {

extern template EventOrbitResult<DriveContact<LinearPlant<double>>> find_event_orbit(
    const EventMotion<DriveContact<LinearPlant<double>>>&, const OrbitLimits&);

}  // namespace holdfast
#endif
