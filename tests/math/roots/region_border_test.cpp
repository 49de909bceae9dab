#include "holdfast/math/roots/region_border.hpp"

#include "support/testing.hpp"

namespace holdfast {
namespace {

using IntBorder = RegionBorder<int>;

/// Of the points, by the trapezoidal rule; positive where the region lies at the left.
double border_area(const IntBorder& border) {
  double twice = 0.0;
  for (std::size_t k = 0; k + 1 < border.points.size(); ++k) {
    const PlanePoint &a = border.points[k].at, &b = border.points[k + 1].at;
    twice += a.x * b.y - b.x * a.y;
  }
  return twice / 2.0;
}

std::vector<PlanePoint> border_corners(const IntBorder& border) {
  std::vector<PlanePoint> found;
  for (std::size_t k = 0; k + 1 < border.points.size(); ++k)
    if (border.points[k].label != border.points[k + 1].label)
      found.push_back(border.points[k + 1].at);
  return found;
}

/// The smallest of some margins, and its number.
RegionLook<int> smallest_of(std::initializer_list<double> margins) {
  const auto least = std::min_element(margins.begin(), margins.end());
  return {*least, static_cast<int>(least - margins.begin())};
}

TEST(RegionBorder, OfADiscIsItsCircle) {
  const auto disc = [](const PlanePoint& at) {
    return RegionLook<int>{1.0 - std::hypot(at.x - 3.0, at.y + 2.0), 7};
  };
  const IntBorder border = region_border<int>(disc, {3.4, -2.1});
  ASSERT_TRUE(border.closed);
  for (const auto& point : border.points) {
    EXPECT_NEAR(std::hypot(point.at.x - 3.0, point.at.y + 2.0), 1.0, 1e-12);
    EXPECT_EQ(point.label, 7);
  }
  EXPECT_NEAR(border_area(border), std::acos(-1.0), 1e-3);
}

TEST(RegionBorder, OfATriangleHasItsCornersWhereTwoSidesMeet) {
  const auto triangle = [](const PlanePoint& at) {
    return smallest_of({at.y, at.x - 0.1 * at.y, 1.0 - at.x - 3.0 * at.y});
  };
  const IntBorder border = region_border<int>(triangle, {0.3, 0.1});
  ASSERT_TRUE(border.closed);
  const auto found = border_corners(border);
  ASSERT_EQ(found.size(), 3U);
  const std::vector<PlanePoint> expected = {{0.1 / 3.1, 1.0 / 3.1}, {0.0, 0.0}, {1.0, 0.0}};
  for (const PlanePoint& at : expected)
    EXPECT_TRUE(std::any_of(
        found.begin(), found.end(),
        [&](const PlanePoint& other) { return std::hypot(at.x - other.x, at.y - other.y) < 1e-8; }))
        << at.x << ' ' << at.y;
  EXPECT_NEAR(border_area(border), 0.5 / 3.1, 1e-8);
}

TEST(RegionBorder, PassesCornersThatPointInwards) {
  // A square without its upper right quarter.
  const auto angle = [](const PlanePoint& at) {
    const RegionLook<int> square = smallest_of({at.x, at.y, 1.0 - at.x, 1.0 - at.y});
    const double beyond = std::max(0.5 - at.x, 0.5 - at.y);
    return beyond < square.margin ? RegionLook<int>{beyond, 0.5 - at.x > 0.5 - at.y ? 4 : 5}
                                  : square;
  };
  const IntBorder border = region_border<int>(angle, {0.2, 0.3});
  ASSERT_TRUE(border.closed);
  EXPECT_EQ(border_corners(border).size(), 6U);
  EXPECT_NEAR(border_area(border), 0.75, 1e-6);
}

TEST(RegionBorder, FindsARegionThatIsSmallerThanAStep) {
  const auto tiny = [](const PlanePoint& at) {
    return RegionLook<int>{1e-4 - std::hypot(at.x, 4.0 * at.y), 0};
  };
  const IntBorder border = region_border<int>(tiny, {0.0, 0.0});
  ASSERT_TRUE(border.closed);
  EXPECT_NEAR(border_area(border), std::acos(-1.0) * 1e-8 / 4.0, 0.02 * 1e-8);
}

TEST(RegionBorder, GoesAlongAJump) {
  const auto step = [](const PlanePoint& at) {
    const bool inside = std::hypot(at.x, at.y) < 0.3;
    return RegionLook<int>{inside ? 1.0 : -1.0, inside ? 0 : 1};
  };
  BorderSteps steps;
  steps.tolerance = 1e-9;
  const IntBorder border = region_border<int>(step, {0.1, 0.0}, steps);
  ASSERT_TRUE(border.closed);
  for (const auto& point : border.points) {
    EXPECT_NEAR(std::hypot(point.at.x, point.at.y), 0.3, 1e-8);
    EXPECT_EQ(point.label, 1) << "that of the outer side";
  }
}

TEST(RegionBorder, EndsWhereItWouldGoRoundATouchingPartForEver) {
  // Two triangles that touch at the origin, the right one so flat that the way may pass from it to
  // the left one, but not back.
  int closed = 0, lost = 0;
  for (int k = 0; k < 40; ++k) {
    const double slope = 0.02 + 0.005 * k;
    int looks = 0;
    const auto triangles = [&](const PlanePoint& at) {
      ++looks;
      const double far = std::abs(at.x);
      return smallest_of({(at.x > 0.0 ? slope : 0.5) * far - std::abs(at.y), 1.0 - far});
    };
    BorderSteps steps;
    steps.longest = 0.037;
    const IntBorder border = region_border<int>(triangles, {0.7, 0.0}, steps);
    EXPECT_LT(looks, 20'000) << slope;
    (border.closed ? closed : lost) += 1;
    if (border.closed) {
      EXPECT_NEAR(border_area(border), slope, 1e-3 * slope);
    }
  }
  EXPECT_GT(closed, 0);
  EXPECT_GT(lost, 0);
}

TEST(RegionBorder, IsEmptyFromOutside) {
  const auto nowhere = [](const PlanePoint&) { return RegionLook<int>{-1.0, 0}; };
  const IntBorder border = region_border<int>(nowhere, {0.0, 0.0});
  EXPECT_FALSE(border.closed);
  EXPECT_TRUE(border.points.empty());
}

}  // namespace
}  // namespace holdfast
