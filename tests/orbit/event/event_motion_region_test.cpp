#include "holdfast/orbit/event/event_motion_region.hpp"

#include "support/kollar_case.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

ImplementedLoop exact_loop(double period, double width) {
  IdealLoop<double> loop{kollar2022_plant(), {period, 0.0}, {-557.0, -13.0}, {0.5, 10.0}, width};
  ImplementedLoop exact = implemented_loop(loop);
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
