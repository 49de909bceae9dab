#include "holdfast/orbit/proof/switching_tests.hpp"
#include "holdfast/orbit/proof/segment_of_loops.hpp"

#include "orbit/proof/proved_orbits.hpp"
#include "support/random.hpp"

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

bool holds(const Enclosure& enclosure, long double value) {
  return static_cast<long double>(enclosure.lower()) <= value &&
         value <= static_cast<long double>(enclosure.upper());
}

IdealLoop<double> between(const IdealLoop<double>& a, const IdealLoop<double>& b, double share) {
  IdealLoop<double> loop = a;
  const auto mixed = [share](double x, double y) { return x + share * (y - x); };
  loop.gains = {mixed(a.gains.proportional, b.gains.proportional),
                mixed(a.gains.differential, b.gains.differential)};
  loop.excitation.amplitude = mixed(a.excitation.amplitude, b.excitation.amplitude);
  loop.backlash_width = mixed(a.backlash_width, b.backlash_width);
  return loop;
}

/// The maps of extended precision of any loop between lie within those of the segment, and near
/// the ends of what they say of the loop's position.
TEST(SegmentOfLoops, HoldsEveryLoopBetween) {
  const IdealLoop<double> first = test::proved_loop(0.01, 0.001, 0.004);
  IdealLoop<double> last = first;
  last.gains = {-500.0, -11.0};
  last.excitation.amplitude = 0.7;
  last.backlash_width = 0.003;
  const Rational ratio{1, 10};
  const detail::SegmentOfLoops segment(enclosed(first), enclosed(last), ratio);
  for (const double share : {0.0, 0.3, 0.5, 1.0}) {
    const IdealLoop<double> loop = between(first, last, share);
    const ItineraryMaps<long double> maps(converted<long double>(loop), ratio);
    const Enclosure s = Enclosure(share - 0.5) + Enclosure(-1e-15, 1e-15);
    EXPECT_TRUE(holds(segment.width().centre + s * segment.width().slope, loop.backlash_width));
    EXPECT_TRUE(segment.position().contains(share - 0.5));
    for (const std::uint8_t engaged : {std::uint8_t{0}, std::uint8_t{1}}) {
      const Matrix<long double, 5> exact = maps.map_in_units(engaged != 0);
      const auto& map = segment.map(engaged);
      for (Eigen::Index k = 0; k < 25; ++k) {
        EXPECT_TRUE(holds(map.centre(k) + s * map.slope(k), exact(k))) << share << ' ' << k;
        if (share == 0.0 || share == 1.0) {
          const auto& end = share == 0.0 ? segment.ends().front() : segment.ends().back();
          EXPECT_TRUE(holds(end.at(engaged)(k), exact(k))) << k;
        }
      }
    }
    for (std::size_t j = 0; j < 20; ++j) {
      const auto addition = segment.addition(j);
      const Vector<long double, 4> exact =
          maps.additions()[j % 10].cwiseQuotient(maps.units().head<4>());
      for (Eigen::Index k = 0; k < 4; ++k)
        EXPECT_TRUE(holds(addition.centre[k] + s * addition.slope[k], exact[k])) << share;
    }
  }
}

TEST(SegmentOfLoops, OfOneLoopHasNoSlope) {
  IdealLoop<double> loop = test::proved_loop(0.001, 0.0);
  loop.hold = ForceHold::exact;
  const detail::SegmentOfLoops segment(enclosed(loop), Rational{1, 100});
  EXPECT_FALSE(segment.has_backlash());
  const ItineraryMaps<long double> maps(converted<long double>(loop), Rational{1, 100});
  for (std::size_t j = 0; j < 100; ++j) {
    const auto addition = segment.addition(j);
    const Vector<long double, 4> exact = maps.additions()[j].cwiseQuotient(maps.units().head<4>());
    for (Eigen::Index k = 0; k < 4; ++k) {
      EXPECT_TRUE(holds(addition.centre[k], exact[k]));
      EXPECT_EQ(addition.slope[k], Enclosure());
    }
  }
}

}  // namespace
}  // namespace holdfast
