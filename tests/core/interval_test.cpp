#include "holdfast/core/interval.hpp"

#include "support/testing.hpp"

namespace holdfast {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

TEST(Interval, IsOpenAtBothEnds) {
  const Interval<double> interval{1.0, 2.0};
  EXPECT_FALSE(interval.contains(1.0));
  EXPECT_FALSE(interval.contains(2.0));
  EXPECT_TRUE(interval.contains(std::nextafter(1.0, 2.0)));
  EXPECT_TRUE(interval.contains(std::nextafter(2.0, 1.0)));
}

TEST(Interval, HoldsTheWholeLineUnlessToldOtherwise) {
  for (const double value : {-1e308, 0.0, 1e308}) EXPECT_TRUE(Interval<double>{}.contains(value));
}

TEST(Interval, ContainsNoNan) {
  EXPECT_FALSE(Interval<double>{}.contains(std::numeric_limits<double>::quiet_NaN()));
}

TEST(Interval, ItsRepresentativeLiesInside) {
  for (const Interval<double> interval : {Interval<double>{1.0, 2.0},
                                          {-2.0, 1e-300},
                                          {-unbounded, unbounded},
                                          {-unbounded, -3e9},
                                          {-unbounded, 3e9},
                                          {-1e17, unbounded},
                                          {1e17, unbounded},
                                          {0.0, unbounded},
                                          {1.0, std::nextafter(std::nextafter(1.0, 2.0), 2.0)}}) {
    EXPECT_TRUE(interval.contains(interval.representative()))
        << interval.lower << ' ' << interval.upper;
  }
}

}  // namespace
}  // namespace holdfast
