#include "holdfast/orbit/region_of_attraction.hpp"

#include "holdfast/orbit/orbit_search.hpp"
#include "support/kollar_case.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

using AttractionMemory = MotionMemory<double, BacklashMemory<double>>;

std::vector<IdealLoop<double>> attraction_loops() {
  return {test::kollar_loop(0.001, 0.0005),    test::kollar_loop(0.001, 0.002),
          test::kollar_loop(0.01, 0.002),      test::kollar_loop(0.011, 0.002),
          test::kollar_loop(0.003, 0.002),     test::kollar_loop(0.001, 0.003),
          test::kollar_loop(0.01, 0.002, 0.5), test::kollar_loop(0.01, 0.001),
          test::kollar_loop(0.012, 0.001),     test::kollar_loop(0.005, 0.001, 0.3),
          test::kollar_loop(0.02, 0.004),      test::kollar_loop(0.015, 0.001)};
}

PeriodicOrbit certified_orbit(const IdealLoop<double>& loop) {
  const OrbitResult result = find_periodic_orbit(loop, Vector<double, 4>::Zero(), {20000, 0});
  EXPECT_EQ(result.outcome, OrbitOutcome::certified) << loop.sampling.period;
  return result.orbit.value();
}

Vector<double, 6> random_direction(test::Random& random) {
  Vector<double, 6> direction;
  for (double& entry : direction) entry = random.normal();
  return direction.normalized();
}

/// A motion that deviates from a point by `share` of its radius.
AttractionMemory deviating(const AttractionBall& point, const Vector<double, 6>& weights,
                           const Vector<double, 6>& direction, double share) {
  AttractionMemory motion{point.state.head<4>(), point.state[4], point.memory};
  const double radius = share * attraction_radius(point, motion.backlash);
  const Vector<double, 6> deviation = radius * direction.cwiseQuotient(weights);
  motion.state += deviation.head<4>();
  motion.previous_force += deviation[4];
  if (!point.stays_inside) {
    motion.backlash.lower += deviation[5];
    motion.backlash.upper += deviation[5];
  }
  return motion;
}

struct Pursuit {
  bool same_itinerary;
  double distance;  ///< to the orbit in the end
};

/// Follows a motion for whole periods of the orbit.
Pursuit pursue(const IdealLoop<double>& loop, const PeriodicOrbit& orbit,
               const AttractionBall& point, const AttractionMemory& start, std::size_t periods) {
  auto motion = periodically_forced_motion(loop, orbit.ratio, Vector<double, 4>::Zero().eval());
  motion.restore(start);
  const std::size_t samples = orbit.itinerary.size(),
                    first = static_cast<std::size_t>(point.sample);
  for (std::size_t j = 0; j < periods * samples; ++j) {
    const bool engaged = orbit.itinerary[(first + j) % samples] != 0;
    if (motion.sense().engaged != engaged) return {false, 0.0};
    motion.advance();
  }
  return {true, (motion.state() - orbit.states[first].head<4>()).cwiseAbs().maxCoeff()};
}

/// What decides the contact of a sample, as far as a small deviation moves it.
struct AttractionDecision {
  bool inside;
  double velocity;  ///< Δż
  double height;    ///< Δz over the lower end of the gap
};

AttractionDecision take_decision(PeriodicallyForcedMotion<double>& motion, double& lower) {
  const Vector<double, 4> state = motion.state();
  lower = motion.law().lower();
  const AttractionDecision decision{motion.law().inside(), state[3] - state[1],
                                    state[2] - state[0] - lower};
  motion.sense();
  motion.advance();
  return decision;
}

/// The radius of the largest ball in which no decision of some periods changes: motions that
/// deviate along the six axes give the gradient of what decides, their contacts being the orbit's.
double largest_radius(const IdealLoop<double>& loop, const PeriodicOrbit& orbit,
                      const AttractionBall& point, std::size_t periods) {
  const auto weights = deviation_weights(loop);
  const double small = 1e-3 * attraction_radius(point, point.memory), width = loop.backlash_width;
  std::vector<PeriodicallyForcedMotion<double>> motions(
      7, periodically_forced_motion(loop, orbit.ratio, Vector<double, 4>::Zero().eval()));
  for (Eigen::Index axis = 0; axis < 7; ++axis) {
    const double share = axis < 6 ? 1e-3 : 0.0;
    const Vector<double, 6> direction = Vector<double, 6>::Unit(axis % 6);
    motions[static_cast<std::size_t>(axis)].restore(deviating(point, weights, direction, share));
  }
  double largest = std::numeric_limits<double>::infinity(), lower = 0.0;
  for (std::size_t j = 0; j < periods * orbit.itinerary.size(); ++j) {
    const AttractionDecision here = take_decision(motions[6], lower);
    Vector<double, 6> velocity, height;
    for (Eigen::Index axis = 0; axis < 6; ++axis) {
      const auto moved = take_decision(motions[static_cast<std::size_t>(axis)], lower);
      velocity[axis] = (moved.velocity - here.velocity) / small;
      height[axis] = (moved.height - here.height) / small;
    }
    if (!(here.inside && motions[6].law().inside()) && width > 0.0)
      largest = std::min(largest, std::abs(here.velocity) / velocity.norm());
    if (here.inside) {
      const double distance = std::min(std::abs(here.height), std::abs(width - here.height));
      largest = std::min(largest, distance / height.norm());
    }
  }
  return largest;
}

