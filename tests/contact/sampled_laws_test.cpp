#include "holdfast/contact/dead_zone.hpp"
#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/contact/play.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/plant/two_mass.hpp"

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

/// A wandering relative motion: a displacement with the velocity that it has.
struct Wander {
  test::Random random;
  double displacement = 0, velocity = 0;
  void step() {
    velocity = 0.8 * velocity + random.uniform(-0.1, 0.1);
    displacement = 0.95 * displacement + velocity;
  }
};

TEST(Backlash, TheGapIsAsWideAsTheBacklashAndEndsAtTheReversal) {
  Wander motion{test::Random(93)};
  Backlash<double> law(0.25);
  for (int sample = 0; sample < 20000; ++sample) {
    motion.step();
    const bool was_inside = law.inside();
    law.step(motion.displacement, motion.velocity);
    if (was_inside || !law.inside()) continue;
    ASSERT_NEAR(law.upper() - law.lower(), 0.25, 1e-15);
    ASSERT_TRUE(law.lower() == motion.displacement || law.upper() == motion.displacement);
  }
}

TEST(BacklashWidth, WhatIsOutOfRangeIsRefusedByName) {
  for (const double width :
       {-1e-9, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    try {
      validate_backlash_width(width);
      ADD_FAILURE() << width;
    } catch (const InvalidParameter& error) {
      EXPECT_EQ(error.name(), "backlash width r0");
      EXPECT_EQ(error.unit(), "m");
      EXPECT_EQ(error.admissible(), "finite and >= 0");
    }
  }
  EXPECT_NO_THROW(validate_backlash_width(0.0));
}

/// A whole multiple of 1/1024 in [−bound, bound): sums and differences of such numbers are exact.
double play_dyadic(test::Random& random, double bound) {
  return std::floor(random.uniform(-bound, bound) * 1024.0) / 1024.0;
}

TEST(PlayBacklash, TheGapAtAReversalEndsAtTheExtremeSample) {
  PlayBacklash<double> law(0.5);
  EXPECT_TRUE(law.step(0.0, 1.0));
  EXPECT_TRUE(law.step(2.0, 0.5));
  EXPECT_FALSE(law.step(1.75, -0.5)) << "the reversal shows here, but the extreme was 2";
  EXPECT_TRUE(law.inside());
  EXPECT_EQ(law.lower(), 1.5);
  EXPECT_EQ(law.upper(), 2.0);
  PlayBacklash<double> mirror(0.5);
  mirror.step(0.0, -1.0);
  mirror.step(-2.0, -0.5);
  EXPECT_FALSE(mirror.step(-1.75, 0.5));
  EXPECT_EQ(mirror.lower(), -2.0);
  EXPECT_EQ(mirror.upper(), -1.5);
}

TEST(PlayBacklash, TransmitsUntilASampleMovesAndThenTheMotionHasTheFarSideBehindIt) {
  for (const double direction : {1.0, -1.0}) {
    PlayBacklash<double> law(0.5);
    EXPECT_TRUE(law.step(3.0, 0.0));
    EXPECT_TRUE(law.step(3.0, -0.0));
    EXPECT_TRUE(law.step(3.0, direction));
    EXPECT_EQ(direction > 0.0 ? law.upper() : law.lower(), 3.0);
    PlayBacklash<double> onward = law, back = law;
    EXPECT_TRUE(onward.step(3.0 + 0.125 * direction, direction));
    EXPECT_FALSE(back.step(3.0 - 0.125 * direction, -direction));
    EXPECT_FALSE(back.step(3.0 - 0.5 * direction, -direction));
    EXPECT_TRUE(back.step(3.0 - 0.625 * direction, -direction));
  }
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

TEST(PlayBacklash, AtAMaximumItsGapEndsWithinHalfASampleAndThatOfTheSignOfVelocityWithinOne) {
  // X cos t, sampled every h past t = −1: the extreme sample is at most h/2 from the maximum, the
  // first one with a negative velocity at most h.
  test::Random random(713);
  for (const double step : {0.1, 0.01, 0.001}) {
    double worst_play = 0.0, worst_sign = 0.0;
    for (int trial = 0; trial < 200; ++trial) {
      PlayBacklash<double> play(0.3);
      Backlash<double> sign(0.3);
      for (double time = -1.0 - step * random.unit(); time < 3.0 * step; time += step) {
        play.step(std::cos(time), -std::sin(time));
        sign.step(std::cos(time), -std::sin(time));
      }
      ASSERT_TRUE(play.inside());
      ASSERT_TRUE(sign.inside());
      worst_play = std::max(worst_play, 1.0 - play.upper());
      worst_sign = std::max(worst_sign, 1.0 - sign.upper());
    }
    EXPECT_LE(worst_play, 1.0 - std::cos(step / 2.0) + 1e-12);
    EXPECT_LE(worst_sign, 1.0 - std::cos(step) + 1e-12);
    EXPECT_GT(worst_play, 0.8 * (1.0 - std::cos(step / 2.0)));
    EXPECT_GT(worst_sign, 0.8 * (1.0 - std::cos(step)));
  }
}

}  // namespace
}  // namespace holdfast
