// Kollár 2022, Table 2: the Lyapunov exponents per sample.
//
// The trajectory has δ = 0. The paper's tangent maps are S and S* as printed in Eq. (14), which
// belong to δ = τ; the consistent tangent has the δ of the trajectory. The fifth exponent is −∞
// exactly, since S* has a row of zeros; the paper's −33.26 and −29.23 are logarithms of round-off.

#include "holdfast/chaos/lyapunov_run.hpp"
#include "support/kollar_case.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Vector<double, 5> exponents(double period, double duration, bool printed_tangent) {
  const test::KollarCase which = test::kollar_case(period, 0.002);
  test::KollarCase tangent = which;
  if (printed_tangent) tangent.processing_delay = period;
  LyapunovObserver observer(tangent.loop(), which.gains);
  auto motion = which.motion();
  run_trajectory(motion, samples_within(duration, period), std::nullopt, observer);
  return observer.spectrum().exponents();
}

TEST(Table2, OneMillisecondWithThePrintedTangent) {
  const auto lambda = exponents(0.001, 10.0, true);
  EXPECT_NEAR(lambda[0], -0.0010, 0.00005);
  EXPECT_NEAR(lambda[1], -0.0014, 0.00005 + 0.01 * 0.0014);
  EXPECT_NEAR(lambda[2], -0.0476, 0.01 * 0.0476);
  // The paper's fourth is 2 % away from this one, more than it claims; these digits come from a
  // separate computation of the same model.
  EXPECT_NEAR(lambda[3], -0.0486, 0.00005);
  EXPECT_EQ(lambda[4], -infinity);
}

TEST(Table2, ElevenMillisecondsWithThePrintedTangent) {
  const auto lambda = exponents(0.011, 100.0, true);
  EXPECT_NEAR(lambda[0], -0.0140, 0.01 * 0.0140);
  EXPECT_NEAR(lambda[2], -0.1855, 0.01 * 0.1855);
  EXPECT_NEAR(lambda[3], -0.4789, 0.00005 + 0.001 * 0.4789);
  // −0.0148 in the paper, 1.4 % away: its motion of 100 s need not be the same to the last switch.
  EXPECT_NEAR(lambda[1], -0.0146, 0.00005);
  EXPECT_EQ(lambda[4], -infinity);
}

TEST(Table2, ElevenMillisecondsWithTheConsistentTangent) {
  const auto lambda = exponents(0.011, 100.0, false);
  EXPECT_NEAR(lambda[0], -0.0116, 0.00005);
  EXPECT_NEAR(lambda[1], -0.0119, 0.00005);
  EXPECT_NEAR(lambda[2], -0.3285, 0.00005);
  EXPECT_NEAR(lambda[3], -0.4580, 0.00005);
  EXPECT_EQ(lambda[4], -infinity);
}

TEST(Table2, NoExponentIsPositive) {
  for (const bool printed : {true, false}) {
    EXPECT_LT(exponents(0.001, 10.0, printed).maxCoeff(), 0.0);
    EXPECT_LT(exponents(0.011, 100.0, printed).maxCoeff(), 0.0);
  }
}

}  // namespace
}  // namespace holdfast
