#include "holdfast/chaos/switching_complexity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "support/random.hpp"

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

/// The definition, word by word.
std::size_t phrases_by_search(const std::string& symbols) {
  std::size_t phrases = 0, from = 0;
  while (from < symbols.size()) {
    std::size_t length = 1;
    const auto seen = [&](std::size_t n) {
      return symbols.substr(0, from + n - 1).find(symbols.substr(from, n)) != std::string::npos;
    };
    while (from + length <= symbols.size() && seen(length)) ++length;
    from += length;
    ++phrases;
  }
  return phrases;
}

double entropy_of_share(double p) { return -p * std::log2(p) - (1 - p) * std::log2(1 - p); }

TEST(LempelZiv, CutsTheExampleOfThePaperIntoSixPhrases) {
  // 0 · 001 · 10 · 100 · 1000 · 101
  EXPECT_EQ(lempel_ziv_phrases(word("0001101001000101")), 6U);
}

TEST(LempelZiv, ConstantAndAlternatingWordsHaveTwoAndThreePhrases) {
  EXPECT_EQ(lempel_ziv_phrases({}), 0U);
  EXPECT_EQ(lempel_ziv_phrases(word("1")), 1U);
  EXPECT_EQ(lempel_ziv_phrases(std::vector<bool>(1000, true)), 2U);    // 1 · 111…
  EXPECT_EQ(lempel_ziv_phrases(periodic_word(1000, word("01"))), 3U);  // 0 · 1 · 0101…
}

TEST(LempelZiv, AgreesWithTheDefinitionOnEveryShortWordAndOnRandomOnes) {
  for (std::size_t bits = 0; bits < 4096; ++bits) {
    std::string symbols;
    for (std::size_t place = 0; place < 12; ++place) symbols += (bits >> place) % 2 ? '1' : '0';
    ASSERT_EQ(lempel_ziv_phrases(word(symbols)), phrases_by_search(symbols)) << symbols;
  }
  test::Random random(731);
  for (int draw = 0; draw < 50; ++draw) {
    std::string symbols;
    const double share = random.uniform(0.05, 0.95);
    for (int n = 0; n < 300; ++n) symbols += random.unit() < share ? '1' : '0';
    ASSERT_EQ(lempel_ziv_phrases(word(symbols)), phrases_by_search(symbols)) << symbols;
  }
}

TEST(SwitchingComplexity, OfCoinsIsTheirEntropy) {
  for (const double share : {0.5, 0.2}) {
    const SwitchingComplexity found = switching_complexity(coins(200000, share, 732));
    EXPECT_NEAR(found.entropy, entropy_of_share(share), 0.01) << share;
    EXPECT_NEAR(found.normalised, entropy_of_share(share), 0.08) << share;
    EXPECT_EQ(found.block, 11U);
  }
}

TEST(SwitchingComplexity, OfAPeriodicSequenceIsZero) {
  const SwitchingComplexity found = switching_complexity(periodic_word(20000, word("1110010")));
  EXPECT_EQ(found.entropy, 0.0);
  EXPECT_LT(found.normalised, 0.01);
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
