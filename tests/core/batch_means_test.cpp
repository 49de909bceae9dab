#include "holdfast/core/batch_means.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random.hpp"

namespace holdfast {
namespace {

TEST(BatchMeans, MeanIsThatOfAllValuesAtEveryLength) {
  test::Random random(41);
  BatchMeans<double> series;
  double sum = 0;
  for (int n = 1; n <= 1000; ++n) {
    const double value = random.uniform(-1, 3);
    sum += value;
    series.push(value);
    EXPECT_EQ(series.count(), n);
    EXPECT_NEAR(series.mean(), sum / n, 1e-13);
  }
}

TEST(BatchMeans, NoMeanBeforeTheFirstValueAndNoErrorBeforeFourBatches) {
  BatchMeans<double> series;
  EXPECT_TRUE(std::isnan(series.mean()));
  for (int n = 0; n < 3; ++n) {
    series.push(n);
    EXPECT_TRUE(std::isnan(series.standard_error()));
  }
  series.push(3);
  EXPECT_FALSE(std::isnan(series.standard_error()));
}

TEST(BatchMeans, FourValuesGiveTheTextbookStandardError) {
  BatchMeans<double> series;
  for (const double value : {1.0, 2.0, 3.0, 6.0}) series.push(value);
  // Deviations from the mean 3: −2, −1, 0, 3; variance 14/3 of one value, 14/12 of the mean.
  EXPECT_NEAR(series.standard_error(), std::sqrt(14.0 / 12.0), 1e-15);
}

TEST(BatchMeans, AConstantSeriesHasNoError) {
  BatchMeans<double> series;
  for (int n = 0; n < 1000; ++n) series.push(0.25);
  EXPECT_EQ(series.mean(), 0.25);
  EXPECT_EQ(series.standard_error(), 0.0);
}

TEST(BatchMeans, BatchesCoverTheKnownMeanOfIndependentValues) {
  // With at least 32 batches, 2 standard errors hold the mean in 95 of 100 repeats on average;
  // below 90 or all of 100 would each be rarer than one in a hundred for an honest error.
  int covered = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    test::Random random(1000 + seed);
    BatchMeans<double> series;
    for (int n = 0; n < 3000; ++n) series.push(0.7 + random.normal());
    if (std::abs(series.mean() - 0.7) <= 2.0 * series.standard_error()) ++covered;
  }
  EXPECT_GE(covered, 90);
  EXPECT_LT(covered, 100);
}

TEST(BatchMeans, ErrorsOfCorrelatedValuesAreNotUnderestimated) {
  // x' = 0.9 x + noise has a mean whose variance is 19 times that of independent values of its
  // spread; long batches see it, the textbook formula would cover only a third of the repeats.
  int covered = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    test::Random random(2000 + seed);
    BatchMeans<double> series;
    double x = 0;
    for (int n = 0; n < 20000; ++n) {
      x = 0.9 * x + random.normal();
      series.push(x);
    }
    if (std::abs(series.mean()) <= 2.0 * series.standard_error()) ++covered;
  }
  EXPECT_GE(covered, 90);
}

TEST(BatchMeans, ErrorFallsWithTheRootOfTheLength) {
  test::Random random(43);
  BatchMeans<double> shorter, longer;
  for (int n = 0; n < 4096; ++n) shorter.push(random.normal());
  for (int n = 0; n < 64 * 4096; ++n) longer.push(random.normal());
  EXPECT_NEAR(shorter.standard_error() / longer.standard_error(), 8.0, 3.0);
  EXPECT_NEAR(longer.standard_error() * std::sqrt(64.0 * 4096.0), 1.0, 0.3);
}

}  // namespace
}  // namespace holdfast
