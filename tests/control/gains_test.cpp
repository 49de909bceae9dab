#include "holdfast/control/gains.hpp"

#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(PdGains, TheFeedbackRowActsOnTheConductorOnly) {
  const PdGains<double> gains{-557.0, -13.0};
  const Vector<double, 4> z(0.001, 0.02, 5.0, 7.0);
  EXPECT_DOUBLE_EQ((gains.feedback_row() * z).value(), -557.0 * 0.001 - 13.0 * 0.02);
}

TEST(TunedProportionalGain, IsZeroAtTheAbsorbersOwnFrequency) {
  const double own = std::sqrt(74.4 / 0.16) / (2.0 * pi<double>);
  EXPECT_NEAR(tuned_proportional_gain(74.4, 0.16, own), 0.0, 1e-12);
  EXPECT_GT(tuned_proportional_gain(74.4, 0.16, 0.99 * own), 0.0);
  EXPECT_LT(tuned_proportional_gain(74.4, 0.16, 1.01 * own), 0.0);
}

TEST(TunedProportionalGain, MakesTheAbsorbersStiffnessResonateWithTheExcitation) {
  const double omega = 2.0 * pi<double> * 6.0;
  const double gain = tuned_proportional_gain(74.4, 0.16, 6.0);
  EXPECT_NEAR((74.4 - gain) / 0.16, omega * omega, 1e-10);
}

}  // namespace
}  // namespace holdfast
