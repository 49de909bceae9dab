#include "holdfast/chaos/recurrence.hpp"
#include "holdfast/chaos/switching_complexity.hpp"

#include "support/random.hpp"

namespace holdfast {
namespace {

using Pair = Vector<double, 2>;

/// A point that turns by `turns` of a circle each sample, in units that differ by 10⁵.
std::vector<Pair> circle(double turns, std::size_t samples) {
  std::vector<Pair> states(samples);
  for (std::size_t n = 0; n < samples; ++n) {
    const double angle = 6.283185307179586 * turns * static_cast<double>(n) + 0.7;
    states[n] = {1e-3 * std::cos(angle), 1e2 * std::sin(angle)};
  }
  return states;
}

std::vector<Pair> scattered(std::size_t samples, std::uint64_t seed) {
  test::Random random(seed);
  std::vector<Pair> states(samples);
  for (Pair& state : states) state = {random.unit(), random.unit()};
  return states;
}

const double golden_turn = 0.5 * (std::sqrt(5.0) - 1.0);

TEST(RepeatsAfter, IsThePeriodOfAPeriodicSeries) {
  for (const int period : {2, 7, 100, 333}) {
    const auto states = circle(1.0 / period, 2000);
    const RepeatSearch search = repeats_after<2>(states, 1e-9);
    EXPECT_EQ(search.lag, static_cast<std::size_t>(period));
    EXPECT_EQ(search.largest_lag, 333U);
  }
}

TEST(RepeatsAfter, DoesNotSeeAPeriodWithoutRoomForItsRepeats) {
  const auto states = circle(1.0 / 400, 2000);
  EXPECT_EQ(repeats_after<2>(states, 1e-9).lag, 0U);
  EXPECT_EQ(repeats_after<2>(states, 1e-9, 2).lag, 400U);
}

TEST(RepeatsAfter, LeavesTheTransientOfTheFirstHalfOut) {
  auto states = circle(1.0 / 25, 2000);
  for (std::size_t n = 0; n < 960; ++n) states[n] *= 3.0;
  EXPECT_EQ(repeats_after<2>(states, 1e-9).lag, 25U);
  states[1700][0] += 1e-3 * 1e-6;
  EXPECT_EQ(repeats_after<2>(states, 1e-9).lag, 0U) << "one state of the second half is enough";
  EXPECT_EQ(repeats_after<2>(states, 1e-5).lag, 25U);
}

TEST(RepeatsAfter, AnIrrationalRotationNeverRepeats) {
  EXPECT_EQ(repeats_after<2>(circle(golden_turn, 20000), 1e-6).lag, 0U);
  // Fibonacci lags come back to π φ⁻ᵏ/√5 of the extent or so.
  const RepeatSearch coarse = repeats_after<2>(circle(golden_turn, 20000), 0.01);
  EXPECT_EQ(coarse.lag, 144U);
}

TEST(RepeatsAfter, ACoordinateOfRoundOffNeedsItsSize) {
  test::Random random(723);
  auto states = circle(1.0 / 2, 2000);
  for (Pair& state : states) state[1] = 1e-16 * random.unit();
  EXPECT_EQ(repeats_after<2>(states, 1e-9).lag, 0U);
  EXPECT_EQ(repeats_after<2>(states, 1e-9, 3, Pair(0.0, 1.0)).lag, 2U);
}

TEST(RepeatsAfter, WhatHasDecayedBelowRoundOffIsAtRest) {
  std::vector<Pair> states(1000);
  for (std::size_t n = 0; n < states.size(); ++n)
    states[n] = std::pow(0.9, 400.0 + static_cast<double>(n)) * Pair(1.0, -1.0);
  EXPECT_EQ(repeats_after<2>(states, 1e-9).lag, 0U);
  EXPECT_EQ(repeats_after<2>(states, 1e-9, 3, Pair(1.0, 1.0)).lag, 1U);
}

TEST(ClosestReturn, OfARotationComesAfterAFibonacciNumber) {
  const double closest = closest_return<2>(circle(golden_turn, 1000));
  // |x_n − x_0| = 2 |sin π n g|, at most half of that in each coordinate's own extent.
  const double chord = std::abs(std::sin(3.141592653589793 * 987 * golden_turn));
  EXPECT_LE(closest, chord * (1 + 1e-9));
  EXPECT_GE(closest, chord * std::sqrt(0.5) * (1 - 1e-9));
}

TEST(ClosestReturn, OfOneStateThereIsNone) { EXPECT_EQ(closest_return<2>({Pair(0, 1)}), 1.0); }

TEST(RecurrenceDeterminism, AgreesWithTheWholePlot) {
  const auto states = scattered(60, 721);
  const double radius = 0.2;
  const RelativeDistance<2> distance(states);
  const auto recurs = [&](std::size_t i, std::size_t j) {
    return i < 60 && j < 60 && distance(states[i], states[j]) <= radius;
  };
  int recurrent = 0, in_lines = 0;
  for (std::size_t i = 0; i < 60; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!recurs(i, j)) continue;
      ++recurrent;
      if (recurs(i + 1, j + 1) || (j > 0 && recurs(i - 1, j - 1))) ++in_lines;
    }
  }
  EXPECT_DOUBLE_EQ(recurrence_determinism<2>(states, radius),
                   static_cast<double>(in_lines) / recurrent);
}

