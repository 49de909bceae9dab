#include "holdfast/math/roots/bracketing_root.hpp"

#include "support/random.hpp"

namespace holdfast {
namespace {

SignChange<double> root_between(const std::function<double(double)>& function, double lower,
                                double upper, double tolerance = 0.0) {
  return bracketing_root(
      function, SignChange<double>{lower, upper, function(lower), function(upper)}, tolerance);
}

TEST(BracketingRoot, EndsAtTwoNeighboursBetweenWhichTheSignChanges) {
  const auto cubic = [](double x) { return x * x * x - 2.0; };
  const auto found = root_between(cubic, 0.0, 2.0);
  EXPECT_LE(found.upper - found.lower, 2e-15);
  EXPECT_LE(found.lower, std::cbrt(2.0) + 1e-15);
  EXPECT_GE(found.upper, std::cbrt(2.0) - 1e-15);
  EXPECT_LE(found.value_at_lower * found.value_at_upper, 0.0);
}

TEST(BracketingRoot, ConvergesFasterThanBisectionOnSmoothFunctions) {
  int evaluations = 0;
  const std::function<double(double)> functions[] = {
      [](double x) { return std::exp(x) - 3.0; }, [](double x) { return std::cos(x) - x; },
      [](double x) { return x * x * x - 2.0; }, [](double x) { return std::log(x + 0.1); }};
  for (const auto& function : functions) {
    const auto found = root_between(function, 0.0, 2.0, 1e-14);
    EXPECT_LE(found.upper - found.lower, 1e-14);
    EXPECT_LE(found.evaluations, 16);
    evaluations += found.evaluations;
  }
  EXPECT_LE(evaluations, 4 * 12) << "bisection takes 48 each";
}

TEST(BracketingRoot, BisectsAJump) {
  test::Random random(611);
  for (int draw = 0; draw < 200; ++draw) {
    const double jump = random.uniform(0.0, 1.0), below = -random.log_uniform(1e-9, 1e9);
    const auto found =
        root_between([&](double x) { return x < jump ? below : 1.0; }, 0.0, 1.0, 0x1p-40);
    EXPECT_LE(found.evaluations, 42);
    EXPECT_LE(found.lower, jump);
    EXPECT_GE(found.upper, jump);
    EXPECT_LE(found.upper - found.lower, 0x1p-40);
  }
}

TEST(BracketingRoot, FallsAsWellAsItRises) {
  const auto found = root_between([](double x) { return 2.0 - x * x; }, 0.5, 3.0, 1e-12);
  EXPECT_GT(found.value_at_lower, 0.0);
  EXPECT_NEAR(found.lower, std::sqrt(2.0), 1e-12);
}

TEST(BracketingRoot, OfAnExactZeroIsThatArgument) {
  const auto found = root_between([](double x) { return x - 0.5; }, 0.0, 1.0);
  EXPECT_EQ(found.lower, 0.5);
  EXPECT_EQ(found.upper, 0.5);
}

TEST(BracketingRoot, WithoutAChangeOfSignIsWhatCameIn) {
  const auto found = root_between([](double x) { return x * x + 1.0; }, -1.0, 1.0);
  EXPECT_EQ(found.lower, -1.0);
  EXPECT_EQ(found.upper, 1.0);
  EXPECT_EQ(found.evaluations, 0);
}

TEST(BracketingRoot, InExtendedPrecisionReachesItsRoundOff) {
  const auto function = [](long double x) { return x * x - 2.0L; };
  const auto found = bracketing_root(
      function, SignChange<long double>{1.0L, 2.0L, function(1.0L), function(2.0L)}, 0.0L);
  EXPECT_NEAR(static_cast<double>((found.lower - std::sqrt(2.0L)) * 1e18L), 0.0, 1.0);
}

TEST(BracketingRoot, ANumberThatIsNoneCountsAsNegativeAndEndsNothing) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const auto found = bracketing_root([&](double x) { return x < 0.3 ? none : 1.0; },
                                     SignChange<double>{0.0, 1.0, -1.0, 1.0}, 1e-9);
  EXPECT_NEAR(found.lower, 0.3, 1e-8);
}

}  // namespace
}  // namespace holdfast
