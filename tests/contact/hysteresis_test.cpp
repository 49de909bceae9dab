#include "holdfast/contact/hysteresis.hpp"

#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast::test {

/// Two numbers that step together, as a SIMD pack would.
struct Pair {
  std::array<double, 2> lane{};
  Pair() = default;
  explicit Pair(double value) : lane{value, value} {}
  Pair(double first, double second) : lane{first, second} {}
  friend Pair operator+(Pair a, Pair b) { return {a.lane[0] + b.lane[0], a.lane[1] + b.lane[1]}; }
  friend Pair operator-(Pair a, Pair b) { return {a.lane[0] - b.lane[0], a.lane[1] - b.lane[1]}; }
};

struct PairMask {
  std::array<bool, 2> lane{};
  friend PairMask operator&(PairMask a, PairMask b) {
    return {{a.lane[0] && b.lane[0], a.lane[1] && b.lane[1]}};
  }
  friend PairMask operator|(PairMask a, PairMask b) {
    return {{a.lane[0] || b.lane[0], a.lane[1] || b.lane[1]}};
  }
  friend PairMask operator!(PairMask a) { return {{!a.lane[0], !a.lane[1]}}; }
};

inline PairMask operator<(Pair a, Pair b) {
  return {{a.lane[0] < b.lane[0], a.lane[1] < b.lane[1]}};
}
inline PairMask operator>(Pair a, Pair b) { return b < a; }
inline PairMask operator<=(Pair a, Pair b) {
  return {{a.lane[0] <= b.lane[0], a.lane[1] <= b.lane[1]}};
}
inline PairMask operator>=(Pair a, Pair b) { return b <= a; }
inline Pair select(PairMask mask, Pair a, Pair b) {
  return {mask.lane[0] ? a.lane[0] : b.lane[0], mask.lane[1] ? a.lane[1] : b.lane[1]};
}

}  // namespace holdfast::test

namespace holdfast {

template <>
struct MaskOf<test::Pair> {
  using type = test::PairMask;
};

namespace {

TEST(Backlash, AReversalFromPositiveVelocityOpensTheGapBelow) {
  Backlash<double> law(0.5);
  EXPECT_TRUE(law.step(0.0, 1.0));
  EXPECT_FALSE(law.step(2.0, -0.1));
  EXPECT_TRUE(law.inside());
  EXPECT_EQ(law.lower(), 1.5);
  EXPECT_EQ(law.upper(), 2.0);
}

TEST(Backlash, AReversalFromNegativeVelocityOpensTheGapAbove) {
  Backlash<double> law(0.5);
  EXPECT_TRUE(law.step(0.0, -1.0));
  EXPECT_FALSE(law.step(-2.0, 0.1));
  EXPECT_EQ(law.lower(), -2.0);
  EXPECT_EQ(law.upper(), -1.5);
}

TEST(Backlash, BothEndsOfTheGapBelongToIt) {
  Backlash<double> law(0.5);
  law.step(0.0, 1.0);
  law.step(2.0, -0.1);
  EXPECT_FALSE(law.step(1.5, -0.1));
  EXPECT_FALSE(law.step(2.0, 0.1));
  EXPECT_FALSE(law.step(1.75, 0.1));
}

TEST(Backlash, TheForceActsAgainFromTheFirstSampleOutside) {
  for (const double outside : {std::nextafter(1.5, 0.0), std::nextafter(2.0, 3.0)}) {
    Backlash<double> law(0.5);
    law.step(0.0, 1.0);
    law.step(2.0, -0.1);
    EXPECT_TRUE(law.step(outside, -0.1)) << outside;
    EXPECT_FALSE(law.inside());
  }
}

TEST(Backlash, EntryIsNotTestedAtTheSampleOfTheExit) {
  Backlash<double> law(0.5);
  law.step(0.0, 1.0);
  EXPECT_FALSE(law.step(2.0, -0.1));
  EXPECT_TRUE(law.step(2.1, 0.1)) << "velocity changed its sign, but the drive has just left";
  EXPECT_FALSE(law.step(2.2, -0.1)) << "one sample later the reversal counts";
}

TEST(Backlash, ReversalsInsideTheGapDoNotMoveIt) {
  Backlash<double> law(0.5);
  law.step(0.0, 1.0);
  law.step(2.0, -0.1);
  EXPECT_FALSE(law.step(1.8, 0.1));
  EXPECT_FALSE(law.step(1.9, -0.1));
  EXPECT_EQ(law.lower(), 1.5);
  EXPECT_EQ(law.upper(), 2.0);
}

TEST(Backlash, TheFirstSampleCannotEnter) {
  for (const double velocity : {-1.0, 0.0, 1.0}) {
    Backlash<double> law(0.5);
    EXPECT_TRUE(law.step(1.0, velocity));
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

TEST(Backlash, FromAVelocityOfExactlyZeroNothingReverses) {
  for (const double zero : {0.0, -0.0}) {
    for (const double velocity : {-1.0, 0.0, 1.0}) {
      Backlash<double> law(0.5);
      law.step(0.0, zero);
      EXPECT_TRUE(law.step(1.0, velocity));
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

TEST(Backlash, ADriveWithoutBacklashNeverEnters) {
  test::Random random(91);
  Backlash<double> law(0.0);
  for (int sample = 0; sample < 1000; ++sample) {
    EXPECT_TRUE(law.step(random.uniform(-1, 1), random.uniform(-1, 1)));
  }
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

TEST(Backlash, MirroredMotionIsMirroredExactly) {
  Wander motion{test::Random(92)};
  Backlash<double> law(0.2), mirror(0.2);
  int entries = 0;
  for (int sample = 0; sample < 20000; ++sample) {
    motion.step();
    const bool was_inside = law.inside();
    ASSERT_EQ(law.step(motion.displacement, motion.velocity),
              mirror.step(-motion.displacement, -motion.velocity));
    if (!law.inside()) continue;
    entries += was_inside ? 0 : 1;
    ASSERT_EQ(law.lower(), -mirror.upper());
    ASSERT_EQ(law.upper(), -mirror.lower());
  }
  EXPECT_GT(entries, 1000);
}

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

TEST(Backlash, EveryLaneOfAPackMovesAsItWouldAlone) {
  Wander first{test::Random(94)}, second{test::Random(95)};
  Backlash<test::Pair> pack(test::Pair(0.2, 0.05));
  Backlash<double> alone_first(0.2), alone_second(0.05);
  int differing = 0;
  for (int sample = 0; sample < 20000; ++sample) {
    first.step();
    second.step();
    const auto together =
        pack.step({first.displacement, second.displacement}, {first.velocity, second.velocity});
    ASSERT_EQ(together.lane[0], alone_first.step(first.displacement, first.velocity));
    ASSERT_EQ(together.lane[1], alone_second.step(second.displacement, second.velocity));
    differing += together.lane[0] != together.lane[1] ? 1 : 0;
  }
  EXPECT_GT(differing, 1000);
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
