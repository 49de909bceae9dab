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

TEST(Quantiser, IsOddToTheLastBit) {
  test::Random random(704);
  for (int draw = 0; draw < 100000; ++draw) {
    const auto [value, quantum] = quantised_draw(random);
    ASSERT_EQ(quantised(-value, quantum), -quantised(value, quantum));
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

TEST(Quantiser, SinglePrecisionKeepsTheSameRules) {
  EXPECT_EQ(quantised(0.375F, 0.25F), 0.5F);
  EXPECT_EQ(quantised(0.625F, 0.25F), 0.5F);
  EXPECT_EQ(quantised(0.3F, 1e-30F), 0.3F);
}

}  // namespace
}  // namespace holdfast
