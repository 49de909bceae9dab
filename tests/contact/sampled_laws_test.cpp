#include "holdfast/contact/dead_zone.hpp"
#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/contact/play.hpp"
#include "holdfast/core/types.hpp"

#include "support/random.hpp"

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

TEST(Backlash, AReversalOpensTheGapOnTheSideThatItCameFrom) {
  for (const double sign : {1.0, -1.0}) {
    Backlash<double> law(0.5);
    EXPECT_TRUE(law.step(0.0, sign));
    EXPECT_FALSE(law.step(2.0 * sign, -0.1 * sign));
    EXPECT_TRUE(law.inside());
    EXPECT_EQ(law.lower(), sign > 0.0 ? 1.5 : -2.0);
    EXPECT_EQ(law.upper(), sign > 0.0 ? 2.0 : -1.5);
  }
}

TEST(Backlash, AVelocityThatBecomesZeroReverses) {
  for (const double velocity : {1.0, -1.0}) {
    for (const double zero : {0.0, -0.0}) {
      Backlash<double> law(0.5);
      law.step(0.0, velocity);
      EXPECT_FALSE(law.step(2.0, zero));
      EXPECT_EQ(law.upper(), velocity > 0 ? 2.0 : 2.5);
    }
  }
}

TEST(Backlash, TinyVelocitiesReverseThoughTheirProductUnderflows) {
  constexpr double tiny = std::numeric_limits<double>::denorm_min();
  Backlash<double> opposite(0.5);
  opposite.step(0.0, tiny);
  EXPECT_FALSE(opposite.step(1.0, -tiny));
  Backlash<double> same(0.5);
  same.step(0.0, 1e-200);
  EXPECT_TRUE(same.step(1.0, 1e-200)) << "the product is zero, but the direction is the same";
}

/// A whole multiple of 1/1024 in [−bound, bound): sums and differences of such numbers are exact.
double play_dyadic(test::Random& random, double bound) {
  return std::floor(random.uniform(-bound, bound) * 1024.0) / 1024.0;
}

/// y_j = max(x_j − r, min(x_j + r, y_{j−1})), the play operator.
TEST(PlayBacklash, TransmitsWhereThePlayOperatorMoves) {
  test::Random random(710);
  PlayBacklash<double> law(0.5);
  law.step(0.0, 1.0);
  double output = -0.25;
  int pushed = 0;
  for (int sample = 0; sample < 20000; ++sample) {
    const double displacement = play_dyadic(random, 0.5), before = output;
    output = std::max(displacement - 0.25, std::min(displacement + 0.25, before));
    const bool moves = output != before;
    ASSERT_EQ(law.step(displacement, random.sign()), moves) << sample;
    ASSERT_EQ(law.lower(), output - 0.25);
    ASSERT_EQ(law.upper(), output + 0.25);
    pushed += moves ? 1 : 0;
  }
  EXPECT_GT(pushed, 2000);
  EXPECT_LT(pushed, 18000);
}

}  // namespace
}  // namespace holdfast
