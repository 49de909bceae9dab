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

TEST(NormalQuantile, HoldsItsShareOfTheNormalDistribution) {
  for (const double confidence : {0.01, 0.5, 0.6827, 0.95, 0.99, 0.9999})
    EXPECT_NEAR(std::erf(normal_quantile(confidence) / std::sqrt(2.0)), confidence, 1e-14);
}

/// P(|T| ≤ t) for Student's T, by Simpson's rule on its density in the angle t = √ν tan θ.
double share_within(double t, double freedom) {
  const double end = std::atan(t / std::sqrt(freedom));
  const int panels = 2000;
  double inside = 0.0, all = 0.0;
  for (int k = 0; k <= panels; ++k) {
    const double weight = k == 0 || k == panels ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0);
    inside += weight * end * std::pow(std::cos(end * k / panels), freedom - 1);
    all += weight * 0.5 * pi<double> *
           std::pow(std::abs(std::cos(0.5 * pi<double> * k / panels)), freedom - 1);
  }
  return inside / all;
}

TEST(StudentQuantile, HoldsItsShareOfStudentsDistribution) {
  for (const double freedom : {3.0, 4.0, 7.0, 31.0, 63.0}) {
    EXPECT_NEAR(share_within(student_quantile(0.95, freedom), freedom), 0.95, 3e-4) << freedom;
    EXPECT_NEAR(share_within(student_quantile(0.5, freedom), freedom), 0.5, 3e-4) << freedom;
  }
  EXPECT_NEAR(student_quantile(0.95, 1e12), normal_quantile(0.95), 1e-10);
}

TEST(BatchMeans, HalfWidthIsTheQuantileForTheBatchesThatThereAre) {
  test::Random random(44);
  BatchMeans<double> series;
  for (int n = 0; n < 3; ++n) series.push(random.normal());
  EXPECT_TRUE(std::isnan(series.half_width(0.95)));
  for (int n = 3; n < 500; ++n) {
    series.push(random.normal());
    const double freedom = static_cast<double>(series.batches()) - 1;
    EXPECT_DOUBLE_EQ(series.half_width(0.9),
                     student_quantile(0.9, freedom) * series.standard_error());
  }
}

TEST(BatchMeans, HalfWidthCoversAlsoWithFewBatches) {
  // Five values: twice the standard error would cover 88 of 100, Student's quantile 95.
  int covered = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    test::Random random(3000 + seed);
    BatchMeans<double> series;
    for (int n = 0; n < 5; ++n) series.push(random.normal());
    if (std::abs(series.mean()) <= series.half_width(0.95)) ++covered;
  }
  EXPECT_NEAR(covered, 950, 25);
}

TEST(BatchMeans, QuantilesOutOfRangeAreRefused) {
  EXPECT_THROW(normal_quantile(0.0), InvalidParameter);
  EXPECT_THROW(normal_quantile(1.0), InvalidParameter);
  EXPECT_THROW(student_quantile(0.95, 2.0), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
