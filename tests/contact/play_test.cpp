#include "holdfast/contact/play.hpp"

#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/core/types.hpp"
#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

/// A whole multiple of 1/1024 in [−bound, bound): sums and differences of such numbers are exact.
double play_dyadic(test::Random& random, double bound) {
  return std::floor(random.uniform(-bound, bound) * 1024.0) / 1024.0;
}

std::vector<double> play_inputs(test::Random& random, std::size_t count, double bound) {
  std::vector<double> inputs(count);
  for (double& input : inputs) input = play_dyadic(random, bound);
  return inputs;
}

std::vector<double> played(double half_width, double output, const std::vector<double>& inputs) {
  PlayOperator<double> play(half_width, output);
  std::vector<double> outputs;
  for (const double input : inputs) outputs.push_back(play.step(input));
  return outputs;
}

/// Minus the sum of y dx over one period of x = X sin φ in `count` equal steps of φ, by trapezoids,
/// once the loop is closed.
double play_loop_area(double amplitude, double half_width, int count) {
  const auto input = [&](int k) { return amplitude * std::sin(2.0 * pi<double> * k / count); };
  PlayOperator<double> play(half_width, 0.0);
  for (int k = 0; k <= count; ++k) play.step(input(k));
  double area = 0.0;
  for (int k = 1; k <= count; ++k) {
    const double before = play.output();
    area -= (play.step(input(k)) + before) / 2.0 * (input(k) - input(k - 1));
  }
  return area;
}

TEST(PlayOperator, UnderASineTheSlopesAreTheInputMovedByTheHalfWidth) {
  const double amplitude = 1.5, half_width = 0.4;
  const int count = 4000;
  PlayOperator<double> play(half_width, 0.0);
  int rising = 0, falling = 0, flat = 0;
  for (int k = 0; k < 3 * count; ++k) {
    const double angle = 2.0 * pi<double> * k / count, input = amplitude * std::sin(angle);
    const double output = play.step(input);
    if (k < count) continue;
    // After a maximum X the output rests at X − r until the input has come down by 2 r.
    if (std::cos(angle) > 0.0 && input > -amplitude + 2.0 * half_width) {
      ASSERT_NEAR(output, input - half_width, 1e-15) << k;
      ++rising;
    } else if (std::cos(angle) < 0.0 && input < amplitude - 2.0 * half_width) {
      ASSERT_NEAR(output, input + half_width, 1e-15) << k;
      ++falling;
    } else {
      ASSERT_NEAR(std::abs(output), amplitude - half_width, 1e-15) << k;
      ++flat;
    }
  }
  EXPECT_GT(std::min({rising, falling, flat}), count / 4);
}

TEST(PlayOperator, TheLoopOfASineEnclosesFourTimesHalfWidthTimesWhatIsLeftOfTheAmplitude) {
  // Trapezoids are exact but at the two kinks, where one step Δx ≤ X h takes off at most Δx²/8.
  test::Random random(701);
  for (int trial = 0; trial < 200; ++trial) {
    const double amplitude = random.uniform(0.5, 2.0);
    const double half_width = amplitude * random.uniform(0.05, 0.95);
    for (const int count : {400, 4000}) {
      const double step = 2.0 * pi<double> / count;
      const double missing = 4.0 * half_width * (amplitude - half_width) -
                             play_loop_area(amplitude, half_width, count);
      ASSERT_GE(missing, -1e-13);
      ASSERT_LE(missing, 0.25 * std::pow(amplitude * step, 2.0) + 1e-13);
    }
  }
}

TEST(PlayOperator, TheAreaOfTheSampledLoopConvergesAtSecondOrder) {
  test::Random random(702);
  double coarse = 0.0, fine = 0.0;
  for (int trial = 0; trial < 400; ++trial) {
    const double half_width = random.uniform(0.1, 0.9), area = 4.0 * half_width * (1 - half_width);
    coarse += area - play_loop_area(1.0, half_width, 400);
    fine += area - play_loop_area(1.0, half_width, 1600);
  }
  EXPECT_NEAR(std::log(coarse / fine) / std::log(4.0), 2.0, 0.1);
}

TEST(PlayOperator, BelowTheHalfWidthASineMovesNothing) {
  PlayOperator<double> play(1.0, 0.0);
  for (int k = 0; k < 1000; ++k) ASSERT_EQ(play.step(std::sin(0.1 * k)), 0.0);
}

TEST(PlayOperator, IsRateIndependent) {
  // Samples put between two others, monotonely and with repetitions, change nothing at those two.
  test::Random random(703);
  PlayOperator<double> sparse(0.3, 0.1), dense(0.3, 0.1);
  double before = 0.0;
  for (int sample = 0; sample < 20000; ++sample) {
    const double input = random.uniform(-1.0, 1.0);
    std::vector<double> between(random.index(6), 0.0);
    for (double& value : between) value = random.uniform(before, input);
    std::sort(between.begin(), between.end());
    if (input < before) std::reverse(between.begin(), between.end());
    if (sample > 0) {
      for (const double value : between) dense.step(value);
    }
    ASSERT_EQ(dense.step(input), sparse.step(input)) << sample;
    ASSERT_EQ(dense.step(input), sparse.output()) << sample;
    before = input;
  }
}

TEST(PlayOperator, GoesOnFromItsOutputAlone) {
  test::Random random(704);
  const auto inputs = play_inputs(random, 2000, 1.0);
  const auto whole = played(0.25, 0.0, inputs);
  for (std::size_t cut = 1; cut < inputs.size(); cut += 37) {
    const std::vector<double> rest(inputs.begin() + static_cast<std::ptrdiff_t>(cut), inputs.end());
    const auto continued = played(0.25, whole[cut - 1], rest);
    ASSERT_TRUE(std::equal(continued.begin(), continued.end(),
                           whole.begin() + static_cast<std::ptrdiff_t>(cut)));
  }
}

