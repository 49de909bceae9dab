#include "holdfast/phase_space/attractor_set.hpp"
#include "holdfast/orbit/orbit_search.hpp"

#include "support/kollar_case.hpp"

namespace holdfast {
namespace {

PeriodicOrbit attractor_set_orbit(const IdealLoop<double>& loop, double displacement = 0.0) {
  const OrbitResult found = find_periodic_orbit(loop, {displacement, 0.0, 0.0, 0.0}, {20000, 0});
  EXPECT_EQ(found.outcome, OrbitOutcome::certified);
  return found.orbit.value();
}

/// The same motion, begun some common periods later.
PeriodicOrbit begun_later(const PeriodicOrbit& orbit, std::ptrdiff_t common_periods,
                          const IdealLoop<double>& loop) {
  PeriodicOrbit later = orbit;
  const std::ptrdiff_t shift = common_periods * orbit.ratio.denominator;
  std::rotate(later.itinerary.begin(), later.itinerary.begin() + shift, later.itinerary.end());
  std::rotate(later.states.begin(), later.states.begin() + shift, later.states.end());
  later.memory =
      switching_pattern(later.states, Backlash<double>(loop.backlash_width, orbit.memory)).memory;
  return later;
}

/// Where the motion of the orbit's mirror image ends: both signs changed, half a forcing period on.
PeriodicOrbit mirrored(const IdealLoop<double>& loop, const PeriodicOrbit& orbit) {
  auto motion = periodically_forced_motion(loop, orbit.ratio, Vector<double, 4>::Zero().eval());
  const auto half = static_cast<std::size_t>(orbit.ratio.denominator / 2);
  auto from = motion.memory();
  Backlash<double> law(loop.backlash_width, orbit.memory);
  for (std::size_t j = 0; j < half; ++j) {
    const auto& state = orbit.states[j];
    law.step(state[2] - state[0], state[3] - state[1]);
  }
  from.state = -orbit.states[half].head<4>();
  from.previous_force = -orbit.states[half][4];
  from.backlash = law.memory();
  from.backlash.lower = -law.upper();
  from.backlash.upper = -law.lower();
  from.backlash.previous_velocity *= -1.0;
  motion.restore(from);
  const OrbitResult found = detail::orbit_of_motion(loop, orbit.ratio, {20000, 0}, motion);
  EXPECT_EQ(found.outcome, OrbitOutcome::certified);
  return found.orbit.value();
}

TEST(AttractorSet, ACopyBegunLaterIsTheSameOrbit) {
  for (const auto& loop : {test::kollar_loop(0.011, 0.002), test::kollar_loop(0.003, 0.002)}) {
    const PeriodicOrbit orbit = attractor_set_orbit(loop);
    const auto common_periods = orbit.period_samples() / orbit.ratio.denominator;
    AttractorSet attractor_set(loop);
    EXPECT_EQ(attractor_set.add(orbit), 0);
    for (std::ptrdiff_t shift = 0; shift < common_periods; ++shift) {
      const PeriodicOrbit later = begun_later(orbit, shift, loop);
      EXPECT_TRUE(is_phase_shifted_copy(orbit, later)) << shift;
      EXPECT_TRUE(is_phase_shifted_copy(later, orbit)) << shift;
      EXPECT_EQ(attractor_set.add(later), 0);
    }
    EXPECT_EQ(attractor_set.orbits().size(), 1U);
  }
}

TEST(AttractorSet, ACopyThatIsNotOneIsSeen) {
  const auto loop = test::kollar_loop(0.011, 0.002);
  const PeriodicOrbit orbit = attractor_set_orbit(loop);
  PeriodicOrbit other = begun_later(orbit, 3, loop);
  other.states[500][0] += 1e-6;
  EXPECT_FALSE(is_phase_shifted_copy(orbit, other));
}

TEST(AttractorSet, DifferentOrbitsStayApart) {
  const auto loop = test::kollar_loop(0.003, 0.002);
  const PeriodicOrbit first = attractor_set_orbit(loop), second = attractor_set_orbit(loop, 1e-5);
  EXPECT_FALSE(is_phase_shifted_copy(first, second));
  EXPECT_FALSE(is_mirror_image(first, second));
  AttractorSet attractor_set(loop);
  EXPECT_EQ(attractor_set.add(first), 0);
  EXPECT_EQ(attractor_set.add(second), 1);
  EXPECT_EQ(attractor_set.add(first), 0);
}

TEST(AttractorSet, TheMirrorImageIsAMotionOfTheLoopAndKnownAsOne) {
  // Of the first loop's orbit the mirror image is another orbit, of the others' the same.
  for (const auto& loop : {test::kollar_loop(0.003, 0.002), test::kollar_loop(0.001, 0.002),
                           test::kollar_loop(0.01, 0.002), test::kollar_loop(0.01, 0.001)}) {
    const PeriodicOrbit orbit = attractor_set_orbit(loop), image = mirrored(loop, orbit);
    EXPECT_EQ(image.period_samples(), orbit.period_samples());
    EXPECT_TRUE(is_mirror_image(orbit, image)) << loop.sampling.period;
    EXPECT_TRUE(is_mirror_image(image, orbit));
    EXPECT_EQ(is_mirror_image(orbit, orbit), is_phase_shifted_copy(orbit, image));
    EXPECT_EQ(is_mirror_image(orbit, orbit), loop.sampling.period != 0.003);
    EXPECT_NEAR(image.multipliers[0].log_modulus, orbit.multipliers[0].log_modulus, 1e-7);
  }
}

TEST(AttractorSet, AttractsWhatLiesInOneOfItsBalls) {
  const auto loop = test::kollar_loop(0.003, 0.002);
  AttractorSet attractor_set(loop);
  const PeriodicOrbit orbits[] = {attractor_set_orbit(loop), attractor_set_orbit(loop, 1e-5)};
  for (const auto& orbit : orbits) attractor_set.add(orbit);
  for (int number = 0; number < 2; ++number) {
    for (const AttractionBall& point : attraction_balls(loop, orbits[number])) {
      MotionMemory<double, BacklashMemory<double>> motion{point.state.head<4>(), point.state[4],
                                                          point.memory};
      EXPECT_EQ(attractor_set.attracted_by(motion), number);
      motion.state[0] += 0.99 * point.radius;
      EXPECT_EQ(attractor_set.attracted_by(motion), number);
      motion.state[0] += 0.02 * point.radius;
      EXPECT_EQ(attractor_set.attracted_by(motion), -1);
      motion.state[0] = 1.0;
      EXPECT_EQ(attractor_set.attracted_by(motion), -1);
    }
  }
}

}  // namespace
}  // namespace holdfast
