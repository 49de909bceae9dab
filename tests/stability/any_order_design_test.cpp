// Largest sampling periods, least amplitudes and least radii of loops of any order: against the
// closed forms of the two masses, and against scans of the loop's map.

#include "holdfast/control/loop_map.hpp"
#include "holdfast/stability/design/max_delay.hpp"
#include "holdfast/stability/design/minimum_amplitude.hpp"
#include "support/lagging_plant.hpp"
#include "support/testing.hpp"

namespace holdfast::test {
namespace {

MaxDelayOptions tuned_to(double frequency, DelayCriterion criterion, double fraction = 0.0) {
  MaxDelayOptions options;
  options.frequency = frequency;
  options.proportional_gain = tuned_proportional_gain(74.4, 0.16, frequency);
  options.criterion = criterion;
  options.delay_fraction = fraction;
  options.search_ratio = 1.01;
  return options;
}

TEST(AnyOrderDelay, OfTwoMassesIsThatOfTheClosedForms) {
  const TwoMass<double> plant = kollar2022_plant();
  for (const auto criterion : {DelayCriterion::stable, DelayCriterion::attenuates}) {
    for (const double frequency : {8.0, 20.0}) {
      const auto options = tuned_to(frequency, criterion, frequency > 10.0 ? 0.5 : 0.0);
      const MaxDelay closed = max_sampling_period(plant, options);
      const MaxDelay general = max_sampling_period(through_ports(plant), options);
      EXPECT_EQ(general.outcome, closed.outcome);
      EXPECT_EQ(general.limit, closed.limit);
      EXPECT_NEAR(general.sampling_period, closed.sampling_period, 1e-7 * closed.sampling_period);
    }
  }
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
  const auto plant = lagging_plant(100.0, 150.0);
  for (const auto criterion : {DelayCriterion::stable, DelayCriterion::attenuates}) {
    const auto options = tuned_to(10.0, criterion, 0.3);
    const MaxDelay answer = max_sampling_period(plant, options);
    ASSERT_EQ(answer.outcome, MaxDelayOutcome::found);
    EXPECT_TRUE(feasible_differential_gain(plant, options, answer.sampling_period));
    EXPECT_FALSE(feasible_differential_gain(plant, options, answer.sampling_period * (1.0 + 1e-6)));
    for (int k = 1; k < 60; ++k)
      EXPECT_TRUE(feasible_differential_gain(plant, options, answer.sampling_period * k / 60.0));
    EXPECT_TRUE(feasible_in_a_scan(plant, options, 0.98 * answer.sampling_period));
    EXPECT_FALSE(feasible_in_a_scan(plant, options, 1.002 * answer.sampling_period));
  }
}

TEST(AnyOrderAmplitude, OfTwoMassesIsThatOfTheClosedForms) {
  const TwoMass<double> plant = kollar2022_plant();
  for (const double largest_radius : {1.0, 0.995}) {
    const AmplitudeOptions options{{0.002, 0.001}, ForceHold::exact, largest_radius};
    for (const double frequency : {8.0, 10.0}) {
      const double p = tuned_proportional_gain(74.4, 0.16, frequency);
      const MinimumAmplitude closed = minimum_amplitude(plant, options, frequency, p);
      const MinimumAmplitude general =
          minimum_amplitude(through_ports(plant), options, frequency, p);
      EXPECT_EQ(general.outcome, closed.outcome);
      if (closed.outcome == MinimumAmplitudeOutcome::none) continue;
      EXPECT_NEAR(general.differential_gain, closed.differential_gain,
                  1e-7 * std::abs(closed.differential_gain));
      EXPECT_NEAR(general.ratio_to_uncontrolled, closed.ratio_to_uncontrolled,
                  1e-7 * closed.ratio_to_uncontrolled);
    }
  }
}

TEST(AnyOrderAmplitude, OfSevenStatesIsTheLeastOfAScan) {
  const auto plant = lagging_plant(100.0, 150.0);
  const AmplitudeOptions options{{0.002, 0.001}, ForceHold::sampled, 1.0};
  const MinimumAmplitude least = minimum_amplitude(plant, options, 9.0, -50.0);
  ASSERT_NE(least.outcome, MinimumAmplitudeOutcome::none);
  const LoopMap<double> map = loop_map(plant, options.sampling);
  const auto response =
      steady_response(plant, options.sampling, options.hold, 2.0 * pi<double> * 9.0);
  double scanned = 1e300;
  for (double d = -8.0; d < 8.0; d += 0.01) {
    if (spectral_radius(map.closed_map({-50.0, d})) >= 1.0) continue;
    scanned = std::min(scanned, response.ratio_to_uncontrolled({-50.0, d}));
  }
  EXPECT_LE(least.ratio_to_uncontrolled, scanned * (1.0 + 1e-12));
  EXPECT_GT(least.ratio_to_uncontrolled, 0.98 * scanned);
}

TEST(AnyOrderRadius, OfTwoMassesIsThatOfTheClosedForms) {
  const TwoMass<double> plant = kollar2022_plant();
  for (const Sampling<double>& sampling :
       {Sampling<double>{0.001, 0.0}, {0.005, 0.002}, {0.02, 0.02}}) {
    for (const double p : {-300.0, -20.0}) {
      const MinimumRadius closed = minimum_radius(sampled_loop(plant, sampling), p);
      const MinimumRadius general = minimum_radius(loop_map(plant, sampling), p);
      EXPECT_NEAR(general.radius, closed.radius, 1e-8);
      EXPECT_LE(general.lower_bound, general.radius);
    }
  }
}

TEST(AnyOrderRadius, OfSevenStatesIsTheLeastOfAScan) {
  const auto plant = lagging_plant(100.0, 150.0);
  for (const double delay : {0.001, 0.005}) {
    const LoopMap<double> map = loop_map(plant, {0.002, delay});
    const MinimumRadius least = minimum_radius(map, -50.0);
    double scanned = 1e300;
    for (double d = -10.0; d < 10.0; d += 0.005)
      scanned = std::min(scanned, spectral_radius(map.closed_map({-50.0, d})));
    EXPECT_LE(least.radius, scanned + 1e-9);
    EXPECT_GT(least.radius, scanned - 1e-4);
    EXPECT_NEAR(spectral_radius(map.closed_map({-50.0, least.differential_gain})), least.radius,
                1e-7);
  }
}

}  // namespace
}  // namespace holdfast::test
