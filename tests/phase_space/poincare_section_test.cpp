#include "holdfast/phase_space/poincare_section.hpp"
#include "holdfast/plant/two_mass.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "holdfast/orbit/orbit_search.hpp"
#include "support/kollar_case.hpp"

namespace holdfast {
namespace {

std::vector<SectionPoint> section_of(const ForcedLoop<double>& loop, std::int64_t samples) {
  std::vector<SectionPoint> points;
  auto motion = harmonically_forced_motion(loop, Vector<double, 4>::Zero().eval());
  run_section(loop, motion, samples, [&](const SectionPoint& point) { points.push_back(point); });
  return points;
}

TEST(PoincareSection, PointsLieOnItAndTheirDirectionsAlternate) {
  for (const double delay : {0.0, 0.004, 0.011}) {
    ForcedLoop<double> loop{kollar2022_plant(), {0.011, delay}, {-100.0, -2.0}, {0.5, 10.0}, 0.002};
    const auto points = section_of(loop, 3000);
    ASSERT_GT(points.size(), 300U);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const SectionPoint& point = points[k];
      EXPECT_NEAR(point.state[3], point.state[1], 1e-9) << point.time;
      if (k == 0) continue;
      EXPECT_GT(point.time, points[k - 1].time);
      EXPECT_NE(point.rising, points[k - 1].rising);
    }
  }
}

TEST(PoincareSection, RepeatsWithThePeriodOfTheOrbit) {
  const ForcedLoop<double> loop{
      kollar2022_plant(), {0.01, 0.0}, {-557.0, -13.0}, {0.5, 10.0}, 0.002};
  const auto found = find_periodic_orbit(loop, Vector<double, 4>::Zero());
  ASSERT_EQ(found.outcome, OrbitOutcome::certified);
  const auto points = section_of(loop, 6000);
  const double period = found.orbit->period();
  std::size_t in_one_period = 0;
  while (points[points.size() - 1 - in_one_period].time > points.back().time - period + 1e-7)
    ++in_one_period;
  for (std::size_t k = points.size() - 100; k < points.size(); ++k) {
    const SectionPoint& earlier = points[k - in_one_period];
    EXPECT_NEAR(points[k].time - earlier.time, period, 1e-9);
    EXPECT_LE((points[k].state - earlier.state).norm(), 1e-9);
  }
}

TEST(PoincareSection, ADivergingMotionEnds) {
  const ForcedLoop<double> loop{
      kollar2022_plant(), {0.011, 0.011}, {-557.0, -13.0}, {0.5, 10.0}, 0.0};
  auto motion = harmonically_forced_motion(loop, Vector<double, 4>::Zero().eval());
  EXPECT_EQ(run_section(loop, motion, 100000, [](const SectionPoint&) {}),
            TrajectoryOutcome::diverged);
}

}  // namespace
}  // namespace holdfast
