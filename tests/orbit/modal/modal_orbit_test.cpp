// Periodic orbits of a conductor by its modes, against the motion itself and against the dense way.

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/control/controlled_plant.hpp"
#include "holdfast/orbit/event/event_orbit_search.hpp"
#include "holdfast/orbit/modal/modal_orbit_search.hpp"
#include "support/move_samples.hpp"
#include "support/string_case.hpp"

namespace holdfast::test {
namespace {

ModalLoop loop_of(int modes, const Sampling<double>& sampling, double differential_gain,
                  double play, ForceHold hold) {
  return {papers_modes(modes),
          papers_absorber(0.01),
          sampling,
          {-557.0, differential_gain},
          {0.5, 10.0},
          play,
          hold};
}

/// Loops of a string whose motion comes to an orbit with play.
std::vector<ModalLoop> loops_with_orbits() {
  return {loop_of(6, {0.001, 0.0}, -2.0, 5e-4, ForceHold::sampled),
          loop_of(3, {0.005, 0.0025}, -4.0, 5e-4, ForceHold::exact),
          loop_of(6, {0.005, 0.005}, -2.0, 1e-4, ForceHold::sampled),
          loop_of(6, {0.005, 0.0}, -4.0, 1e-4, ForceHold::sampled)};
}

ModalMotion::Full at_rest(const ModalLoop& loop) {
  return ModalMotion::Full::Zero(2 * static_cast<Eigen::Index>(loop.modes.size()) + 2);
}

PeriodicOrbit certified_orbit(const ModalLoop& loop, const ModalMotion::Full& state) {
  const OrbitResult found = find_periodic_orbit(loop, state, {20000, 0, {}});
  EXPECT_EQ(found.outcome, OrbitOutcome::certified);
  return *found.orbit;
}

PeriodicOrbit certified_orbit(const ModalLoop& loop) {
  return certified_orbit(loop, at_rest(loop));
}

ModalItineraryMaps maps_of(const ModalLoop& loop, const PeriodicOrbit& orbit) {
  return {loop, plant_poles(loop.modes, loop.absorber), orbit.ratio};
}

TEST(ModalOrbit, IsWhereTheMotionComesTo) {
  for (const ModalLoop& loop : loops_with_orbits()) {
    const PeriodicOrbit orbit = certified_orbit(loop);
    EXPECT_GT(orbit.engaged_fraction(), 0.0);
    EXPECT_LT(orbit.engaged_fraction(), 1.0);
    ModalMotion motion = *modal_motion(loop, at_rest(loop));
    const std::int64_t samples = orbit.period_samples();
    // What it takes to be drawn in, and then to fall by 10¹².
    const auto periods =
        20000 / samples + static_cast<std::int64_t>(-28.0 / orbit.multipliers[0].log_modulus);
    move_samples(motion, periods * samples);
    // The motion comes to one of the copies of the orbit, each q samples later.
    const std::int64_t step = orbit.ratio.denominator;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::int64_t first = 0; first < samples; first += step) {
      const Vector<double, 4> state = orbit.states[static_cast<std::size_t>(first)].head<4>();
      nearest = std::min(
          nearest, StateScale(orbit.states).share_of(Vector<double, 4>(motion.state() - state)));
    }
    EXPECT_LE(nearest, 1e-9) << samples;
  }
}

TEST(ModalOrbit, IsThatOfTheDensePlant) {
  std::vector<ModalLoop> loops = loops_with_orbits();
  loops.push_back(loop_of(6, {0.005, 0.0025}, -4.0, 0.0, ForceHold::exact));
  loops.push_back(loop_of(6, {0.005, 0.0}, -4.0, 0.0, ForceHold::sampled));
  for (const ModalLoop& loop : loops) {
    const PeriodicOrbit orbit = certified_orbit(loop);
    const DigitalLoop digital{
        loop.sampling, {0.0, 0.0}, multi_harmonic_force(loop.excitation), loop.hold};
    const ImplementedLoopOf<ControlledPlant> dense{
        with_controller(modal_plant(loop.modes, loop.absorber), loop.gains),
        digital,
        {ContactLaw::kollar, loop.backlash_width},
        Switching::sampled};
    const auto found = find_event_orbit(event_motion(dense, at_rest(loop)), {20000, 0, {}});
    ASSERT_EQ(found.outcome, OrbitOutcome::certified);
    ASSERT_EQ(found.orbit->period_samples(), orbit.period_samples());
    EXPECT_NEAR(found.orbit->amplitude(), orbit.amplitude(), 1e-9 * orbit.amplitude());
    EXPECT_EQ(found.orbit->engaged_fraction(), orbit.engaged_fraction());
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(found.orbit->multipliers[i].log_modulus, orbit.multipliers[i].log_modulus, 1e-8)
          << i;
  }
}

/// What decides the contacts of a motion that follows an orbit's itinerary, sample by sample: Δż
/// where it counts, and Δz over the lower end of the gap where the drive was inside.
struct Decisions {
  bool same = true;
  std::vector<double> velocity, height;
};

Decisions decisions_of(const ModalLoop& loop, const ModalItineraryMaps& maps,
                       const PeriodicOrbit& orbit, const Eigen::VectorXd& first, double gap) {
  std::vector<Vector<double, 5>> states(orbit.states.size());
  maps.follow(first, orbit.itinerary, states);
  BacklashMemory<double> memory = orbit.memory;
  memory.lower += gap;
  memory.upper += gap;
  Backlash<double> law(loop.backlash_width, memory);
  Decisions decisions;
  for (std::size_t j = 0; j < states.size(); ++j) {
    const double displacement = relative_displacement(states[j]),
                 velocity = relative_velocity(states[j]);
    const bool inside = law.inside();
    decisions.height.push_back(inside ? displacement - law.lower() : NAN);
    const bool engaged = law.step(displacement, velocity);
    decisions.velocity.push_back(inside && !engaged ? NAN : velocity);
    decisions.same = decisions.same && engaged == (orbit.itinerary[j] != 0);
  }
  return decisions;
}

/// The largest ‖R e‖ for which no decision of one period changes: deviations along the axes of R e
/// give the gradient of what decides.
double largest_radius(const ModalLoop& loop, const ModalItineraryMaps& maps,
                      const PeriodicOrbit& orbit, const ModalAttraction& region) {
  const Eigen::Index n = region.root.rows();
  const Eigen::MatrixXd axes = region.root.inverse();
  const double small = 1e-3 * region.radius;
  const auto deviating = [&](const Eigen::VectorXd& e) {
    const Eigen::VectorXd first =
        region.first + Eigen::VectorXd(maps.units().cwiseProduct(e.head(n - 1)));
    return decisions_of(loop, maps, orbit, first, e[n - 1]);
  };
  const Decisions here = deviating(Eigen::VectorXd::Zero(n));
  std::vector<double> velocity(here.velocity.size()), height(here.height.size());
  for (Eigen::Index k = 0; k < n; ++k) {
    const Decisions moved = deviating(small * axes.col(k));
    EXPECT_TRUE(moved.same);
    for (std::size_t j = 0; j < velocity.size(); ++j) {
      velocity[j] += std::pow((moved.velocity[j] - here.velocity[j]) / small, 2);
      height[j] += std::pow((moved.height[j] - here.height[j]) / small, 2);
    }
  }
  double largest = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < velocity.size(); ++j) {
    if (std::isfinite(here.velocity[j]))
      largest = std::min(largest, std::abs(here.velocity[j]) / std::sqrt(velocity[j]));
    if (std::isfinite(here.height[j]))
      largest = std::min(largest, std::min(std::abs(here.height[j]),
                                           std::abs(loop.backlash_width - here.height[j])) /
                                      std::sqrt(height[j]));
  }
  return largest;
}

