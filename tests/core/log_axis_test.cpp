#include "holdfast/core/log_axis.hpp"

#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(LogAxis, HasItsEndsExactlyAndEqualRatiosBetween) {
  const LogAxis axis{1e-4, 0.03, 25};
  EXPECT_EQ(axis.at(0), 1e-4);
  EXPECT_EQ(axis.at(24), 0.03);
  const double ratio = std::pow(300.0, 1.0 / 24.0);
  for (int i = 1; i < 25; ++i) EXPECT_NEAR(axis.at(i) / axis.at(i - 1), ratio, 1e-13 * ratio);
}

TEST(LogAxis, OfDecadesGivesDecades) {
  const LogAxis axis{1e-3, 1e3, 7};
  for (int i = 0; i < 7; ++i) EXPECT_NEAR(axis.at(i), std::pow(10.0, i - 3), 1e-14 * axis.at(i));
}

TEST(LogAxis, OfOneValueIsItsLowerEnd) { EXPECT_EQ((LogAxis{2.0, 5.0, 1}).at(0), 2.0); }

TEST(LogAxis, GoesThroughTheWholeRangeOfDoubles) {
  const LogAxis axis{std::numeric_limits<double>::min(), std::numeric_limits<double>::max(), 3};
  EXPECT_TRUE(std::isfinite(axis.at(1)));
  EXPECT_NEAR(std::log(axis.at(1)), 0.5 * (std::log(axis.min) + std::log(axis.max)), 1e-12);
}

TEST(LogAxis, NeverLeavesItsEnds) {
  const LogAxis axis{0.1, 0.1 * (1.0 + 4.0 * std::numeric_limits<double>::epsilon()), 1000};
  for (int i = 0; i < 1000; ++i) {
    EXPECT_GE(axis.at(i), axis.min);
    EXPECT_LE(axis.at(i), axis.max);
  }
}

}  // namespace
}  // namespace holdfast
