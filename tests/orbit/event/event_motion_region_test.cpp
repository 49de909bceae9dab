#include "holdfast/orbit/event/event_motion_region.hpp"

#include "support/kollar_case.hpp"
#include "support/plain_event_motion.hpp"
#include "support/region_places.hpp"

namespace holdfast {
namespace {

ImplementedLoop exact_loop(double period, double width) {
  ImplementedLoop exact = implemented_loop(test::kollar_loop(period, width));
  exact.switching = Switching::exact;
  return exact;
}

EventOrbit exact_orbit(const ImplementedLoop& loop) {
  const auto found = find_event_orbit(event_motion(loop, Vector<double, 4>::Zero().eval()));
  EXPECT_EQ(found.outcome, OrbitOutcome::certified);
  return *found.orbit;
}

/// (r₀, F) ↦ loop.
auto over_width_and_force(const ImplementedLoop& loop) {
  return [loop](double width, double force) {
    ImplementedLoop other = loop;
    other.backlash.width = width;
    other.digital.force.harmonics.front().amplitude = force;
    return other;
  };
}

TEST(ContinuedOrbit, IsThatWhichTheSearchFinds) {
  const EventOrbit orbit = exact_orbit(exact_loop(0.001, 0.0005));
  for (const double width : {0.00045, 0.00055}) {
    const ImplementedLoop other = exact_loop(0.001, width);
    const auto found = continued_orbit(other, orbit);
    ASSERT_EQ(found.outcome, OrbitOutcome::certified);
    const EventOrbit alone = exact_orbit(other);
    ASSERT_EQ(found.orbit->switches.size(), alone.switches.size());
    for (std::size_t j = 0; j < alone.states.size(); ++j)
      EXPECT_LT((found.orbit->states[j] - alone.states[j]).norm(), 1e-12);
  }
}

TEST(ContinuedOrbit, IsNotReproducedWhereItSwitchesOtherwise) {
  const EventOrbit orbit = exact_orbit(exact_loop(0.001, 0.0022));
  EXPECT_EQ(continued_orbit(exact_loop(0.001, 0.00225), orbit).outcome, OrbitOutcome::certified);
  EXPECT_EQ(continued_orbit(exact_loop(0.001, 0.00226), orbit).outcome,
            OrbitOutcome::not_reproduced);
}

/// (r₀, τ) ↦ loop, f τ = 1/10.
ImplementedLoop tenth_loop(double width, double period) {
  ImplementedLoop loop = exact_loop(period, width);
  loop.digital.force.harmonics.front().frequency = 0.1 / period;
  return loop;
}

std::string word_of(const EventOrbit& orbit) {
  std::string word;
  for (const ContactSwitch& change : orbit.switches) word += test::letter_of(change.mode);
  return word;
}

/// Whether the motion from rest, once it has settled, repeats at every coincidence by this word.
bool comes_to(const std::string& word, const test::PlainLoop& loop) {
  test::PlainEventMotion motion(loop);
  for (int k = 0; k < 400; ++k) motion.step();  // 34 s or more
  const auto before = motion.state();
  motion.begin_record();
  motion.step();
  for (std::size_t k = 0; k < 4; ++k)
    if (std::abs(motion.state()[k] - before[k]) >
        1e-6 * (std::abs(before[k]) + std::abs(before[(k + 2) % 4])))
      return false;
  return test::same_turn(word, motion.word());
}

TEST(ContinuedOrbit, GoesOnFromAGapWhereTheDriveIsEngagedAtNoSample) {
  const EventOrbit orbit = exact_orbit(exact_loop(0.01, 0.00205));
  ASSERT_EQ(orbit.engaged_fraction(), 0.0);
  ASSERT_GT(orbit.entries(ContactMode::engaged), 0);
  for (const double width : {0.00206, 0.00215}) {
    const ImplementedLoop other = exact_loop(0.01, width);
    const auto found = continued_orbit(other, orbit);
    ASSERT_EQ(found.outcome, OrbitOutcome::certified) << width;
    const EventOrbit alone = exact_orbit(other);
    for (std::size_t j = 0; j < alone.states.size(); ++j)
      EXPECT_LT((found.orbit->states[j] - alone.states[j]).norm(), 1e-12);
  }
}

TEST(ContinuedOrbit, PassesTheSampleAtWhichTheDriveCeasesToBeEngaged) {
  // The reversal passes sample 2, which alone was engaged, by a part in a thousand of a period.
  const EventOrbit orbit = exact_orbit(tenth_loop(0.0021429, 0.0115377));
  ASSERT_GT(orbit.engaged_fraction(), 0.0);
  const auto found = continued_orbit(tenth_loop(0.0021414, 0.011541), orbit);
  ASSERT_EQ(found.outcome, OrbitOutcome::certified);
  EXPECT_EQ(found.orbit->engaged_fraction(), 0.0);
  EXPECT_EQ(word_of(*found.orbit).size(), word_of(orbit).size());
}

TEST(EventMotionRegion, IsWhereAPlainSimulationComesToTheSameMotion) {
  const EventOrbit orbit = exact_orbit(tenth_loop(0.002, 0.01));
  const std::string word = word_of(orbit);
  const ParameterWindow window{0.0015, 0.0028, 0.0085, 0.0115};
  const MotionRegion region =
      motion_region(tenth_loop, orbit, window, {0.002, 0.01}, {0.04, 1e-5, 1e-8});
  ASSERT_TRUE(region.closed);
  int inside = 0, outside = 0;
  constexpr int rows = 40, columns = 50;
  for (int cell = 0; cell < rows * columns; ++cell) {
    const PlanePoint at =
        window.at({(cell / columns + 0.5) / rows, (cell % columns + 0.5) / columns});
    // The border is a polygon, which lies within 0.06 steps of it.
    if (test::distance_to_border(region, window, at) < 0.0024) continue;
    const bool is_it = comes_to(word, {at.y, at.x, -557.0, -13.0, 0.5, 0.1 / at.y, 10});
    EXPECT_EQ(is_it, test::encloses(region, at.x, at.y)) << at.x << ' ' << at.y;
    (is_it ? inside : outside) += 1;
  }
  EXPECT_GT(inside, 500);
  EXPECT_GT(outside, 500);
}

TEST(EventMotionRegion, OfAMotionThatMirrorsItselfEndsWhereTheSymmetryBreaks) {
  const PlanePoint start{0.00022333333, 0.01175};
  const EventOrbit orbit = exact_orbit(tenth_loop(start.x, start.y));
  ASSERT_TRUE(detail::mirrors_itself(orbit));
  const MotionRegion region =
      motion_region(tenth_loop, orbit, {0.0002, 0.003, 0.007, 0.013}, start, {0.02, 1e-4, 1e-9});
  ASSERT_TRUE(region.closed);
  int folds = 0;
  for (const auto& point : region.border) {
    if (point.border.kind != BorderKind::fold) continue;
    ++folds;
    // On the inner side, or beyond a jump of the multiplier on the outer one.
    EXPECT_GT(point.border.multiplier.log_modulus, -1e-3);
  }
  EXPECT_GT(folds, 2);
}

TEST(EventMotionRegion, OfBacklashAndForceIsBoundedByRays) {
  const ImplementedLoop loop = exact_loop(0.001, 0.0022);
  const auto family = over_width_and_force(loop);
  const MotionRegion region = motion_region(family, exact_orbit(loop), {0.002, 0.003, 0.4, 0.6},
                                            {0.0022, 0.5}, {0.2, 1e-3, 1e-6});
  ASSERT_TRUE(region.closed);
  int on_border = 0;
  for (const auto& point : region.border) {
    if (point.border.kind == BorderKind::window) continue;
    // A reversal comes to a sample, where the held force jumps: it begins without stick then.
    EXPECT_EQ(point.border.kind, BorderKind::switch_at_sample);
    EXPECT_NEAR(point.x / point.y, 0.0045011506, 1e-7);
    ++on_border;
  }
  EXPECT_GT(on_border, 2);
}

TEST(EventMotionRegion, AtASlidingBorderAReversalBeginsOrEndsToStick) {
  const ImplementedLoop loop = exact_loop(0.001, 0.0018);
  const auto family = [&](double width, double gain) {
    ImplementedLoop other = loop;
    other.backlash.width = width;
    other.digital.gains.differential = gain;
    return other;
  };
  const MotionRegion region = motion_region(family, exact_orbit(loop), {0.0017, 0.0019, -14.0, 0.0},
                                            {0.0018, -13.0}, {0.2, 1e-3, 1e-6});
  ASSERT_TRUE(region.closed);
  int slides = 0;
  for (const auto& point : region.border) {
    if (point.border.kind != BorderKind::sliding) continue;
    ++slides;
    if (point.y > -0.5) continue;
    const auto found = find_event_orbit(
        event_motion(family(point.x, point.y - 1e-5), Vector<double, 4>::Zero().eval()));
    ASSERT_EQ(found.outcome, OrbitOutcome::certified);
    EXPECT_LT(found.orbit->margins.stick_acceleration, 0.01);
    EXPECT_GT(found.orbit->entries(ContactMode::stick), 0);
  }
  EXPECT_GT(slides, 1);
}

}  // namespace
}  // namespace holdfast
