#include "holdfast/core/interval.hpp"
#include "holdfast/core/interval_sets.hpp"

#include "support/random.hpp"
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

using Intervals = std::vector<Interval<double>>;

bool holds(const Intervals& intervals, double x) {
  return std::any_of(intervals.begin(), intervals.end(),
                     [x](const auto& interval) { return interval.contains(x); });
}

TEST(IntervalSets, TheIntersectionHoldsWhatBothHold) {
  const Intervals first{{-2.0, 0.0}, {1.0, 4.0}}, second{{-1.0, 2.0}, {3.0, 9.0}};
  const auto common = intersection(first, second);
  ASSERT_EQ(common.size(), 3U);
  for (double x = -3.0; x < 10.0; x += 0.17) {
    EXPECT_EQ(holds(common, x), holds(first, x) && holds(second, x)) << x;
  }
  EXPECT_TRUE(intersection(first, {}).empty());
  EXPECT_TRUE((intersection<double>({{0.0, 1.0}}, {{1.0, 2.0}}).empty())) << "open at their ends";
}

TEST(IntervalSets, AQuadraticIsNegativeWhereItSaysSo) {
  test::Random random(621);
  int negative = 0;
  for (int draw = 0; draw < 500; ++draw) {
    Vector<double, 3> c = random.matrix<Vector<double, 3>>();
    if (draw % 5 == 0) c[2] = 0.0;
    if (draw % 7 == 0) c[1] = 0.0;
    const auto found = where_negative(c);
    for (double x = -20.0; x < 20.0; x += 0.31) {
      const double value = c[0] + x * (c[1] + x * c[2]);
      negative += value < 0.0 ? 1 : 0;
      EXPECT_EQ(holds(found, x), value < 0.0) << c.transpose() << " at " << x;
    }
  }
  EXPECT_GT(negative, 10000);
}

TEST(IntervalSets, AQuadraticWithoutRootsIsNegativeEverywhereOrNowhere) {
  constexpr double unbounded = std::numeric_limits<double>::infinity();
  EXPECT_TRUE((where_negative<double>({1.0, 0.0, 1.0}).empty()));
  EXPECT_TRUE((where_negative<double>({0.0, 0.0, 0.0}).empty()));
  EXPECT_TRUE((where_negative<double>({1.0, 0.0, 0.0}).empty()));
  for (const Vector<double, 3>& c :
       {Vector<double, 3>(-1.0, 0.0, -1.0), Vector<double, 3>(-1.0, 0.0, 0.0)}) {
    const auto found = where_negative(c);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].lower, -unbounded);
    EXPECT_EQ(found[0].upper, unbounded);
  }
}

TEST(IntervalSets, ASmallLeadingCoefficientCostsTheNearRootNoDigits) {
  const auto found = where_negative<double>({-1.0, 1.0, 1e-18});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_DOUBLE_EQ(found[0].upper, 1.0);
  EXPECT_NEAR(found[0].lower, -1e18, 1e3);
}

}  // namespace
}  // namespace holdfast
