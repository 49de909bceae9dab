// A periodic motion is the same one in other units.

#include "holdfast/orbit/orbit_search.hpp"
#include "property/units_case.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

using test::Random;
using test::UnitsCase;

OrbitLimits limits() {
  OrbitLimits limits;
  limits.largest_period = 2000;
  return limits;
}

/// A damped loop of which sampling and forcing coincide every 8 to 63 samples. The force is held,
/// since following it over a sample rounds otherwise in other units of time.
UnitsCase random_orbit_case(Random& random) {
  UnitsCase drawn = test::random_units_case(random, true);
  TwoMass<double>& plant = drawn.loop.plant;
  const auto critical = [](double mass, double stiffness) {
    return 2.0 * std::sqrt(mass * stiffness);
  };
  plant.conductor_damping += 0.02 * critical(plant.conductor_mass, plant.conductor_stiffness);
  plant.absorber_damping += 0.02 * critical(plant.absorber_mass, plant.absorber_stiffness);
  const auto samples = static_cast<double>(8 + random.index(56));
  drawn.loop.excitation.frequency = 1.0 / (samples * drawn.loop.period);
  drawn.loop.exact_hold = 0;
  return drawn;
}

/// A loop near that of the paper, whose motions have periodic orbits of many shapes, and its force
/// a whole number of samples long.
UnitsCase random_paper_case(Random& random) {
  UnitsCase drawn = test::random_units_case(random, true);
  test::LoopCase& loop = drawn.loop;
  loop.plant = kollar2022_plant();
  loop.plant.conductor_stiffness *= random.log_uniform(0.5, 2.0);
  loop.plant.absorber_stiffness *= random.log_uniform(0.5, 2.0);
  loop.excitation = {random.log_uniform(0.1, 1.0), 10.0};
  loop.period = 0.1 / (10.0 + static_cast<double>(random.index(60)));
  loop.delay_share = random.unit() < 0.5 ? 0.0 : random.unit();
  loop.gains = {-557.0 * random.unit(), -13.0 * random.unit()};
  loop.width = random.log_uniform(1e-5, 3e-3);
  loop.state.setZero();
  loop.exact_hold = 0;
  return drawn;
}

bool same_orbit(const PeriodicOrbit& one, const PeriodicOrbit& other, const UnitsCase& units) {
  if (one.itinerary != other.itinerary) return false;
  for (std::size_t j = 0; j < one.states.size(); ++j) {
    const Vector<double, 4> state = one.states[j].head<4>().cwiseProduct(units.of_state());
    if (state != other.states[j].head<4>()) return false;
  }
  return true;
}

/// Where the loop's matrices are the same to the last bit; rounding may send an irregular motion to
/// another orbit.
test::PropertyOutcome orbit_scales(const UnitsCase& units) {
  const test::LoopCase rewritten = units.rewritten();
  if (!test::LoopInBothUnits(units).same) return test::does_not_apply();
  const auto first = find_periodic_orbit(units.loop.loop(), units.loop.state, limits());
  const auto other = find_periodic_orbit(rewritten.loop(), rewritten.state, limits());
  const auto leaves = [](const OrbitResult& found) {
    return found.outcome == OrbitOutcome::diverges || found.outcome == OrbitOutcome::none_found;
  };
  // Beyond 1e100 in the one units is not yet beyond it in the others.
  if (leaves(first) && leaves(other)) return test::holds();
  if (first.outcome != other.outcome)
    return test::fails(test::differs("outcome", static_cast<double>(other.outcome),
                                     static_cast<double>(first.outcome)));
  if (first.samples != other.samples)
    return test::fails(test::differs("samples", static_cast<double>(other.samples),
                                     static_cast<double>(first.samples)));
  if (first.orbit.has_value() != other.orbit.has_value()) return test::fails("orbit in one alone");
  if (!first.orbit) return test::does_not_apply();
  if (!same_orbit(*first.orbit, *other.orbit, units)) return test::fails("another orbit");
  return test::holds();
}

TEST(UnitsOfOrbit, AreThoseOfItsLoop) {
  test::expect_property(131, 200, random_orbit_case, orbit_scales, 0.25);
}

TEST(UnitsOfOrbit, NearThePaperAreThoseOfItsLoop) {
  test::expect_property(113, 200, random_paper_case, orbit_scales, 0.25);
}

}  // namespace
}  // namespace holdfast