TEST(ModalAttraction, NoDecisionInItEverChangesAndItReachesToTheFirstThatDoes) {
  for (const ModalLoop& loop : loops_with_orbits()) {
    const PeriodicOrbit orbit = certified_orbit(loop);
    const ModalItineraryMaps maps = maps_of(loop, orbit);
    const auto region = modal_attraction(loop, maps, orbit);
    ASSERT_TRUE(region.has_value());
    const double truth = largest_radius(loop, maps, orbit, *region);
    EXPECT_LE(region->radius, truth * (1.0 + 1e-5));
    EXPECT_GE(region->radius, truth * (1.0 - 1e-5));
  }
}

/// The gap of a drive that is inside is one of the coordinates.
TEST(ModalAttraction, MotionsInItKeepTheContactsAndComeNearer) {
  Random random(4211);
  for (const ModalLoop& loop : loops_with_orbits()) {
    const PeriodicOrbit orbit = certified_orbit(loop);
    const ModalItineraryMaps maps = maps_of(loop, orbit);
    const auto region = modal_attraction(loop, maps, orbit);
    ASSERT_TRUE(region.has_value());
    const Eigen::Index n = region->root.rows();
    std::vector<Vector<double, 5>> states(orbit.states.size());
    for (int trial = 0; trial < 20; ++trial) {
      Eigen::VectorXd e(n);
      for (double& part : e) part = random.uniform(-1.0, 1.0);
      EXPECT_LE((region->root * e).norm() * region->inscribed_share, e.norm());
      if (!orbit.memory.inside) e[n - 1] = 0.0;
      e *= 0.999 * region->radius / (region->root * e).norm();
      const Eigen::VectorXd first =
          region->first + Eigen::VectorXd(maps.units().cwiseProduct(e.head(n - 1)));
      EXPECT_TRUE(decisions_of(loop, maps, orbit, first, e[n - 1]).same);
      if (orbit.memory.inside) continue;
      const Eigen::VectorXd end = maps.follow(first, orbit.itinerary, states);
      Eigen::VectorXd after = Eigen::VectorXd::Zero(n);
      after.head(n - 1) = (end - region->first).cwiseQuotient(maps.units());
      EXPECT_LT((region->root * after).norm(), (region->root * e).norm());
    }
  }
}

