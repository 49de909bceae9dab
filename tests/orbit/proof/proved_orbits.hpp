#pragma once

#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/orbit/proof/orbit_proof.hpp"
#include "support/kollar_case.hpp"

namespace holdfast::test {

/// The loop of the paper's plant and force.
inline IdealLoop<double> proved_loop(double period, double width, double delay = 0.0) {
  KollarCase which = kollar_case(period, width);
  which.processing_delay = delay;
  return which.ideal_loop();
}

/// Where its motion comes to from a first displacement of the conductor (m).
inline PeriodicOrbit orbit_to_prove(const IdealLoop<double>& loop, double displacement = 0.0) {
  const OrbitResult found =
      find_periodic_orbit(loop, Vector<double, 4>(displacement, 0.0, 0.0, 0.0), {20000, 0});
  EXPECT_EQ(found.outcome, OrbitOutcome::certified) << loop.sampling.period;
  return found.orbit.value();
}

/// An orbit that switches at samples.
struct ProposedOrbit {
  IdealLoop<double> loop;
  PeriodicOrbit orbit;

  OrbitProof proof(double largest_miss = 1e-12) const {
    return prove_orbit(loop, orbit, largest_miss);
  }
};

}  // namespace holdfast::test
