#include "holdfast/math/stats/settled_means.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/stats/share_error.hpp"

#include "support/random.hpp"

namespace holdfast {
namespace {

/// The settled mean of one series.
template <class Step>
SettledMeans<1> mean_of(const Step& step, std::int64_t steps) {
  BatchSums<double, 1> sums;
  for (std::int64_t n = 0; n < steps; ++n) sums.add(Vector<double, 1>(step(n)), 1);
  return settled_means(sums);
}

double half_width(const SettledMeans<1>& found) { return 2.744 * found.standard_errors[0]; }

TEST(SettledMeans, AreThoseOfAllStepsOfASeriesWithoutABeginning) {
  test::Random random(1);
  double sum = 0.0;
  const auto found = mean_of(
      [&](std::int64_t) {
        const double step = random.normal();
        sum += step;
        return step;
      },
      5000);
  EXPECT_EQ(found.left_out, 0);
  EXPECT_EQ(found.steps, 5000);
  EXPECT_NEAR(found.means[0], sum / 5000, 1e-14);
  EXPECT_NEAR(found.standard_errors[0], 1 / std::sqrt(5000.0), 0.5 / std::sqrt(5000.0));
}

TEST(SettledMeans, LeaveOutABeginningThatIsNotTypical) {
  test::Random random(2);
  const auto found =
      mean_of([&](std::int64_t n) { return random.normal() + (n < 700 ? 10.0 : 0.0); }, 10000);
  EXPECT_GE(found.left_out, 700);
  EXPECT_LE(found.left_out, 2500);
  EXPECT_EQ(found.steps + found.left_out, 10000);
  EXPECT_LT(std::abs(found.means[0]), half_width(found));
}

TEST(SettledMeans, HoldTheLimitOfWhatSettlesAsOneOverN) {
  // Sums that grow as ln n: the mean of any part is beyond the limit, 0.
  for (const std::int64_t steps : {100, 1000, 30000}) {
    const auto found =
        mean_of([](std::int64_t n) { return 1.0 / static_cast<double>(n + 1); }, steps);
    EXPECT_GT(found.means[0], 0.0);
    EXPECT_LT(found.means[0], half_width(found)) << steps;
    EXPECT_LT(half_width(found), 40.0 / static_cast<double>(steps));
  }
}

TEST(SettledMeans, HoldTheMeanOfSumsWithinBounds) {
  // cos ω n has the mean 0 and sums that never exceed 1 / sin(ω/2).
  int covered = 0;
  constexpr int series = 300, steps = 1500;
  for (int k = 0; k < series; ++k) {
    test::Random random(static_cast<std::uint64_t>(k));
    const double angle = random.uniform(0.02, 3.1), phase = random.uniform(0.0, 6.28);
    const auto found = mean_of(
        [&](std::int64_t n) { return std::cos(angle * static_cast<double>(n) + phase); }, steps);
    if (std::abs(found.means[0]) <= half_width(found)) ++covered;
    EXPECT_LT(half_width(found), 16.0 / std::sin(0.5 * angle) / steps) << angle;
  }
  EXPECT_GE(covered, series * 98 / 100);
}

TEST(SettledMeans, HaveNoErrorFromFewerThanFourBatches) {
  EXPECT_TRUE(std::isnan(mean_of([](std::int64_t) { return 1.0; }, 3).standard_errors[0]));
  EXPECT_EQ(mean_of([](std::int64_t) { return 1.0; }, 4).standard_errors[0], 0.0);
  EXPECT_TRUE(std::isnan(mean_of([](std::int64_t) { return 1.0; }, 0).means[0]));
}

TEST(ShareError, IsThatOfALargeSample) {
  for (const std::size_t count : {2000U, 5000U, 9999U}) {
    const double share = static_cast<double>(count) / 10000.0;
    const double sample = std::sqrt(share * (1.0 - share) / 10000.0);
    EXPECT_NEAR(share_error(count, 10000) / sample, 1.0, count == 9999U ? 0.3 : 1e-3);
  }
}

TEST(ShareError, IsNotZeroWhereNoneOrAllWereSeen) {
  EXPECT_GT(share_error(0, 100), 0.0);
  EXPECT_DOUBLE_EQ(share_error(0, 100), share_error(100, 100));
  EXPECT_LT(share_error(0, 1000), share_error(0, 100));
}

/// The mean square of how far a uniformly drawn share is from that seen is as large as it says.
TEST(ShareError, IsHowFarTheShareIs) {
  test::Random random(3);
  for (const std::size_t all : {5U, 40U}) {
    double square = 0.0, claimed = 0.0;
    constexpr int trials = 40000;
    for (int trial = 0; trial < trials; ++trial) {
      const double angle = 0.5 * pi<double> * random.unit();  // shares by Jeffreys's prior
      const double share = std::sin(angle) * std::sin(angle);
      std::size_t count = 0;
      for (std::size_t k = 0; k < all; ++k) count += random.unit() < share ? 1U : 0U;
      const double middle = (static_cast<double>(count) + 0.5) / (static_cast<double>(all) + 1.0);
      square += (share - middle) * (share - middle);
      claimed += share_error(count, all) * share_error(count, all);
    }
    EXPECT_NEAR(square / claimed, 1.0, 0.03) << all;
  }
}

}  // namespace
}  // namespace holdfast