TEST(RecurrenceDeterminism, TellsAClosedCurveFromChance) {
  EXPECT_GT(recurrence_determinism<2>(circle(golden_turn, 1500), 0.05), 0.9);
  // The share of pairs within r in both coordinates of the unit square: (2r − r²)².
  const double rate = std::pow(2 * 0.05 - 0.05 * 0.05, 2);
  EXPECT_NEAR(recurrence_determinism<2>(scattered(1500, 722), 0.05), 1 - std::pow(1 - rate, 2),
              0.005);
}

TEST(RecurrenceDeterminism, AConstantSeriesAlwaysRecurs) {
  const std::vector<Pair> rest(50, Pair(0.3, 0.0));
  // The two ends of the series are a diagonal of one pair.
  EXPECT_DOUBLE_EQ(recurrence_determinism<2>(rest, 1e-9), 1224.0 / 1225.0);
  EXPECT_EQ(closest_return<2>(rest), 0.0);
  EXPECT_EQ(repeats_after<2>(rest, 0.0).lag, 1U);
}

TEST(RelativeDistance, IsInUnitsOfEachCoordinatesExtent) {
  const std::vector<Pair> corners{{0, 0}, {2e-6, 0}, {0, 4e6}, {2e-6, 4e6}};
  const RelativeDistance<2> distance(corners);
  EXPECT_DOUBLE_EQ(distance(corners[0], corners[1]), 1.0);
  EXPECT_DOUBLE_EQ(distance({0, 1e6}, {1e-6, 0}), 0.5);
}

TEST(Recurrence, WhatIsOutOfRangeIsRefused) {
  const std::vector<Pair> none, few(3, Pair(0, 1)), many(5001, Pair(0, 1));
  const std::vector<Pair> broken{{0, 1}, {0, std::numeric_limits<double>::infinity()}};
  EXPECT_THROW(repeats_after<2>(none, 1e-9), InvalidParameter);
  EXPECT_THROW(repeats_after<2>(few, -1e-9), InvalidParameter);
  EXPECT_THROW(repeats_after<2>(few, 1e-9, 0), InvalidParameter);
  EXPECT_THROW(repeats_after<2>(broken, 1e-9), InvalidParameter);
  EXPECT_THROW(closest_return<2>(many), InvalidParameter);
  EXPECT_THROW(recurrence_determinism<2>(many, 0.1), InvalidParameter);
  EXPECT_THROW(recurrence_determinism<2>(few, 0.0), InvalidParameter);
}

std::vector<bool> word(const std::string& symbols) {
  std::vector<bool> result;
  for (const char symbol : symbols) result.push_back(symbol == '1');
  return result;
}

std::vector<bool> coins(std::size_t count, double share, std::uint64_t seed) {
  test::Random random(seed);
  std::vector<bool> result(count);
  for (std::size_t n = 0; n < count; ++n) result[n] = random.unit() < share;
  return result;
}

std::vector<bool> periodic_word(std::size_t count, const std::vector<bool>& period) {
  std::vector<bool> result(count);
  for (std::size_t n = 0; n < count; ++n) result[n] = period[n % period.size()];
  return result;
}

double entropy_of_share(double p) { return -p * std::log2(p) - (1 - p) * std::log2(1 - p); }

TEST(SwitchingComplexity, OfCoinsIsTheirEntropy) {
  for (const double share : {0.5, 0.2}) {
    const SwitchingComplexity found = switching_complexity(coins(200000, share, 732));
    EXPECT_NEAR(found.entropy, entropy_of_share(share), 0.01) << share;
    EXPECT_EQ(found.block, 11U);
  }
}

TEST(SwitchingComplexity, OfAPeriodicSequenceIsZero) {
  const SwitchingComplexity found = switching_complexity(periodic_word(20000, word("1110010")));
  EXPECT_EQ(found.entropy, 0.0);
  EXPECT_EQ(found.switches, 20000U / 7 * 4) << "three inside a period, one to the next";
}

TEST(BlockEntropy, CountsEachWord) {
  const auto sequence = word("00110");  // 00, 01, 11, 10
  EXPECT_EQ(block_entropy(sequence, 0), 0.0);
  EXPECT_NEAR(block_entropy(sequence, 1), entropy_of_share(0.4), 1e-14);
  EXPECT_NEAR(block_entropy(sequence, 2), 2.0, 1e-14);
  EXPECT_NEAR(block_entropy(sequence, 5), 0.0, 1e-14);
}

TEST(SwitchingComplexity, WhatIsOutOfRangeIsRefused) {
  EXPECT_THROW(switching_complexity(std::vector<bool>(63, true)), InvalidParameter);
  EXPECT_THROW(switching_complexity(std::vector<bool>(1000001, true)), InvalidParameter);
  EXPECT_THROW(block_entropy(word("0101"), 5), InvalidParameter);
  EXPECT_THROW(block_entropy(std::vector<bool>(100, true), 21), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
