#include "holdfast/chaos/switching_complexity.hpp"

#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

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

TEST(SwitchingComplexity, OfAMarkovChainIsThatOfItsSteps) {
  // Changes with probability 0.1: entropy h(0.1) a symbol though both symbols are equally likely.
  auto sequence = coins(200000, 0.1, 733);
  for (std::size_t n = 1; n < sequence.size(); ++n) sequence[n] = sequence[n] != sequence[n - 1];
  const SwitchingComplexity found = switching_complexity(sequence);
  EXPECT_NEAR(found.entropy, entropy_of_share(0.1), 0.01);
  EXPECT_NEAR(block_entropy(sequence, 1), 1.0, 0.01);
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
