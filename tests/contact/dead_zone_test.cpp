#include "holdfast/contact/dead_zone.hpp"

#include "holdfast/plant/two_mass.hpp"
#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(DeadZone, TransmitsBeyondItsEndsWhichBelongToTheGap) {
  DeadZone<double> zone(0.5);
  for (const double inside : {0.0, 0.25, -0.25, 0.1}) {
    EXPECT_FALSE(zone.step(inside, 1.0)) << inside;
    EXPECT_TRUE(zone.inside());
    EXPECT_EQ(zone.touched_side(), 0.0);
  }
  for (const double sign : {1.0, -1.0}) {
    EXPECT_TRUE(zone.step(sign * std::nextafter(0.25, 1.0), -sign));
    EXPECT_FALSE(zone.inside());
    EXPECT_EQ(zone.touched_side(), sign);
  }
}

TEST(DeadZone, WithoutAGapTheForceIsAlwaysTransmitted) {
  DeadZone<double> zone(0.0);
  test::Random random(726);
  for (const double zero : {0.0, -0.0}) EXPECT_TRUE(zone.step(zero, 1.0));
  for (int sample = 0; sample < 1000; ++sample) {
    const double displacement = random.uniform(-1, 1), velocity = random.uniform(-1, 1);
    ASSERT_TRUE(zone.step(displacement, velocity));
    ASSERT_EQ(zone.side(displacement), displacement < 0.0 ? -1.0 : 1.0);
  }
}

}  // namespace
}  // namespace holdfast
