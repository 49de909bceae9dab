#include "holdfast/motion/batch/lane_numbers.hpp"

#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(LaneNumbers, AreReadAndWrittenBothWays) {
  LaneNumbers<double> numbers;
  EXPECT_EQ(numbers.all(), 0.0);
  numbers[0] = 2.0;
  EXPECT_EQ(numbers.all(), 2.0);
  numbers.set(3.0);
  EXPECT_EQ(numbers[0], 3.0);
}

}  // namespace
}  // namespace holdfast
