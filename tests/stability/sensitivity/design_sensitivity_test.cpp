#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/sensitivity/max_delay_sensitivity.hpp"
#include "stability/loop_setting.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

MinimumRadius minimum_radius_of(const LoopSetting& setting) {
  return minimum_radius(sampled_loop(setting.plant, setting.sampling), setting.gains.proportional,
                        setting.gains.differential);
}

struct RadiusCase {
  Sampling<double> sampling;
  double absorber_damping, proportional_gain;
  MinimumRadiusKind kind;
};

/// The D of minimum radius is known to about half of the digits where two roots meet.
TEST(MinimumRadiusSensitivity, IsTheSlopeOfTheLeastRadius) {
  for (const RadiusCase& c : {RadiusCase{{0.010, 0.0}, 4.0, -557.0, MinimumRadiusKind::balanced},
                              {{0.001, 0.0}, 4.0, -557.0, MinimumRadiusKind::balanced},
                              {{0.010, 0.005}, 4.0, -300.0, MinimumRadiusKind::balanced},
                              {{0.0072, 0.0015}, 7.4, 26.0, MinimumRadiusKind::smooth},
                              {{0.0094, 0.0057}, 0.96, -492.0, MinimumRadiusKind::smooth},
                              {{0.0411, 0.0129}, 2.6, -558.0, MinimumRadiusKind::double_root},
                              {{0.0442, 0.0039}, 1.3, -672.0, MinimumRadiusKind::double_root}}) {
    LoopSetting setting{kollar2022_plant(), c.sampling, {c.proportional_gain, 0.0}};
    setting.plant.absorber_damping = c.absorber_damping;
    const MinimumRadius least = minimum_radius_of(setting);
    setting.gains.differential = least.differential_gain;
    const auto s = minimum_radius_sensitivity(setting.plant, setting.sampling, setting.gains);
    EXPECT_EQ(s.kind, c.kind);
    expect_sensitivity(
        s.radius, [](const LoopSetting& at) { return -minimum_radius_of(at).margin; }, setting,
        std::abs(least.margin), 1e-5);
    expect_sensitivity(
        s.differential_gain,
        [](const LoopSetting& at) { return minimum_radius_of(at).differential_gain; }, setting,
        std::abs(least.differential_gain), 1e-3);
  }
}

TEST(MinimumRadiusSensitivity, OfOtherGainsIsThatOfTheRadiusAlone) {
  for (const double p : {-557.0, -100.0, 0.0}) {
    for (const double d : {-13.0, 0.0, 1e-9, 1.0}) {
      const PdGains<double> gains{p, d};
      const auto s = minimum_radius_sensitivity(kollar2022_plant(), {0.010, 0.0}, gains);
      EXPECT_EQ(s.kind, MinimumRadiusKind::fixed) << p << ' ' << d;
      EXPECT_TRUE(std::isnan(s.differential_gain[LoopParameter::conductor_mass]));
      const auto radius = radius_sensitivity(kollar2022_plant(), {0.010, 0.0}, gains);
      EXPECT_NEAR(s.radius[LoopParameter::conductor_mass], radius[LoopParameter::conductor_mass],
                  1e-10);
    }
  }
}

struct AmplitudeCase {
  Sampling<double> sampling;
  ForceHold hold;
  double largest_radius, frequency, proportional_gain;
  MinimumAmplitudeOutcome outcome;
};

TEST(AmplitudeSensitivity, IsTheSlopeOfTheLeastAmplitude) {
  const std::vector<AmplitudeCase> cases = {
      {{0.001, 0.0}, ForceHold::sampled, 1.0, 10.0, -557.0, MinimumAmplitudeOutcome::edge},
      {{0.010, 0.004}, ForceHold::sampled, 0.995, 10.0, -557.0, MinimumAmplitudeOutcome::edge},
      {{0.010, 0.0}, ForceHold::exact, 0.999, 10.0, -557.0, MinimumAmplitudeOutcome::edge},
      {{0.01656, 0.00513},
       ForceHold::exact,
       1.0,
       29.68,
       -181.8,
       MinimumAmplitudeOutcome::stationary},
      {{0.02705, 0.01738},
       ForceHold::sampled,
       1.0,
       16.45,
       -256.4,
       MinimumAmplitudeOutcome::stationary}};
  for (const bool of_true_force : {false, true})
    for (const AmplitudeCase& c : cases) {
      const auto least = [&](const LoopSetting& at) {
        return minimum_amplitude(at.plant,
                                 {at.sampling, c.hold, c.largest_radius, 0.0, of_true_force},
                                 c.frequency, at.gains.proportional);
      };
      LoopSetting setting{kollar2022_plant(), c.sampling, {c.proportional_gain, 0.0}};
      const MinimumAmplitude answer = least(setting);
      setting.gains.differential = answer.differential_gain;
      const auto s = amplitude_sensitivity(
          setting.plant, {c.sampling, c.hold, c.largest_radius, 0.0, of_true_force}, c.frequency,
          c.proportional_gain);
      EXPECT_EQ(s.outcome, c.outcome);
      expect_sensitivity(
          s.ratio, [&](const LoopSetting& at) { return least(at).ratio_to_uncontrolled; }, setting,
          answer.ratio_to_uncontrolled, 1e-5);
      expect_sensitivity(
          s.differential_gain, [&](const LoopSetting& at) { return least(at).differential_gain; },
          setting, std::abs(answer.differential_gain), 1e-5);
    }
}

