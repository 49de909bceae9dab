#include "holdfast/core/axis.hpp"

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

}  // namespace
}  // namespace holdfast
