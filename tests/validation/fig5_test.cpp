// Kollár 2022, Fig. 5: the largest sampling period that still attenuates.

#include "holdfast/control/gains.hpp"
#include "holdfast/stability/design/max_delay.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

MaxDelay tuned(double frequency, double delay_fraction = 0.0) {
  const auto plant = kollar2022_plant();
  MaxDelayOptions options;
  options.frequency = frequency;
  options.proportional_gain =
      tuned_proportional_gain(plant.absorber_stiffness, plant.absorber_mass, frequency);
  options.delay_fraction = delay_fraction;
  return max_sampling_period(plant, options);
}

TEST(Figure5, AtTenHertzAboutThirtyMillisecondsStillAttenuate) {
  const auto answer = tuned(10.0);
  ASSERT_EQ(answer.outcome, MaxDelayOutcome::found);
  EXPECT_NEAR(answer.sampling_period, 0.030, 0.0015);
}

TEST(Figure5, AWholePeriodOfDelayLeavesLessThanTwenty) {
  const auto answer = tuned(10.0, 1.0);
  ASSERT_EQ(answer.outcome, MaxDelayOutcome::found);
  EXPECT_LT(answer.sampling_period, 0.020);
}

TEST(Figure5, TheFasterTheVibrationTheFasterTheSampling) {
  double previous = 1.0;
  for (const double frequency : {10.0, 20.0, 30.0, 50.0}) {
    const auto answer = tuned(frequency);
    ASSERT_EQ(answer.outcome, MaxDelayOutcome::found) << frequency;
    EXPECT_LT(answer.sampling_period, previous) << frequency;
    previous = answer.sampling_period;
  }
}

}  // namespace
}  // namespace holdfast