TEST(PlayOperator, OnePlayAfterAnotherIsThePlayOfTheirSum) {
  test::Random random(705);
  for (int trial = 0; trial < 200; ++trial) {
    const auto inputs = play_inputs(random, 100, 2.0);
    const double first = play_dyadic(random, 0.25) + 0.25, second = play_dyadic(random, 0.25) + 0.5;
    ASSERT_EQ(played(second, 0.0, played(first, 0.0, inputs)), played(first + second, 0.0, inputs));
  }
}

TEST(PlayOperator, KeepsTheOrderOfInputsAndDoesNotSpreadThem) {
  test::Random random(706);
  for (int trial = 0; trial < 200; ++trial) {
    const double half_width = play_dyadic(random, 0.25) + 0.25;
    auto lower = play_inputs(random, 100, 1.0), upper = lower;
    double largest = 0.0;
    for (double& input : upper) {
      const double raised = play_dyadic(random, 0.25) + 0.25;
      largest = std::max(largest, raised);
      input += raised;
    }
    const auto below = played(half_width, 0.0, lower), above = played(half_width, 0.0, upper);
    for (std::size_t k = 0; k < below.size(); ++k) {
      ASSERT_LE(below[k], above[k]);
      ASSERT_LE(above[k] - below[k], largest);
    }
  }
}

TEST(PlayOperator, TheOutputStaysWithinTheHalfWidthOfTheInput) {
  test::Random random(707);
  int at_an_end = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const double half_width = play_dyadic(random, 0.5) + 0.5;
    PlayOperator<double> play(half_width, 3.0);
    for (const double input : play_inputs(random, 100, 1.0)) {
      const double distance = std::abs(play.step(input) - input);
      ASSERT_LE(distance, half_width);
      at_an_end += distance == half_width ? 1 : 0;
    }
  }
  EXPECT_GT(at_an_end, 2000);
}

TEST(PlayOperator, WithoutWidthTheOutputIsTheInput) {
  test::Random random(708);
  PlayOperator<double> play(0.0, 5.0);
  for (int sample = 0; sample < 1000; ++sample) {
    const double input = random.uniform(-1.0, 1.0);
    ASSERT_EQ(play.step(input), input);
  }
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

TEST(PlayBacklash, BothEndsOfTheGapBelongToItAndReversalsInsideDoNotMoveIt) {
  PlayBacklash<double> law(0.5);
  law.step(0.0, 1.0);
  law.step(2.0, 1.0);
  for (const double inside : {1.5, 2.0, 1.75, 1.625, 2.0, 1.5})
    EXPECT_FALSE(law.step(inside, 0.0)) << inside;
  EXPECT_EQ(law.lower(), 1.5);
  EXPECT_EQ(law.upper(), 2.0);
}

TEST(PlayBacklash, TheForceActsAgainFromTheFirstSampleOutside) {
  for (const double outside : {1.5 - 0x1p-40, 2.0 + 0x1p-40}) {
    PlayBacklash<double> law(0.5);
    law.step(0.0, 1.0);
    law.step(2.0, 1.0);
    law.step(1.75, -1.0);
    EXPECT_TRUE(law.step(outside, -0.1)) << outside;
    EXPECT_FALSE(law.inside());
  }
}

TEST(PlayBacklash, ASampleBeyondTheWholeGapTransmitsWithoutAPause) {
  PlayBacklash<double> law(0.5);
  law.step(0.0, 1.0);
  law.step(2.0, 1.0);
  EXPECT_TRUE(law.step(1.0, -1.0));
  EXPECT_EQ(law.lower(), 1.0);
  EXPECT_FALSE(law.step(1.25, 1.0));
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

TEST(PlayBacklash, ADriveWithoutBacklashAlwaysTransmits) {
  test::Random random(709);
  PlayBacklash<double> law(0.0);
  for (int sample = 0; sample < 1000; ++sample) {
    const double displacement = random.uniform(-1, 1), velocity = random.uniform(-1, 1);
    EXPECT_TRUE(law.step(displacement, velocity));
    EXPECT_TRUE(law.step(displacement, 0.0)) << "at rest";
  }
}

TEST(PlayBacklash, TransmitsWhereThePlayOperatorMoves) {
  test::Random random(710);
  PlayBacklash<double> law(0.5);
  law.step(0.0, 1.0);
  PlayOperator<double> play(0.25, -0.25);
  int pushed = 0;
  for (int sample = 0; sample < 20000; ++sample) {
    const double displacement = play_dyadic(random, 0.5), before = play.output();
    const bool moves = play.step(displacement) != before;
    ASSERT_EQ(law.step(displacement, random.sign()), moves) << sample;
    ASSERT_EQ(law.upper() - law.lower(), 0.5);
    pushed += moves ? 1 : 0;
  }
  EXPECT_GT(pushed, 2000);
  EXPECT_LT(pushed, 18000);
}

TEST(PlayBacklash, MirroredMotionIsMirroredExactly) {
  test::Random random(711);
  PlayBacklash<double> law(0.2), mirror(0.2);
  for (int sample = 0; sample < 20000; ++sample) {
    const double displacement = random.uniform(-0.3, 0.3), velocity = random.uniform(-1, 1);
    ASSERT_EQ(law.step(displacement, velocity), mirror.step(-displacement, -velocity));
    ASSERT_EQ(law.lower(), -mirror.upper());
  }
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