/// Of blocks of samples, against one sample after another.
TEST(ModalDeviations, AdvanceByBlocksAsBySamples) {
  const ModalLoop loop = loop_of(5, {0.005, 0.001}, -4.0, 5e-4, ForceHold::sampled);
  ModalDeviations blocks(NaturalMotions(loop, plant_poles(loop.modes, loop.absorber)), loop.gains);
  ModalDeviations samples = blocks;
  Eigen::MatrixXd now = Eigen::MatrixXd::Identity(blocks.order(), blocks.order());
  Random random(4301);
  for (int begun = 0; begun < 200; begun += ModalDeviations::block) {
    std::vector<Eigen::MatrixXd> read;
    for (int j = 0; j < ModalDeviations::block; ++j) {
      const bool engaged = random.index(3) > 0;
      samples.begin(now);
      for (ModalDeviations* deviations : {&blocks, &samples}) {
        if (j % 3 == 0) deviations->read_velocity();
        if (j % 5 == 0) deviations->read_displacement();
        if (deviations == &samples) read.push_back(samples.take_readings());
        deviations->advance(engaged);
      }
      now = samples.columns();
    }
    const Eigen::MatrixXd together = blocks.take_readings();
    Eigen::Index row = 0;
    for (const Eigen::MatrixXd& one : read) {
      EXPECT_LT((together.middleRows(row, one.rows()) - one).norm(), 1e-12 * together.norm());
      row += one.rows();
    }
    EXPECT_EQ(row, together.rows());
    EXPECT_LT((blocks.columns() - now).norm(), 1e-12 * now.norm());
  }
}

/// Of a period that contracts to nothing, against blocks of eight samples of all deviations.
TEST(ModalOrbit, LongPeriodsKeepTheDigitsOfTheirMultipliers) {
  for (const double frequency : {10.0, 10.01, 10.001}) {
    ModalLoop loop = loop_of(3, {0.005, 0.001}, -4.0, 5e-4, ForceHold::sampled);
    loop.excitation.frequency = frequency;
    const OrbitResult found = find_periodic_orbit(loop, at_rest(loop), {1'000'000, 0, {}});
    ASSERT_EQ(found.outcome, OrbitOutcome::certified) << frequency;
    const PeriodicOrbit& orbit = *found.orbit;
    ModalDeviations flow = maps_of(loop, orbit).deviations();
    const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(flow.order(), flow.order());
    std::vector<Eigen::MatrixXd> blocks;
    flow.begin(unit);
    for (std::size_t j = 0; j < orbit.itinerary.size(); ++j) {
      flow.advance(orbit.itinerary[j] != 0, 1);
      if ((j + 1) % 8 != 0 && j + 1 != orbit.itinerary.size()) continue;
      blocks.push_back(flow.columns());
      flow.begin(unit);
    }
    const std::vector<Multiplier> expected = multipliers_of_product(blocks);
    ASSERT_EQ(orbit.multipliers.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const double here = orbit.multipliers[i].log_modulus, there = expected[i].log_modulus;
      if (std::isfinite(there) || std::isfinite(here)) {
        EXPECT_NEAR(here, there, 1e-6 * (1.0 + std::abs(there))) << frequency << ' ' << i;
      }
    }
  }
}

