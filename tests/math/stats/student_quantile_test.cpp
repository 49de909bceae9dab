#include "holdfast/math/stats/student_quantile.hpp"

#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

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

TEST(StudentQuantile, CoversTheMeanOfFewValues) {
  // Five values: twice the standard error would cover 88 of 100, Student's quantile 95.
  int covered = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    test::Random random(3000 + seed);
    double sum = 0, squares = 0;
    for (int n = 0; n < 5; ++n) {
      const double value = random.normal();
      sum += value;
      squares += value * value;
    }
    const double error = std::sqrt((squares - sum * sum / 5) / 4 / 5);
    if (std::abs(sum / 5) <= student_quantile(0.95, 4) * error) ++covered;
  }
  EXPECT_NEAR(covered, 950, 25);
}

TEST(StudentQuantile, OutOfRangeIsRefused) {
  EXPECT_THROW(normal_quantile(0.0), InvalidParameter);
  EXPECT_THROW(normal_quantile(1.0), InvalidParameter);
  EXPECT_THROW(student_quantile(0.95, 2.0), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
