#include "holdfast/math/stats/batch_sums.hpp"

#include "support/random.hpp"

namespace holdfast {
namespace {

/// One series, its values added one by one.
class StepSeries {
 public:
  void push(double value) { sums_.add(Vector<double, 1>(value), 1); }
  double mean() const { return sums_.totals()[0] / static_cast<double>(sums_.steps()); }
  double standard_error() const { return sums_.standard_errors()[0]; }
  std::int64_t count() const { return sums_.steps(); }

 private:
  BatchSums<double, 1> sums_;
};

/// The error of the mean of complete batches of a series, from the definition.
double batch_error(const std::vector<double>& values, std::size_t length) {
  std::vector<double> means;
  for (std::size_t first = 0; first + length <= values.size(); first += length) {
    double sum = 0;
    for (std::size_t k = 0; k < length; ++k) sum += values[first + k];
    means.push_back(sum / static_cast<double>(length));
  }
  double centre = 0, spread = 0;
  const auto count = static_cast<double>(means.size());
  for (const double mean : means) centre += mean / count;
  for (const double mean : means) spread += (mean - centre) * (mean - centre);
  return std::sqrt(spread / count / (count - 1));
}

TEST(BatchSums, NoMeanBeforeTheFirstValueAndNoErrorBeforeFourBatches) {
  StepSeries series;
  EXPECT_TRUE(std::isnan(series.mean()));
  for (int n = 0; n < 3; ++n) {
    series.push(n);
    EXPECT_TRUE(std::isnan(series.standard_error()));
  }
  series.push(3);
  EXPECT_FALSE(std::isnan(series.standard_error()));
}

TEST(BatchSums, FourValuesGiveTheTextbookStandardError) {
  StepSeries series;
  for (const double value : {1.0, 2.0, 3.0, 6.0}) series.push(value);
  // Deviations from the mean 3: −2, −1, 0, 3; variance 14/3 of one value, 14/12 of the mean.
  EXPECT_NEAR(series.standard_error(), std::sqrt(14.0 / 12.0), 1e-15);
}

TEST(BatchSums, SeriesAreApartAndASumMayCoverSeveralSteps) {
  test::Random random(509);
  BatchSums<double, 2> sums, pairs(2);
  std::array<std::vector<double>, 2> values;
  Vector<double, 2> pair = Vector<double, 2>::Zero();
  for (int n = 1; n <= 1001; ++n) {
    const auto value = random.matrix<Vector<double, 2>>();
    sums.add(value, 1);
    for (int i = 0; i < 2; ++i) values[static_cast<std::size_t>(i)].push_back(value[i]);
    pair += value;
    if (n % 2 != 0) continue;
    pairs.add(pair, 2);
    pair.setZero();
  }
  EXPECT_EQ(sums.steps(), 1001);
  EXPECT_EQ(pairs.steps(), 1000);
  // 62 complete batches of 16 values; two neighbours together are batches of 32.
  EXPECT_EQ(sums.complete_batches(), 62U);
  for (int i = 0; i < 2; ++i) {
    const auto& series = values[static_cast<std::size_t>(i)];
    const double mean = std::accumulate(series.begin(), series.end(), 0.0) / 1001;
    EXPECT_NEAR(sums.totals()[i] / 1001, mean, 1e-14);
    EXPECT_NEAR(sums.standard_errors()[i], batch_error(series, 16), 1e-13);
    EXPECT_NEAR(sums.standard_errors(2)[i], batch_error(series, 32), 1e-13);
    EXPECT_NEAR(pairs.standard_errors()[i], sums.standard_errors()[i], 1e-13);
  }
}

}  // namespace
}  // namespace holdfast