/// So many that the slowest deviation falls by a factor of 1e7.
std::size_t periods_to_settle(const PeriodicOrbit& orbit) {
  return static_cast<std::size_t>(2.0 - 16.0 / orbit.multipliers.front().log_modulus);
}

TEST(RegionOfAttraction, NoDecisionOfAnyMotionOfANeighbourhoodEverChanges) {
  // And the neighbourhood is no less than a fiftieth of the largest one.
  for (const IdealLoop<double>& loop : attraction_loops()) {
    const PeriodicOrbit orbit = certified_orbit(loop);
    for (const AttractionBall& point : attraction_balls(loop, orbit)) {
      const double truth = largest_radius(loop, orbit, point, periods_to_settle(orbit));
      const double radius = attraction_radius(point, point.memory);
      EXPECT_LE(radius, truth * (1.0 + 1e-5)) << loop.sampling.period << ' ' << point.sample;
      EXPECT_GE(radius, 0.02 * truth) << loop.sampling.period << ' ' << point.sample;
    }
  }
}

TEST(RegionOfAttraction, EveryMotionOfANeighbourhoodComesToTheOrbit) {
  test::Random random(821);
  for (const IdealLoop<double>& loop : attraction_loops()) {
    const PeriodicOrbit orbit = certified_orbit(loop);
    const auto weights = deviation_weights(loop);
    const auto points = attraction_balls(loop, orbit);
    ASSERT_FALSE(points.empty()) << loop.sampling.period;
    for (std::size_t trial = 0; trial < 60; ++trial) {
      const AttractionBall& point = points[trial % points.size()];
      const auto start = deviating(point, weights, random_direction(random), 0.999);
      ASSERT_TRUE(attracts(point, start, weights));
      const Pursuit found = pursue(loop, orbit, point, start, periods_to_settle(orbit));
      ASSERT_TRUE(found.same_itinerary) << loop.sampling.period << ' ' << point.sample;
      EXPECT_LT(found.distance, 1e-6 * point.state.head<4>().norm()) << loop.sampling.period;
    }
  }
}

TEST(RegionOfAttraction, AnotherSideOrDirectionOfTheDriveIsNotAttracted) {
  const IdealLoop<double> loop = test::kollar_loop(0.01, 0.002);
  const auto weights = deviation_weights(loop);
  for (const AttractionBall& point : attraction_balls(loop, certified_orbit(loop))) {
    AttractionMemory motion = deviating(point, weights, Vector<double, 6>::Zero(), 0.0);
    EXPECT_TRUE(attracts(point, motion, weights));
    motion.backlash.inside = !motion.backlash.inside;
    EXPECT_FALSE(attracts(point, motion, weights));
    motion.backlash = point.memory;
    motion.backlash.previous_velocity *= -1.0;
    EXPECT_EQ(attracts(point, motion, weights), point.memory.inside);
    motion.backlash = point.memory;
    motion.state[0] += 1.001 * point.radius;
    EXPECT_FALSE(attracts(point, motion, weights));
  }
}

TEST(RegionOfAttraction, AnOrbitThatStaysInsideDoesSoInAnyGapThatHoldsIt) {
  const IdealLoop<double> loop = test::kollar_loop(0.001, 0.003);
  const auto weights = deviation_weights(loop);
  const PeriodicOrbit orbit = certified_orbit(loop);
  for (AttractionBall point : attraction_balls(loop, orbit)) {
    ASSERT_TRUE(point.stays_inside);
    const double room = loop.backlash_width - (point.highest - point.lowest);
    ASSERT_GT(room, 0.0);
    test::Random random(823);
    for (int trial = 0; trial < 40; ++trial) {
      point.memory.lower = point.lowest - random.unit() * room;
      point.memory.upper = point.memory.lower + loop.backlash_width;
      const auto start = deviating(point, weights, random_direction(random), 0.999);
      ASSERT_TRUE(attracts(point, start, weights));
      EXPECT_TRUE(pursue(loop, orbit, point, start, 50).same_itinerary);
    }
    point.memory.lower = point.lowest + 1e-6;
    EXPECT_LE(attraction_radius(point, point.memory), 0.0) << "the gap does not hold the orbit";
  }
}

TEST(RegionOfAttraction, WithoutBacklashEveryMotionOfAStableLoopIsAttracted) {
  const IdealLoop<double> loop = test::kollar_loop(0.01, 0.0);
  const PeriodicOrbit orbit = certified_orbit(loop);
  const auto points = attraction_balls(loop, orbit);
  ASSERT_FALSE(points.empty());
  for (const AttractionBall& point : points) EXPECT_EQ(point.radius, HUGE_VAL);
}

}  // namespace
}  // namespace holdfast
