#include "holdfast/contact/hysteresis.hpp"

#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

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

}  // namespace
}  // namespace holdfast