TEST(AmplitudeSensitivity, ThereIsNoneWhereNoGainIsAdmitted) {
  const auto plant = kollar2022_plant();
  const AmplitudeOptions fast{{0.001, 0.0}, ForceHold::sampled, 1.0};
  const auto unstable = amplitude_sensitivity(plant, fast, 10.0, 1e5);
  EXPECT_EQ(unstable.outcome, MinimumAmplitudeOutcome::none);
  EXPECT_TRUE(std::isnan(unstable.ratio[LoopParameter::conductor_mass]));
  EXPECT_TRUE(std::isnan(unstable.differential_gain[LoopParameter::sampling_period]));
  const auto aliased =
      amplitude_sensitivity(plant, {{0.06, 0.0}, ForceHold::sampled, 1.0}, 10.0, -557.0);
  EXPECT_EQ(aliased.outcome, MinimumAmplitudeOutcome::aliased);
  EXPECT_TRUE(std::isnan(aliased.ratio[LoopParameter::absorber_stiffness]));
}

TEST(MaxDelaySensitivity, IsTheSlopeOfTheLargestPeriod) {
  for (const bool of_true_force : {false, true}) {
    for (const double fraction : {0.0, 0.4}) {
      const auto criterion =
          of_true_force || fraction > 0.0 ? DelayCriterion::attenuates : DelayCriterion::stable;
      const auto options_of = [&](const LoopSetting& at) {
        MaxDelayOptions options;
        options.frequency = 10.0;
        options.proportional_gain = at.gains.proportional;
        options.criterion = criterion;
        options.delay_fraction = fraction;
        options.relative_to_true_force = of_true_force;
        return options;
      };
      const auto answer_of = [&](const LoopSetting& at) {
        return max_sampling_period(at.plant, options_of(at));
      };
      LoopSetting setting{kollar2022_plant(), {0.001, 0.0}, {-557.0, -13.0}};
      const MaxDelay answer = answer_of(setting);
      ASSERT_EQ(answer.outcome, MaxDelayOutcome::found);
      const auto s = max_delay_sensitivity(setting.plant, options_of(setting), answer);
      const double scale = answer.sampling_period;
      expect_sensitivity(
          s.sampling_period, [&](const LoopSetting& at) { return answer_of(at).sampling_period; },
          setting, scale, 1e-5);
      auto more = options_of(setting), less = more;
      more.delay_fraction += 1e-5;
      less.delay_fraction = std::max(0.0, less.delay_fraction - 1e-5);
      const double slope = (max_sampling_period(setting.plant, more).sampling_period -
                            max_sampling_period(setting.plant, less).sampling_period) /
                           (more.delay_fraction - less.delay_fraction);
      EXPECT_NEAR(s.by_delay_fraction, slope, 1e-3 * std::abs(slope));
    }
  }
}

TEST(MaxDelaySensitivity, IsZeroWhereTheSamplesSetTheLimit) {
  MaxDelayOptions options;
  options.frequency = 10.0;
  options.proportional_gain = -557.0;
  const MaxDelay answer{MaxDelayOutcome::found, 0.05, -13.0, MaxDelayLimit::nyquist};
  const auto s = max_delay_sensitivity(kollar2022_plant(), options, answer);
  EXPECT_EQ(s.sampling_period.entries.norm(), 0.0);
  EXPECT_EQ(s.by_delay_fraction, 0.0);
}

}  // namespace
}  // namespace holdfast
