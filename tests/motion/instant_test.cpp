#include "holdfast/motion/instant.hpp"

#include "holdfast/motion/observers.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(Instant, MeantAsASampleIsOne) {
  ASSERT_LT(5 * 0.011, 0.055) << "the example must be one where round-off comes early";
  EXPECT_TRUE(not_before(5 * 0.011, 0.055));
  EXPECT_FALSE(not_before(4 * 0.011, 0.055));
  EXPECT_TRUE(not_before(6 * 0.011, 0.055));
}

TEST(Instant, KeepsItsSideOfZero) {
  EXPECT_TRUE(not_before(0.0, 0.0));
  EXPECT_FALSE(not_before(-1e-3, 0.0));
  EXPECT_TRUE(not_before(-0.055, -0.055));
}

TEST(Instant, AnObserverTakesTheSampleThatItWasGiven) {
  PhaseExtent extent(0.055);
  MotionSample<double> sample{};
  sample.index = 5;
  sample.time = 5 * 0.011;
  sample.state[0] = 0.25;
  extent(sample);
  EXPECT_EQ(extent.displacement(), 0.25);
}

}  // namespace
}  // namespace holdfast
