#include "holdfast/core/axis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

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
}

TEST(Axis, NeverLeavesItsEndsHoweverCloseTheyAre) {
  const Axis axis{0.1, std::nextafter(0.1, 1.0), 50};
  for (std::int64_t k = 0; k < axis.count; ++k) {
    EXPECT_GE(axis.at(k), axis.min);
    EXPECT_LE(axis.at(k), axis.max);
  }
}

TEST(Axis, OneValueIsTheFirst) { EXPECT_EQ((Axis{3.0, 9.0, 1}.at(0)), 3.0); }

}  // namespace
}  // namespace holdfast
