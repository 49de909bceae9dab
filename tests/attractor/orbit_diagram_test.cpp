#include "holdfast/attractor/orbit_diagram.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "support/kollar_case.hpp"
#include "support/message_of.hpp"

namespace holdfast {
namespace {

ForcedLoop<double> diagram_loop(double period, double width) {
  return {kollar2022_plant(), {period, 0.0}, {-557.0, -13.0}, {0.5, 10.0}, width};
}

/// z₁ of the strobes of one value and way, rounded to a nanometre.
std::set<long> levels(const std::vector<StrobePoint>& points, std::size_t index, bool upward) {
  std::set<long> result;
  for (const StrobePoint& point : points)
    if (point.index == index && point.upward == upward)
      result.insert(std::lround(point.state[0] * 1e9));
  return result;
}

std::vector<StrobePoint> diagram_of(double period, const std::vector<double>& widths,
                                    const DiagramQuestion& question) {
  std::vector<StrobePoint> points;
  run_orbit_diagram([&](double width) { return diagram_loop(period, width); }, widths,
                    Vector<double, 4>::Zero(), question,
                    [&](const StrobePoint& point) { points.push_back(point); });
  return points;
}

TEST(OrbitDiagram, ShowsAsManyLevelsAsTheOrbitHasForcingPeriods) {
  const auto points = diagram_of(0.001, {0.0, 0.0005, 0.002}, {40.0, 30});
  EXPECT_EQ(points.size(), 2U * 3U * 30U);
  for (const bool upward : {true, false}) {
    EXPECT_EQ(levels(points, 0, upward).size(), 1U);
    EXPECT_EQ(levels(points, 1, upward).size(), 1U);
    EXPECT_EQ(levels(points, 2, upward).size(), 5U);
  }
}

TEST(OrbitDiagram, StrobesBetweenTheSamplesAreThoseOfTheLinearResponse) {
  // 9 ms does not divide the forcing period of 0.1 s, so most strobes fall between samples; the
  // period of the motion is nine forcing periods all the same.
  const auto points = diagram_of(0.009, {0.0}, {60.0, 18});
  std::vector<double> upward;
  for (const StrobePoint& point : points)
    if (point.upward) upward.push_back(point.state[0]);
  ASSERT_EQ(upward.size(), 18U);
  for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(upward[k], upward[k + 9], 1e-12);
}

TEST(OrbitDiagram, AMotionThatDivergesShowsNothingAndTheNextBeginsAnew) {
  std::vector<StrobePoint> points;
  const auto path = [](double delay) {
    return ForcedLoop<double>{
        kollar2022_plant(), {0.011, delay}, {-557.0, -13.0}, {0.5, 10.0}, 0.0};
  };
  run_orbit_diagram(path, {0.011, 0.0}, Vector<double, 4>::Zero(), {60.0, 5},
                    [&](const StrobePoint& point) { points.push_back(point); });
  EXPECT_EQ(points.size(), 10U);
  for (const StrobePoint& point : points) EXPECT_EQ(point.index, 1U);
}

TEST(OrbitDiagram, RefusesWhatIsNotAdmissible) {
  EXPECT_THROW(validate(DiagramQuestion{-1.0, 5}), InvalidParameter);
  EXPECT_THROW(validate(DiagramQuestion{1.0, 0}), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
