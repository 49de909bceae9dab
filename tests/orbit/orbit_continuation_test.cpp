#include "holdfast/orbit/orbit_continuation.hpp"

#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "support/kollar_case.hpp"

namespace holdfast {
namespace {

PeriodicOrbit orbit_of(const IdealLoop<double>& loop) {
  const auto found = find_periodic_orbit(loop, Vector<double, 4>::Zero());
  EXPECT_EQ(found.outcome, OrbitOutcome::certified);
  return *found.orbit;
}

/// (value) ↦ the same loop with this value of a part.
template <class Part>
auto along(const IdealLoop<double>& loop, Part&& part) {
  return [loop, part](double value) {
    IdealLoop<double> other = loop;
    part(other) = value;
    return other;
  };
}

constexpr auto backlash_width = [](auto& loop) -> double& { return loop.backlash_width; };
constexpr auto differential_gain = [](auto& loop) -> double& { return loop.gains.differential; };
constexpr auto force = [](auto& loop) -> double& { return loop.excitation.amplitude; };

TEST(OrbitContinuation, WithoutBacklashTheOrbitEndsOnTheStabilityBoundary) {
  const IdealLoop<double> loop = test::kollar_loop(0.01, 0.0);
  const auto path = along(loop, differential_gain);
  const auto stable = stable_differential_gains(
      characteristic_polynomial(sampled_loop(loop.plant, loop.sampling)), -557.0);
  const PeriodicOrbit orbit = orbit_of(loop);
  const BranchEnd below = continue_orbit(path, orbit, -13.0, -30.0);
  const BranchEnd above = continue_orbit(path, orbit, -13.0, 10.0);
  EXPECT_EQ(below.outcome, BranchEndOutcome::unit_circle);
  EXPECT_NEAR(below.parameter, stable.front().lower, 1e-9);
  EXPECT_NEAR(above.parameter, stable.front().upper, 1e-9);
  EXPECT_NEAR(below.multiplier.log_modulus, 0.0, 1e-9);
}

TEST(OrbitContinuation, ACollisionIsWhereTheOrbitIsNoLongerFound) {
  const IdealLoop<double> loop = test::kollar_loop(0.01, 0.002);
  const PeriodicOrbit orbit = orbit_of(loop);
  EXPECT_GT(orbit.border_share(), near_border);
  const auto path = along(loop, backlash_width);
  const ItineraryMaps<double> maps(loop, orbit.ratio);
  for (const double to : {0.0, 0.01}) {
    const BranchEnd end = continue_orbit(path, orbit, 0.002, to);
    ASSERT_EQ(end.outcome, BranchEndOutcome::border_collision);
    EXPECT_NEAR(end.border.distance, 0.0, 1e-15);
    const double outward = to > 0.002 ? 1.0 : -1.0;
    const auto beyond = [&](double by) {
      const double width = end.parameter + outward * by;
      return orbit_of_itinerary(path(width), orbit.ratio, maps, orbit.itinerary,
                                Backlash<double>(width, orbit.memory));
    };
    EXPECT_EQ(beyond(-1e-9).outcome, OrbitOutcome::certified);
    EXPECT_EQ(beyond(1e-9).outcome, OrbitOutcome::not_reproduced);
    const OrbitResult last = beyond(-1e-8);
    ASSERT_EQ(last.outcome, OrbitOutcome::certified);
    EXPECT_GT(last.orbit->border_share(), 0.0);
    EXPECT_LT(last.orbit->border_share(), near_border);
  }
}

TEST(OrbitContinuation, MotionAndForceScaleTogether) {
  const IdealLoop<double> loop = test::kollar_loop(0.001, 0.002);
  const PeriodicOrbit orbit = orbit_of(loop);
  const BranchEnd wider = continue_orbit(along(loop, backlash_width), orbit, 0.002, 0.003);
  const BranchEnd weaker = continue_orbit(along(loop, force), orbit, 0.5, 0.3);
  EXPECT_NEAR(weaker.parameter / 0.5, 0.002 / wider.parameter, 1e-10);
  // The orbit is its own mirror image half a period later: it meets two surfaces at once, and
  // rounding says which is named.
  EXPECT_EQ((wider.border.sample - weaker.border.sample) % (orbit.period_samples() / 2), 0);
}

TEST(OrbitContinuation, AnOrbitThatStaysInTheGapEndsWhereNoGapHoldsIt) {
  const IdealLoop<double> loop = test::kollar_loop(0.001, 0.003);
  const PeriodicOrbit orbit = orbit_of(loop);
  ASSERT_EQ(orbit.engaged_fraction(), 0.0);
  double lowest = 1.0, highest = -1.0;
  for (const auto& state : orbit.states) {
    lowest = std::min(lowest, state[2] - state[0]);
    highest = std::max(highest, state[2] - state[0]);
  }
  const BranchEnd by_width = continue_orbit(along(loop, backlash_width), orbit, 0.003, 0.001);
  const BranchEnd by_force = continue_orbit(along(loop, force), orbit, 0.5, 2.0);
  EXPECT_EQ(by_width.outcome, BranchEndOutcome::border_collision);
  EXPECT_NEAR(by_width.parameter, highest - lowest, 1e-12);
  EXPECT_NEAR(by_force.parameter / 0.5, 0.003 / by_width.parameter, 1e-9);
}

TEST(OrbitContinuation, ReachesTheEndOfARangeWithoutAnEnd) {
  const IdealLoop<double> loop = test::kollar_loop(0.01, 0.002);
  const auto path = along(loop, differential_gain);
  const BranchEnd end = continue_orbit(path, orbit_of(loop), -13.0, -13.5);
  EXPECT_EQ(end.outcome, BranchEndOutcome::range_end);
  EXPECT_EQ(end.parameter, -13.5);
}

TEST(OrbitContinuation, RefusesAFamilyThatChangesTheCommonPeriod) {
  const IdealLoop<double> loop = test::kollar_loop(0.01, 0.002);
  const auto path = along(loop, [](auto& of) -> double& { return of.sampling.period; });
  EXPECT_THROW(continue_orbit(path, orbit_of(loop), 0.01, 0.011), InvalidParameter);
}

TEST(OrbitContinuation, RefusesAFamilyThatTakesTheBacklashAway) {
  const IdealLoop<double> loop = test::kollar_loop(0.01, 0.002);
  const auto path = [&](double width) {
    IdealLoop<double> other = loop;
    other.backlash_width = width == 0.002 ? width : 0.0;
    return other;
  };
  EXPECT_THROW(continue_orbit(path, orbit_of(loop), 0.002, 0.003), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
