#include "holdfast/chaos/zero_one_test.hpp"

#include "support/random.hpp"

namespace holdfast {
namespace {

std::vector<double> logistic_series(double r, std::size_t samples) {
  std::vector<double> series(samples);
  double x = 0.3;
  for (int n = 0; n < 1000; ++n) x = r * x * (1 - x);
  for (double& value : series) {
    value = x;
    x = r * x * (1 - x);
  }
  return series;
}

std::vector<double> two_tones(std::size_t samples) {
  std::vector<double> series(samples);
  for (std::size_t n = 0; n < samples; ++n) {
    const double time = static_cast<double>(n);
    series[n] = std::cos(std::sqrt(2.0) * time) + 0.5 * std::cos(std::sqrt(5.0) * time + 1.0);
  }
  return series;
}

/// K_c straight from the definition: every stretch φ_{j+1} … φ_{j+n} summed for itself, and the
/// correlation of the sums with n by its textbook formula.
double correlation_by_definition(const std::vector<double>& centred, double c) {
  const std::size_t lags = centred.size() / 10;
  double n_sum = 0, n_squares = 0, sum = 0, squares = 0, products = 0;
  for (std::size_t n = 1; n <= lags; ++n) {
    double displacement = 0;
    for (std::size_t begin = 0; begin + lags <= centred.size(); ++begin) {
      std::complex<double> stretch = 0;
      for (std::size_t i = begin + 1; i <= begin + n; ++i)
        stretch += centred[i - 1] * std::polar(1.0, c * static_cast<double>(i));
      displacement += std::norm(stretch);
    }
    const double lag = static_cast<double>(n);
    n_sum += lag;
    n_squares += lag * lag;
    sum += displacement;
    squares += displacement * displacement;
    products += lag * displacement;
  }
  const double count = static_cast<double>(lags);
  return (count * products - n_sum * sum) /
         std::sqrt((count * n_squares - n_sum * n_sum) * (count * squares - sum * sum));
}

TEST(ZeroOneTest, IsTheCorrelationOfItsDefinition) {
  for (std::vector<double> series : {logistic_series(3.9, 300), two_tones(300)}) {
    const double of_two = zero_one_test(series, 2), of_three = zero_one_test(series, 3);
    double mean = 0;
    for (const double value : series) mean += value / 300;
    for (double& value : series) value -= mean;
    std::array<double, 3> expected{};
    for (std::size_t k = 0; k < expected.size(); ++k) {
      const double turns = 0.7548776662466927 * static_cast<double>(k + 1);
      const double c = pi<double> * (0.2 + 0.6 * std::fmod(turns, 1.0));
      expected[k] = correlation_by_definition(series, c);
    }
    EXPECT_NEAR(of_two, (expected[0] + expected[1]) / 2, 1e-9);
    std::sort(expected.begin(), expected.end());
    EXPECT_NEAR(of_three, expected[1], 1e-9);
  }
}

TEST(ZeroOneTest, IsNearOneForChaosAtEveryLength) {
  for (const std::size_t samples : {500U, 5000U, 100000U}) {
    EXPECT_GT(zero_one_test(logistic_series(4.0, samples)), 0.85) << samples;
    EXPECT_GT(zero_one_test(logistic_series(3.9, samples)), 0.85) << samples;
  }
}

TEST(ZeroOneTest, IsNearZeroForRegularMotionAtEveryLength) {
  for (const std::size_t samples : {500U, 5000U, 100000U}) {
    EXPECT_LT(std::abs(zero_one_test(logistic_series(3.5, samples))), 0.2) << samples;
    EXPECT_LT(std::abs(zero_one_test(two_tones(samples))), 0.2) << samples;
  }
}

TEST(ZeroOneTest, IsNearOneForIndependentNumbersToo) {
  // p and q then are random walks: the test tells regular from irregular, noise it does not know.
  test::Random random(711);
  std::vector<double> series(5000);
  for (double& value : series) value = random.normal();
  EXPECT_GT(zero_one_test(series), 0.9);
}

TEST(ZeroOneTest, AConstantSeriesHasZeroByDefinition) {
  for (const double level : {0.0, -3.7, 1e-300, 1e200}) {
    EXPECT_EQ(zero_one_test(std::vector<double>(300, level)), 0.0);
  }
  std::vector<double> rounded(300, 0.1);
  for (std::size_t n = 0; n < rounded.size(); n += 3) rounded[n] = 0.1 + 2e-17;
  EXPECT_EQ(zero_one_test(rounded), 0.0);
}

TEST(ZeroOneTest, DoesNotChangeWithShiftAndScale) {
  const std::vector<double> series = logistic_series(3.6, 1000);
  std::vector<double> other = series;
  for (double& value : other) value = 1e-4 - 1e-6 * value;
  EXPECT_NEAR(zero_one_test(series), zero_one_test(other), 1e-8);
}

TEST(ZeroOneTest, AToneOfATriedFrequencyDoesNotMoveTheMedian) {
  // The first c is π/5 + (3π/5) · 0.7548…: there p grows without bound, K_c = 1.
  const double resonant = pi<double> * (0.2 + 0.6 * 0.7548776662466927);
  std::vector<double> series(2000);
  for (std::size_t n = 0; n < series.size(); ++n)
    series[n] = std::cos(resonant * static_cast<double>(n));
  EXPECT_GT(zero_one_test(series, 1), 0.9);
  EXPECT_LT(std::abs(zero_one_test(series)), 0.2);
}

TEST(ZeroOneTest, WhatIsOutOfRangeIsRefused) {
  EXPECT_THROW(zero_one_test(std::vector<double>(199, 1.0)), InvalidParameter);
  EXPECT_THROW(zero_one_test(std::vector<double>(100001, 1.0)), InvalidParameter);
  EXPECT_THROW(zero_one_test(two_tones(300), 0), InvalidParameter);
  std::vector<double> series = two_tones(300);
  series[150] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(zero_one_test(series), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
