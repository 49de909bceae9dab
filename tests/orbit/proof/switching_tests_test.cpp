#include "holdfast/orbit/proof/switching_tests.hpp"

#include "orbit/proof/proved_orbits.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

/// Each test's value at the orbit's own states.
double value_of(const SwitchingTest& test, const PeriodicOrbit& orbit, double width) {
  const auto count = orbit.period_samples();
  const auto at = [&](std::int64_t j) {
    return orbit.states[static_cast<std::size_t>((j % count + count) % count)];
  };
  if (test.is_of_velocity()) return test.sign * relative_velocity(at(test.sample));
  return test.sign *
             (relative_displacement(at(test.sample)) - relative_displacement(at(test.entry))) +
         test.widths * width;
}

/// The distances of `borders_of`, which come by another way, are those of the tests.
TEST(SwitchingTests, AreTheDistancesFromTheSurfaces) {
  for (const auto& [period, width] : {std::pair{0.001, 0.0005}, std::pair{0.001, 0.002},
                                      std::pair{0.01, 0.002}, std::pair{0.011, 0.002}}) {
    const IdealLoop<double> loop = test::proved_loop(period, width);
    const PeriodicOrbit orbit = test::orbit_to_prove(loop);
    const auto pattern = switching_pattern(orbit.states, Backlash<double>(width, orbit.memory));
    std::vector<double> distances;
    detail::for_each_border(
        pattern, orbit.states, width,
        [&](std::size_t, SwitchingSurface, double distance) { distances.push_back(distance); });
    const auto tests = switching_tests(pattern);
    ASSERT_EQ(tests.size(), distances.size());
    for (std::size_t k = 0; k < tests.size(); ++k) {
      EXPECT_NEAR(value_of(tests[k], orbit, width), distances[k], 1e-15);
      EXPECT_GT(distances[k], 0.0);
      EXPECT_LE(tests[k].entry, tests[k].sample);
      EXPECT_GE(tests[k].sample - tests[k].entry, tests[k].is_of_velocity() ? 0 : 1);
    }
  }
}

TEST(SwitchingTests, EntriesAreReversals) {
  const IdealLoop<double> loop = test::proved_loop(0.01, 0.002);
  const PeriodicOrbit orbit = test::orbit_to_prove(loop);
  auto pattern = switching_pattern(orbit.states, Backlash<double>(0.002, orbit.memory));
  EXPECT_TRUE(enters_at_reversals(pattern));
  for (auto& decision : pattern.decisions) {
    if (decision.was_inside || decision.velocity_sign == 0) continue;
    decision.engaged = !decision.engaged;
    EXPECT_FALSE(enters_at_reversals(pattern));
    decision.engaged = !decision.engaged;
  }
}

TEST(SwitchingTests, AreNoneWithoutBacklash) {
  const IdealLoop<double> loop = test::proved_loop(0.001, 0.0);
  const PeriodicOrbit orbit = test::orbit_to_prove(loop);
  EXPECT_TRUE(switching_tests(switching_pattern(orbit.states, Backlash<double>(0.0, orbit.memory)))
                  .empty());
}

}  // namespace
}  // namespace holdfast
