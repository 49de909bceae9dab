#include "holdfast/stability/design/max_delay.hpp"

#include <stdexcept>

#include "support/lagging_plant.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

MaxDelayOptions tuned_to(double frequency, DelayCriterion criterion) {
  MaxDelayOptions options;
  options.frequency = frequency;
  options.proportional_gain = tuned_proportional_gain(74.4, 0.16, frequency);
  options.criterion = criterion;
  return options;
}

bool is_feasible(const TwoMass<double>& plant, const MaxDelayOptions& options, double period) {
  return !feasible_differential_gains(plant, options, period).empty();
}

TEST(MaxDelay, JustBelowIsFeasibleAndJustAboveIsNot) {
  const auto plant = kollar2022_plant();
  for (const auto criterion : {DelayCriterion::stable, DelayCriterion::attenuates}) {
    for (const double frequency : {8.0, 10.0, 20.0}) {
      const auto options = tuned_to(frequency, criterion);
      const auto answer = max_sampling_period(plant, options);
      ASSERT_EQ(answer.outcome, MaxDelayOutcome::found);
      EXPECT_TRUE(is_feasible(plant, options, answer.sampling_period));
      EXPECT_TRUE(is_feasible(plant, options, answer.sampling_period * (1 - 1e-9)));
      EXPECT_FALSE(is_feasible(plant, options, answer.sampling_period * (1 + 1e-9)));
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

/// At 8 Hz no D stabilises in a window of the period that is some 1e-4 of it wide, and of which the
/// next longer periods show nothing.
TEST(MaxDelay, AttenuatingStopsAtANarrowWindowWithoutAStableGain) {
  const TwoMass<double> stay{429.25305730707925, 1374821.608302698, 48.58585714447236, 30.0,
                             7942.682476955215,  1312.1058436351054};
  for (double frequency = 7.8; frequency < 8.3; frequency += 0.02) {
    MaxDelayOptions options{
        frequency, tuned_proportional_gain(stay.absorber_stiffness, stay.absorber_mass, frequency)};
    const MaxDelay attenuates = max_sampling_period(stay, options);
    options.criterion = DelayCriterion::stable;
    const MaxDelay stable = max_sampling_period(stay, options);
    EXPECT_LE(attenuates.sampling_period, stable.sampling_period * (1 + 1e-11)) << frequency;
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
  EXPECT_TRUE(is_feasible(plant, options, 0.049));
  EXPECT_FALSE(is_feasible(plant, options, 0.051));
}

TEST(MaxDelay, TheGainThatItNamesServes) {
  const auto plant = kollar2022_plant();
  const auto options = tuned_to(10.0, DelayCriterion::attenuates);
  for (const double period : {0.001, 0.01, 0.02}) {
    const auto gain =
        detail::serving_gain(options, period, detail::delay_offer(plant, options, period));
    ASSERT_FALSE(std::isnan(gain));
    const auto loop = sampled_loop(plant, Sampling<double>{period});
    const double omega = 2.0 * pi<double> * 10.0;
    const SteadyResponse<double> response(loop, held_harmonic(loop), omega);
    EXPECT_LT(response.ratio_to_uncontrolled({options.proportional_gain, gain}), 1.0);
    // The best gain may be the end of a stable interval, the limit of stable gains.
    EXPECT_LE((spectral_radius<double, 5>(loop.engaged_map({options.proportional_gain, gain}))),
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

TEST(MaxDelay, IsWatchedAtEachStepAndEndsWhereTheWatchThrows) {
  auto options = tuned_to(10.0, DelayCriterion::stable);
  int looks = 0;
  options.watch = [&looks] { ++looks; };
  const auto answer = max_sampling_period(kollar2022_plant(), options);
  ASSERT_EQ(answer.outcome, MaxDelayOutcome::found);
  ASSERT_GT(looks, 2);
  options.watch = [left = looks / 2]() mutable {
    if (--left < 0) throw std::runtime_error("told to end");
  };
  EXPECT_THROW(max_sampling_period(kollar2022_plant(), options), std::runtime_error);
}

/// A plant a hundred times slower than the paper's: its first period without a gain lies beyond 1
/// s.
TEST(MaxDelay, IsLookedForInThePlantsOwnTime) {
  auto slow = kollar2022_plant();
  slow.conductor_stiffness *= 1e-4;
  slow.absorber_stiffness *= 1e-4;
  slow.conductor_damping *= 1e-2;
  slow.absorber_damping *= 1e-2;
  auto options = tuned_to(10.0, DelayCriterion::stable);
  const MaxDelay usual = max_sampling_period(kollar2022_plant(), options);
  options.frequency *= 1e-2;
  options.proportional_gain *= 1e-4;
  options.shortest_period *= 1e2;
  const MaxDelay answer = max_sampling_period(slow, options);
  ASSERT_EQ(answer.outcome, MaxDelayOutcome::found);
  EXPECT_GT(answer.sampling_period, 1.0);
  EXPECT_NEAR(answer.sampling_period, 100.0 * usual.sampling_period, 1e-6 * answer.sampling_period);
}

TEST(MaxDelay, WithoutDampingNothingIsSaidBeyondTheSearch) {
  auto plant = kollar2022_plant();
  plant.conductor_damping = plant.absorber_damping = 1e-6;
  auto options = tuned_to(10.0, DelayCriterion::stable);
  options.proportional_gain = 0.0;
  options.longest_period = 0.2;
  const MaxDelay answer = max_sampling_period(plant, options);
  EXPECT_EQ(answer.outcome, MaxDelayOutcome::beyond_search);
  EXPECT_EQ(answer.sampling_period, 0.2);
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

/// A search of bounded work ends with how far it came, all of which serves.
TEST(MaxDelay, SaysHowFarItCameWhereItGivesUp) {
  TwoMass<double> stiff = kollar2022_plant();
  stiff.absorber_mass = 1e-6;
  const double p = tuned_proportional_gain(74.4, 1e-6, 10.0);
  const MaxDelayOptions bounded{10.0, p};
  MaxDelayOptions brief = bounded;
  brief.most_steps = 200;
  const MaxDelay far = max_sampling_period(stiff, bounded);
  const MaxDelay near = max_sampling_period(stiff, brief);
  EXPECT_EQ(near.outcome, MaxDelayOutcome::beyond_search);
  EXPECT_LE(near.sampling_period, far.sampling_period);
  for (const MaxDelay& answer : {near, far}) {
    EXPECT_TRUE(is_feasible(stiff, bounded, answer.sampling_period));
    EXPECT_EQ(answer.limit, MaxDelayLimit::none);
  }
  brief.most_steps = 0;
  EXPECT_THROW(max_sampling_period(stiff, brief), InvalidParameter);
}

/// At the longest period the best D leaves just what the true force gives without control, whose
/// amplitude is that of the continuous plant; just before it less.
TEST(MaxDelay, AttenuatesBelowWhatTheTrueForceGives) {
  const TwoMass<double> plant = kollar2022_plant();
  for (const double frequency : {6.0, 10.0, 20.0}) {
    for (const double fraction : {0.0, 0.5}) {
      MaxDelayOptions options = tuned_to(frequency, DelayCriterion::attenuates);
      options.delay_fraction = fraction;
      options.relative_to_true_force = true;
      const MaxDelay answer = max_sampling_period(plant, options);
      ASSERT_EQ(answer.outcome, MaxDelayOutcome::found) << frequency;
      const double omega = 2.0 * pi<double> * frequency;
      const std::complex<double> s(0.0, omega);
      const Eigen::Matrix4cd still = s * Eigen::Matrix4cd::Identity() - plant.state_matrix();
      const Eigen::Vector4cd force = plant.excitation_input().cast<std::complex<double>>();
      const double free = std::abs(still.partialPivLu().solve(force)[0]);
      const auto ratio = [&](double period, double d) {
        return steady_response(plant, options.sampling(period), options.hold, omega)
                   .amplitude_per_force({options.proportional_gain, d}) /
               free;
      };
      EXPECT_LT(ratio(answer.sampling_period, answer.differential_gain), 1.0 + 1e-9);
      if (answer.limit != MaxDelayLimit::attenuation) continue;
      EXPECT_NEAR(ratio(answer.sampling_period, answer.differential_gain), 1.0, 1e-6) << frequency;
      EXPECT_FALSE(is_feasible(plant, options, 1.001 * answer.sampling_period));
    }
  }
}

/// The question of a delay, to one per cent.
MaxDelayOptions roughly_tuned_to(double frequency, DelayCriterion criterion, double fraction) {
  MaxDelayOptions options = tuned_to(frequency, criterion);
  options.delay_fraction = fraction;
  options.search_ratio = 1.01;
  return options;
}

/// Whether one of many D serves, by the eigenvalues of the map.
template <class Plant>
bool feasible_in_a_scan(const Plant& plant, const MaxDelayOptions& options, double period) {
  const Sampling<double> sampling = options.sampling(period);
  const LoopMap<double> map = loop_map(plant, sampling);
  const auto response = steady_response(plant, sampling, options.hold, options.angular_frequency());
  for (double d = -20.0; d < 20.0; d += 0.002) {
    const PdGains<double> gains{options.proportional_gain, d};
    if (spectral_radius(map.closed_map(gains)) < 1.0 &&
        (options.criterion == DelayCriterion::stable ||
         response.ratio_to_uncontrolled(gains) < 1.0))
      return true;
  }
  return false;
}

TEST(AnyOrderDelay, OfSevenStatesJustBelowIsFeasibleAndJustAboveIsNot) {
  const auto plant = test::lagging_plant(100.0, 150.0);
  for (const auto criterion : {DelayCriterion::stable, DelayCriterion::attenuates}) {
    const auto options = roughly_tuned_to(10.0, criterion, 0.3);
    const MaxDelay answer = max_sampling_period(plant, options);
    ASSERT_EQ(answer.outcome, MaxDelayOutcome::found);
    const auto is_feasible = [&](double share) {
      return !feasible_differential_gains(plant, options, share * answer.sampling_period).empty();
    };
    EXPECT_FALSE(is_feasible(1.0 + 1e-6));
    for (int k = 1; k <= 60; ++k) EXPECT_TRUE(is_feasible(k / 60.0));
    EXPECT_TRUE(feasible_in_a_scan(plant, options, 0.98 * answer.sampling_period));
    EXPECT_FALSE(feasible_in_a_scan(plant, options, 1.002 * answer.sampling_period));
  }
}

}  // namespace
}  // namespace holdfast
