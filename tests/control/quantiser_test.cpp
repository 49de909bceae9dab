#include "holdfast/control/quantiser.hpp"

#include "support/random.hpp"

namespace holdfast {
namespace {

constexpr double unit_round_off = std::numeric_limits<double>::epsilon() / 2;

/// Values of any size beside quanta of any size, the count of quanta below 2^51.
struct QuantisedDraw {
  double value, quantum;
};

QuantisedDraw quantised_draw(test::Random& random) {
  const double quantum = random.log_uniform(1e-12, 1e3);
  return {random.sign() * quantum * random.log_uniform(1e-3, 1e15), quantum};
}

TEST(Quantiser, IsAtMostHalfAQuantumOff) {
  test::Random random(701);
  double largest_share = 0;
  for (int draw = 0; draw < 100000; ++draw) {
    const auto [value, quantum] = quantised_draw(random);
    const double error = std::abs(quantised(value, quantum) - value);
    // The quotient and the product are rounded once each, the difference of neighbours hardly.
    ASSERT_LE(error, quantum / 2 + 4 * unit_round_off * std::abs(value)) << value << ' ' << quantum;
    largest_share = std::max(largest_share, error / quantum);
  }
  EXPECT_GT(largest_share, 0.49) << "the bound is not reached: nothing was rounded";
}

TEST(Quantiser, GivesMultiplesOfTheQuantum) {
  test::Random random(702);
  for (int draw = 0; draw < 100000; ++draw) {
    const double quantum = random.log_uniform(1e-12, 1e3);
    const double value = quantum * random.uniform(-1e6, 1e6);
    const double quanta = quantised(value, quantum) / quantum;
    ASSERT_NEAR(quanta, std::round(quanta), 4 * unit_round_off * std::abs(quanta));
  }
}

TEST(Quantiser, IsIdempotent) {
  test::Random random(703);
  for (int draw = 0; draw < 100000; ++draw) {
    const double quantum = random.log_uniform(1e-12, 1e3);
    const double value = quantum * random.log_uniform(1e-3, 1e20);
    const double once = quantised(value, quantum);
    ASSERT_EQ(quantised(once, quantum), once) << value << ' ' << quantum;
  }
}

TEST(Quantiser, IsOddToTheLastBit) {
  test::Random random(704);
  for (int draw = 0; draw < 100000; ++draw) {
    const auto [value, quantum] = quantised_draw(random);
    ASSERT_EQ(quantised(-value, quantum), -quantised(value, quantum));
  }
}

TEST(Quantiser, NeverDecreases) {
  test::Random random(705);
  for (int draw = 0; draw < 1000; ++draw) {
    const double quantum = random.log_uniform(1e-6, 1.0);
    double value = -20 * quantum, before = quantised(value, quantum);
    while (value < 20 * quantum) {
      value += random.uniform(0, 0.2) * quantum;
      const double now = quantised(value, quantum);
      ASSERT_GE(now, before);
      before = now;
    }
  }
}

TEST(Quantiser, TiesGoToTheEvenMultiple) {
  constexpr double quantum = 0.25;
  for (int even = -10; even <= 10; even += 2) {
    const double kept = even * quantum;
    for (const double tie : {kept - quantum / 2, kept + quantum / 2}) {
      EXPECT_EQ(quantised(tie, quantum), kept);
    }
    EXPECT_EQ(quantised(kept + 0.501 * quantum, quantum), kept + quantum);
    EXPECT_EQ(quantised(kept - 0.501 * quantum, quantum), kept - quantum);
  }
}

TEST(Quantiser, WithoutAQuantumTheValueIsReadAsItIs) {
  test::Random random(706);
  for (int draw = 0; draw < 1000; ++draw) {
    const double value = random.sign() * random.log_uniform(1e-300, 1e300);
    ASSERT_EQ(quantised(value, 0.0), value);
  }
  for (const double zero : {0.0, -0.0}) {
    EXPECT_EQ(quantised(zero, 0.0), zero);
    EXPECT_EQ(std::signbit(quantised(zero, 0.0)), std::signbit(zero));
  }
}

TEST(Quantiser, AFiningQuantumLeavesTheValue) {
  test::Random random(707);
  for (int draw = 0; draw < 1000; ++draw) {
    const double value = random.sign() * random.uniform(0.5, 1);
    for (double quantum = 0.5; quantum > 1e-14; quantum /= 2) {
      ASSERT_NEAR(quantised(value, quantum), value, quantum / 2);
    }
    for (const double quantum : {1e-17, 1e-100, 1e-308, 5e-324}) {
      ASSERT_EQ(quantised(value, quantum), value) << quantum;
    }
  }
}

TEST(Quantiser, PowersOfTwoScaleIt) {
  test::Random random(708);
  for (int draw = 0; draw < 10000; ++draw) {
    const auto [value, quantum] = quantised_draw(random);
    ASSERT_EQ(quantised(1024 * value, 1024 * quantum), 1024 * quantised(value, quantum));
  }
}

TEST(Quantiser, SinglePrecisionKeepsTheSameRules) {
  EXPECT_EQ(quantised(0.375F, 0.25F), 0.5F);
  EXPECT_EQ(quantised(0.625F, 0.25F), 0.5F);
  EXPECT_EQ(quantised(0.3F, 1e-30F), 0.3F);
}

/// Widrow's model: of a signal that spreads over many quanta the error is uniform over a quantum.
TEST(Quantiser, ErrorOfASpreadSignalIsUniformNoise) {
  test::Random random(709);
  constexpr double quantum = 0.125;
  constexpr int count = 200000;
  double sum = 0, squares = 0, product = 0;
  for (int draw = 0; draw < count; ++draw) {
    const double value = 3 * quantum * random.normal();
    const double error = (quantised(value, quantum) - value) / quantum;
    sum += error;
    squares += error * error;
    product += error * value / (3 * quantum);
  }
  // Five standard deviations of the means: of a uniform error 1/12 is the variance, 1/180 that of
  // its square.
  const double root_count = std::sqrt(static_cast<double>(count));
  EXPECT_NEAR(sum / count, 0, 5 * std::sqrt(1.0 / 12) / root_count);
  EXPECT_NEAR(squares / count, 1.0 / 12, 5 * std::sqrt(1.0 / 180) / root_count);
  EXPECT_NEAR(product / count, 0, 5 * std::sqrt(1.0 / 12) / root_count);
}

/// x ← a x − b x̂ with a = 6/5, b = 1. Without a quantum it is x ← x / 5. With one, the rest
/// |x| < q / 2 is left, because there is no control in it, and what comes back is between
/// (b − a² / 2) q and a q / 2 in size for ever: micro-chaos that shrinks with the quantum.
TEST(Quantiser, AnUnstableLoopNeitherRestsNorEscapes) {
  constexpr double a = 1.2, b = 1.0;
  test::Random random(710);
  for (int draw = 0; draw < 100; ++draw) {
    const double quantum = random.log_uniform(1e-9, 1.0);
    double x = random.sign() * quantum * random.log_uniform(1e-6, 0.5);
    int steps = 0;
    for (; std::abs(x) <= quantum / 2; ++steps) x = a * x - b * quantised(x, quantum);
    EXPECT_LE(steps, 1 + std::ceil(std::log(0.5e6) / std::log(a)));
    for (int step = 0; step < 10000; ++step) {
      ASSERT_GE(std::abs(x), (b - a * a / 2) * quantum * (1 - 1e-12));
      ASSERT_LE(std::abs(x), a / 2 * quantum * (1 + 1e-12));
      x = a * x - b * quantised(x, quantum);
    }
    for (int step = 0; step < 100; ++step) x = a * x - b * quantised(x, 0.0);
    EXPECT_LE(std::abs(x), 1e-60);
  }
}

}  // namespace
}  // namespace holdfast
