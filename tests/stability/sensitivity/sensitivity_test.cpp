#include "holdfast/stability/sensitivity/sensitivity.hpp"

#include "holdfast/stability/design/minimum_radius.hpp"
#include "stability/loop_setting.hpp"
#include "support/dense_routes.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

/// D = −13 at 10 ms is left out: there two curves meet at the lower end of P, which has a corner.
const std::vector<LoopSetting>& sensitivity_settings() {
  static const std::vector<LoopSetting> settings = {
      {kollar2022_plant(), {0.001, 0.0}, {-557.0, -13.0}},
      {kollar2022_plant(), {0.010, 0.0}, {-557.0, -12.0}},
      {kollar2022_plant(), {0.010, 0.004}, {-557.0, -13.0}},
      {kollar2022_plant(), {0.003, 0.003}, {-557.0, -13.0}},
      {{0.1, 80.0, 0.2, 0.09, 40.0, 1.5}, {0.004, 0.001}, {-150.0, -3.0}}};
  return settings;
}

double radius_of_setting(const LoopSetting& setting) {
  return spectral_radius<double, 5>(
      sampled_loop(setting.plant, setting.sampling).engaged_map(setting.gains));
}

double lower_end_about(const std::vector<Interval<double>>& intervals, double value) {
  for (const auto& interval : intervals) {
    if (interval.contains(value)) return interval.lower;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// The lower end of the stable interval of D in which the setting lies.
double lower_edge(const LoopSetting& setting) {
  const auto loop = sampled_loop(setting.plant, setting.sampling);
  return lower_end_about(
      stable_differential_gains(characteristic_polynomial(loop), setting.gains.proportional),
      setting.gains.differential);
}

double lower_edge_of_p(const LoopSetting& setting) {
  const auto loop = sampled_loop(setting.plant, setting.sampling);
  return lower_end_about(
      stable_proportional_gains(characteristic_polynomial(loop), setting.gains.differential),
      setting.gains.proportional);
}

TEST(Sensitivity, OfTheSpectralRadiusIsItsSlope) {
  for (const LoopSetting& setting : sensitivity_settings()) {
    const double margin = 1.0 - radius_of_setting(setting);
    expect_sensitivity(radius_sensitivity(setting.plant, setting.sampling, setting.gains),
                       radius_of_setting, setting, std::abs(margin));
  }
}

/// Loops of all kinds, unstable ones and those with a real dominant root among them; where two
/// moduli come within what the difference quotient spans, ρ has a corner.
TEST(Sensitivity, OfTheSpectralRadiusOfRandomLoopsIsItsSlope) {
  std::mt19937 generator(19);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int compared = 0;
  for (int k = 0; k < 300; ++k) {
    LoopSetting setting{kollar2022_plant(),
                        {},
                        {-800.0 + 900.0 * share(generator), -40.0 + 50.0 * share(generator)}};
    setting.sampling.period = 0.001 * std::pow(500.0, share(generator));
    setting.sampling.processing_delay = k % 3 == 0 ? 0.0 : 0.3 * setting.sampling.period;
    std::vector<double> moduli;
    for (const auto& lambda : test::eigenvalues_of(
             sampled_loop(setting.plant, setting.sampling).engaged_map(setting.gains))) {
      if (lambda.imag() >= 0.0) moduli.push_back(std::abs(lambda));
    }
    std::sort(moduli.rbegin(), moduli.rend());
    if (moduli.size() > 1 && moduli[0] - moduli[1] < 0.02 * moduli[0]) continue;
    ++compared;
    expect_sensitivity(radius_sensitivity(setting.plant, setting.sampling, setting.gains),
                       radius_of_setting, setting, moduli[0], 1e-5, 1e-5);
  }
  EXPECT_GT(compared, 100);
}

/// Where hardly anything is left of the plant's motion after a sample.
TEST(Sensitivity, OfTheSpectralRadiusHoldsForSlowSampling) {
  for (const double p : {-20.0, 10.0}) {
    LoopSetting setting{kollar2022_plant(), {10.0, 3.0}, {p, 0.0}};
    setting.gains.differential =
        minimum_radius(sampled_loop(setting.plant, setting.sampling), p).differential_gain + 1.0;
    const auto radius = [](const LoopSetting& at) {
      return 1.0 + loop_polynomial(sampled_loop(at.plant, at.sampling)).excess(at.gains);
    };
    expect_sensitivity(radius_sensitivity(setting.plant, setting.sampling, setting.gains), radius,
                       setting, radius(setting), 1e-4, 1e-6);
  }
}

TEST(Sensitivity, OfTheBoundaryIsThatOfTheStableIntervals) {
  for (const LoopSetting& setting : sensitivity_settings()) {
    const double edge = lower_edge(setting);
    auto sensitivity =
        boundary_gain_sensitivity(setting.plant, setting.sampling,
                                  {setting.gains.proportional, edge}, FreeGain::differential);
    EXPECT_EQ(sensitivity[LoopParameter::differential_gain], 0.0);
    expect_sensitivity(sensitivity, lower_edge, setting, std::abs(edge));
    const double p_edge = lower_edge_of_p(setting);
    sensitivity =
        boundary_gain_sensitivity(setting.plant, setting.sampling,
                                  {p_edge, setting.gains.differential}, FreeGain::proportional);
    EXPECT_EQ(sensitivity[LoopParameter::proportional_gain], 0.0);
    expect_sensitivity(sensitivity, lower_edge_of_p, setting, std::abs(p_edge));
  }
}

/// Along the boundary dP/dD and dD/dP are reciprocal.
TEST(Sensitivity, OfEitherGainIsTheBoundarysSlope) {
  for (const LoopSetting& setting : sensitivity_settings()) {
    const PdGains<double> edge{setting.gains.proportional, lower_edge(setting)};
    const auto of_d =
        boundary_gain_sensitivity(setting.plant, setting.sampling, edge, FreeGain::differential);
    const auto of_p =
        boundary_gain_sensitivity(setting.plant, setting.sampling, edge, FreeGain::proportional);
    EXPECT_NEAR(of_d[LoopParameter::proportional_gain] * of_p[LoopParameter::differential_gain],
                1.0, 1e-9);
  }
}

/// One unit of mass: all masses, stiffnesses, dampings and gains scaled alike leave λ where it is.
TEST(Sensitivity, OfTheRadiusVanishesAlongAChangeOfUnits) {
  for (const LoopSetting& setting : sensitivity_settings()) {
    const auto s = logarithmic(radius_sensitivity(setting.plant, setting.sampling, setting.gains),
                               setting, radius_of_setting(setting))
                       .entries;
    const double by_mass = s.head<6>().sum() + s[8] + s[9];
    // And one unit of time: k, P ~ 1/T², c, D ~ 1/T, τ, δ ~ T.
    const double by_time = -2.0 * (s[1] + s[4] + s[8]) - (s[2] + s[5] + s[9]) + s[6] + s[7];
    EXPECT_NEAR(by_mass, 0.0, 1e-9 * s.cwiseAbs().maxCoeff());
    EXPECT_NEAR(by_time, 0.0, 1e-9 * s.cwiseAbs().maxCoeff());
  }
}

/// P = k₂ − m₂ ω² carried along by hand.
TEST(Sensitivity, ATunedGainMovesWithTheAbsorber) {
  LoopSetting setting = sensitivity_settings()[1];
  const double f = 10.0;
  const auto edge = [&](LoopSetting at) {
    at.gains.proportional =
        tuned_proportional_gain(at.plant.absorber_stiffness, at.plant.absorber_mass, f);
    return lower_edge(at);
  };
  setting.gains.proportional =
      tuned_proportional_gain(setting.plant.absorber_stiffness, setting.plant.absorber_mass, f);
  const auto held = boundary_gain_sensitivity(setting.plant, setting.sampling,
                                              {setting.gains.proportional, edge(setting)},
                                              FreeGain::differential);
  expect_sensitivity(with_tuned_gain(held, f), edge, setting, 15.0);
}

TEST(Sensitivity, RefusesWhatIsOutOfRange) {
  const auto plant = kollar2022_plant();
  EXPECT_THROW(radius_sensitivity(plant, {0.0}, {-557.0, -13.0}), InvalidParameter);
  EXPECT_THROW(radius_sensitivity(plant, {0.01}, {NAN, -13.0}), InvalidParameter);
  EXPECT_THROW(
      boundary_gain_sensitivity(plant, {0.01}, {-557.0, -13.0}, FreeGain::differential, 0.0),
      InvalidParameter);
}

}  // namespace
}  // namespace holdfast
