#include "holdfast/stability/design/max_delay.hpp"
#include "holdfast/control/loop_input.hpp"
#include "holdfast/plant/two_mass.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "holdfast/math/linalg/spectral_radius.hpp"

namespace holdfast {
namespace {

MaxDelayOptions tuned_to(double frequency, DelayCriterion criterion) {
  MaxDelayOptions options;
  options.frequency = frequency;
  options.proportional_gain = tuned_proportional_gain(74.4, 0.16, frequency);
  options.criterion = criterion;
  return options;
}

TEST(MaxDelay, JustBelowIsFeasibleAndJustAboveIsNot) {
  const auto plant = kollar2022_plant();
  for (const auto criterion : {DelayCriterion::stable, DelayCriterion::attenuates}) {
    for (const double frequency : {8.0, 10.0, 20.0}) {
      const auto options = tuned_to(frequency, criterion);
      const auto answer = max_sampling_period(plant, options);
      ASSERT_EQ(answer.outcome, MaxDelayOutcome::found);
      EXPECT_TRUE(feasible_differential_gain(plant, options, answer.sampling_period));
      EXPECT_TRUE(feasible_differential_gain(plant, options, answer.sampling_period * (1 - 1e-9)));
      EXPECT_FALSE(feasible_differential_gain(plant, options, answer.sampling_period * (1 + 1e-9)));
      EXPECT_TRUE(std::isfinite(answer.differential_gain));
    }
  }
}

TEST(MaxDelay, AttenuatingAsksForMoreThanStability) {
  const auto plant = kollar2022_plant();
  for (const double frequency : {8.0, 10.0, 20.0, 40.0}) {
    for (const double fraction : {0.0, 0.5, 1.0}) {
      auto options = tuned_to(frequency, DelayCriterion::stable);
      options.delay_fraction = fraction;
      const auto stable = max_sampling_period(plant, options);
      options.criterion = DelayCriterion::attenuates;
      const auto attenuates = max_sampling_period(plant, options);
      EXPECT_LE(attenuates.sampling_period, stable.sampling_period * (1 + 1e-11))
          << frequency << ' ' << fraction;
    }
  }
}

TEST(MaxDelay, NamesWhatALongerPeriodLacks) {
  const auto plant = kollar2022_plant();
  const auto answer = [&](double frequency, DelayCriterion criterion) {
    return max_sampling_period(plant, tuned_to(frequency, criterion));
  };
  for (const double frequency : {10.0, 15.0, 20.0, 30.0, 40.0}) {
    const MaxDelay stable = answer(frequency, DelayCriterion::stable);
    const MaxDelay attenuates = answer(frequency, DelayCriterion::attenuates);
    EXPECT_EQ(stable.limit, MaxDelayLimit::stability) << frequency;
    // Stable gains are left beyond τ* where stability asks for less.
    const bool stable_gains_left = attenuates.sampling_period < 0.99 * stable.sampling_period;
    EXPECT_EQ(stable_gains_left, frequency < 16.0) << frequency;
    EXPECT_EQ(attenuates.limit,
              stable_gains_left ? MaxDelayLimit::attenuation : MaxDelayLimit::stability)
        << frequency;
  }
  EXPECT_EQ(answer(5.0, DelayCriterion::stable).limit, MaxDelayLimit::none);
}

TEST(MaxDelay, SamplesThatNoLongerShowTheVibrationAreTheLastLimit) {
  auto options = tuned_to(10.0, DelayCriterion::attenuates);
  options.proportional_gain = 0.0;
  const MaxDelay answer = max_sampling_period(kollar2022_plant(), options);
  EXPECT_EQ(answer.limit, MaxDelayLimit::nyquist);
  EXPECT_NEAR(answer.sampling_period, 0.05, 1e-12);
}

TEST(MaxDelay, NoGainServesWhereTheSamplesDoNotShowTheVibration) {
  const auto plant = kollar2022_plant();
  auto options = tuned_to(10.0, DelayCriterion::attenuates);
  options.proportional_gain = 0.0;
  EXPECT_FALSE(feasible_differential_gains(plant, options, 0.049).empty());
  EXPECT_TRUE(feasible_differential_gains(plant, options, 0.051).empty());
  EXPECT_TRUE(feasible_differential_gain(plant, options, 0.049));
  EXPECT_FALSE(feasible_differential_gain(plant, options, 0.051));
}

TEST(MaxDelay, TheGainThatItNamesServes) {
  const auto plant = kollar2022_plant();
  const auto options = tuned_to(10.0, DelayCriterion::attenuates);
  for (const double period : {0.001, 0.01, 0.02}) {
    const auto gain = feasible_differential_gain(plant, options, period);
    ASSERT_TRUE(gain);
    const auto loop = sampled_loop(plant, Sampling<double>{period});
    const double omega = 2.0 * pi<double> * 10.0;
    const SteadyResponse<double> response(loop, held_harmonic(loop), omega);
    EXPECT_LT(response.ratio_to_uncontrolled({options.proportional_gain, *gain}), 1.0);
    // The best gain may be the end of a stable interval, the limit of stable gains.
    EXPECT_LE((spectral_radius<double, 5>(loop.engaged_map({options.proportional_gain, *gain}))),
              1.0 + 1e-9);
  }
}

TEST(MaxDelay, IsUnlimitedWhereNoControlIsNeededForStability) {
  auto options = tuned_to(10.0, DelayCriterion::stable);
  options.proportional_gain = 0.0;
  const auto answer = max_sampling_period(kollar2022_plant(), options);
  EXPECT_EQ(answer.outcome, MaxDelayOutcome::unlimited);
  EXPECT_EQ(answer.sampling_period, std::numeric_limits<double>::infinity());
}

TEST(MaxDelay, IsNeverWhereNoDifferentialGainStabilises) {
  // P alone sets the s² coefficient of the continuous loop; this one makes it negative.
  auto options = tuned_to(10.0, DelayCriterion::stable);
  options.proportional_gain = 1e5;
  const auto answer = max_sampling_period(kollar2022_plant(), options);
  EXPECT_EQ(answer.outcome, MaxDelayOutcome::never);
  EXPECT_EQ(answer.sampling_period, 0.0);
  EXPECT_TRUE(std::isnan(answer.differential_gain));
}

TEST(MaxDelay, DependsOnHowTheForceIsHeldOnlyForAttenuation) {
  const auto plant = kollar2022_plant();
  auto options = tuned_to(10.0, DelayCriterion::stable);
  const double sampled = max_sampling_period(plant, options).sampling_period;
  options.hold = ForceHold::exact;
  EXPECT_EQ(max_sampling_period(plant, options).sampling_period, sampled);
}

TEST(MaxDelay, WhatIsOutOfRangeIsRefused) {
  constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto refused = [](const std::function<void(MaxDelayOptions&)>& spoil) {
    auto options = tuned_to(10.0, DelayCriterion::stable);
    spoil(options);
    EXPECT_THROW(max_sampling_period(kollar2022_plant(), options), InvalidParameter);
  };
  for (const double bad : {not_a_number, infinity, -infinity}) {
    refused([bad](auto& q) { q.frequency = bad; });
    refused([bad](auto& q) { q.proportional_gain = bad; });
    refused([bad](auto& q) { q.delay_fraction = bad; });
    refused([bad](auto& q) { q.shortest_period = bad; });
    refused([bad](auto& q) { q.longest_period = bad; });
    refused([bad](auto& q) { q.search_ratio = bad; });
  }
  refused([](auto& q) { q.frequency = 0.0; });
  refused([](auto& q) { q.delay_fraction = -0.1; });
  refused([](auto& q) { q.delay_fraction = 1.1; });
  refused([](auto& q) { q.shortest_period = 0.0; });
  refused([](auto& q) { q.longest_period = q.shortest_period; });
  refused([](auto& q) { q.search_ratio = 1.0; });
  auto plant = kollar2022_plant();
  plant.absorber_mass = -1.0;
  EXPECT_THROW(max_sampling_period(plant, tuned_to(10.0, DelayCriterion::stable)),
               InvalidParameter);
}

}  // namespace
}  // namespace holdfast
