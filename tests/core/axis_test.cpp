#include "holdfast/core/axis.hpp"
#include "holdfast/core/log_axis.hpp"

#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(Axis, IncludesBothEndsExactly) {
  const Axis axis{0.1, 0.7, 7};
  EXPECT_EQ(axis.at(0), 0.1);
  EXPECT_EQ(axis.at(6), 0.7);
}

TEST(Axis, StepsAreEqualToRoundOff) {
  const Axis axis{-557.0, 123.0, 1001};
  const double step = 680.0 / 1000.0;
  for (std::int64_t k = 0; k + 1 < axis.count; ++k) {
    EXPECT_NEAR(axis.at(k + 1) - axis.at(k), step, 1e-12 * 557.0);
  }
}

TEST(Axis, WholeNumbersBetweenWholeEndsStayWhole) {
  const Axis axis{-600.0, 100.0, 701};
  for (std::int64_t k = 0; k < axis.count; ++k) EXPECT_EQ(axis.at(k), static_cast<double>(k - 600));
  EXPECT_EQ((Axis{-0.7, 0.7, 15}.at(7)), 0.0);
  EXPECT_EQ((Axis{0.1, 0.5, 5}.at(2)), 0.3);
}

TEST(Axis, NeverLeavesItsEndsHoweverCloseTheyAre) {
  const Axis axis{0.1, std::nextafter(0.1, 1.0), 50};
  for (std::int64_t k = 0; k < axis.count; ++k) {
    EXPECT_GE(axis.at(k), axis.min);
    EXPECT_LE(axis.at(k), axis.max);
  }
}

TEST(Axis, OneValueIsTheFirst) { EXPECT_EQ((Axis{3.0, 9.0, 1}.at(0)), 3.0); }

/// The first value beyond a bound, against a search through all values; bounds are drawn on the
/// values themselves, a round-off beside them and between them.
TEST(Axis, FirstBeyondABoundIsThatOfASearch) {
  for (const Axis& axis : {Axis{-1.0, 2.0, 31}, Axis{0.1, 0.7, 1000}, Axis{5.0, 5.0, 1},
                           Axis{-1e200, 1e200, 7}, Axis{-1e-12, 3.0, 12345}}) {
    const auto search = [&axis](double bound, bool equal_counts) {
      std::int64_t index = 0;
      while (index < axis.count &&
             (equal_counts ? axis.at(index) < bound : axis.at(index) <= bound)) {
        ++index;
      }
      return index;
    };
    for (std::int64_t k = 0; k < axis.count; k += 1 + axis.count / 50) {
      const double value = axis.at(k), next = axis.at(std::min(k + 1, axis.count - 1));
      for (const double bound : {value, std::nextafter(value, 1e300), std::nextafter(value, -1e300),
                                 value / 2 + next / 2, -1e301, 1e301}) {
        EXPECT_EQ(axis.first_above(bound), search(bound, false)) << axis.count << ' ' << bound;
        EXPECT_EQ(axis.first_not_below(bound), search(bound, true)) << axis.count << ' ' << bound;
      }
    }
  }
}

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
