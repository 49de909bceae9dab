#include "holdfast/stability/chart/joined_boxes.hpp"

#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast::test {
namespace {

/// Whether two boxes share a side's piece of some length.
bool share_a_side(const GainBox& a, const GainBox& b) {
  const double p = std::min(a.proportional_to, b.proportional_to) -
                   std::max(a.proportional_from, b.proportional_from);
  const double d = std::min(a.differential_to, b.differential_to) -
                   std::max(a.differential_from, b.differential_from);
  return (p == 0.0 && d > 0.0) || (d == 0.0 && p > 0.0);
}

/// Of each box the least number of its region, by going through all pairs until nothing changes.
std::vector<std::size_t> regions_by_pairs(const std::vector<GainBox>& boxes) {
  std::vector<std::size_t> least(boxes.size());
  std::iota(least.begin(), least.end(), std::size_t{0});
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t k = 0; k < boxes.size(); ++k)
      for (std::size_t j = 0; j < k; ++j)
        if (least[k] != least[j] && share_a_side(boxes[k], boxes[j])) {
          least[k] = least[j] = std::min(least[k], least[j]);
          changed = true;
        }
  }
  return least;
}

/// Boxes that are quartered at random, some left out.
void add_parts(const GainBox& box, double keep, int depth, Random& random,
               std::vector<GainBox>& boxes) {
  if (depth == 0 || random.unit() < 0.3) {
    if (random.unit() < keep) boxes.push_back(box);
    return;
  }
  for (const GainBox& quarter : detail::quarters_of(box))
    add_parts(quarter, keep, depth - 1, random, boxes);
}

TEST(JoinedBoxes, AreThoseWithAWayBetweenThem) {
  Random random(1);
  std::size_t most = 0, regions_seen = 0;
  for (int trial = 0; trial < 400; ++trial) {
    std::vector<GainBox> boxes;
    add_parts({-3.0, 0.0, 0.0, 1.0}, random.uniform(0.3, 0.9), 4, random, boxes);
    add_parts({0.0, 3.0, 0.0, 1.0}, random.uniform(0.3, 0.9), 3, random, boxes);
    add_parts({0.0, 3.0, 1.0, 2.0}, random.uniform(0.3, 0.9), 3, random, boxes);
    std::shuffle(boxes.begin(), boxes.end(), std::mt19937(static_cast<unsigned>(trial)));
    const auto regions = joined_boxes(boxes);
    const auto expected = regions_by_pairs(boxes);
    ASSERT_EQ(regions.size(), boxes.size());
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      EXPECT_EQ(regions[regions[k]], regions[k]);
      for (std::size_t j = 0; j < k; ++j)
        EXPECT_EQ(regions[k] == regions[j], expected[k] == expected[j]) << trial;
    }
    most = std::max(most, boxes.size());
    regions_seen += std::set<std::size_t>(regions.begin(), regions.end()).size();
  }
  EXPECT_GT(most, 100U);
  EXPECT_GT(regions_seen, 2000U);
}

TEST(JoinedBoxes, ACornerIsNoWay) {
  const auto regions = joined_boxes({{0.0, 1.0, 0.0, 1.0}, {1.0, 2.0, 1.0, 2.0}});
  EXPECT_NE(regions[0], regions[1]);
  EXPECT_TRUE(joined_boxes({}).empty());
}

}  // namespace
}  // namespace holdfast::test