/// A loop whose drive never leaves its gap, since a swing has made a wide one and then died down.
std::pair<ModalLoop, PeriodicOrbit> idle_orbit() {
  ModalLoop loop = loops_with_orbits().front();
  loop.backlash_width = 0.1;
  loop.excitation.amplitude = 0.01;
  ModalMotion::Full swinging = at_rest(loop);
  swinging.head(swinging.size() - 2)(Eigen::seq(0, Eigen::last, 2)) =
      1e-2 * bent_conductor(loop.modes);
  return {loop, certified_orbit(loop, swinging)};
}

TEST(ModalAttraction, OfADriveThatNeverLeavesItsGapCountsClearance) {
  const auto [loop, orbit] = idle_orbit();
  EXPECT_EQ(orbit.engaged_fraction(), 0.0);
  const auto region = modal_attraction(loop, maps_of(loop, orbit), orbit);
  ASSERT_TRUE(region.has_value());
  EXPECT_TRUE(region->stays_inside);
  EXPECT_TRUE(std::isfinite(region->radius));
}

/// An idle drive leaves the natural motions to themselves: each is solved for alone, as all are by
/// their matrix. Of what begins within the region nothing leaves the gap.
TEST(ModalOrbit, OfAnIdleDriveIsSolvedMotionByMotion) {
  const auto [loop, orbit] = idle_orbit();
  ASSERT_TRUE(is_idle(orbit.itinerary));
  const ModalItineraryMaps maps = maps_of(loop, orbit);
  ModalDeviations flow = maps.deviations();
  flow.begin(Eigen::MatrixXd::Identity(flow.order(), flow.order()));
  for (std::size_t j = 0; j < orbit.itinerary.size(); ++j) flow.advance(false);
  const std::vector<Eigen::MatrixXd> whole = {flow.columns()};
  const auto expected = periodic_solution(maps, orbit.itinerary, whole);
  ASSERT_TRUE(expected.has_value());
  const Vector<double, 5> way = expected->states.front() - orbit.states.front();
  EXPECT_LT(way.norm(), 1e-12 * orbit.states.front().norm());
  double largest = 0.0;
  for (const std::complex<double>& value : eigenvalues(whole.front()))
    largest = std::max(largest, std::abs(value));
  EXPECT_NEAR(orbit.multipliers.front().log_modulus, std::log(largest), 1e-9);
  const auto region = modal_attraction(loop, maps, orbit);
  ASSERT_TRUE(region.has_value());
  Random random(20261130);
  for (int k = 0; k < 50; ++k) {
    // A deviation of norm `radius` for a clearance of 1 m.
    Eigen::VectorXd away(maps.units().size() + 1);
    for (double& entry : away) entry = random.uniform(-1.0, 1.0);
    away *= region->radius / (region->root * away).norm();
    ModalItineraryMaps::State state =
        region->first + away.head(maps.units().size()).cwiseProduct(maps.units());
    std::vector<Vector<double, 5>> moved(orbit.itinerary.size());
    maps.follow(state, orbit.itinerary, moved);
    for (std::size_t j = 0; j < moved.size(); ++j)
      EXPECT_LT(std::abs(relative_displacement(Vector<double, 5>(moved[j] - orbit.states[j]))),
                1.0);
  }
}

TEST(ModalOrbit, WithoutBacklashEveryMotionComesToIt) {
  ModalLoop loop = loops_with_orbits().front();
  loop.backlash_width = 0.0;
  const PeriodicOrbit orbit = certified_orbit(loop);
  EXPECT_EQ(orbit.engaged_fraction(), 1.0);
  EXPECT_EQ(modal_attraction(loop, maps_of(loop, orbit), orbit)->radius,
            std::numeric_limits<double>::infinity());
}

TEST(ModalOrbit, SaysWhatItDoesNotFind) {
  ModalLoop loop = loops_with_orbits().front();
  loop.gains = {-557.0, 40.0};
  loop.backlash_width = 0.0;
  EXPECT_EQ(find_periodic_orbit(loop, at_rest(loop)).outcome, OrbitOutcome::diverges);
  loop = loops_with_orbits().front();
  loop.excitation.frequency = 3.14159265358979;
  EXPECT_EQ(find_periodic_orbit(loop, at_rest(loop)).outcome, OrbitOutcome::incommensurate);
  EXPECT_THROW(find_periodic_orbit(loop, at_rest(loop), {0, 0, {}}), InvalidParameter);
}

}  // namespace
}  // namespace holdfast::test
