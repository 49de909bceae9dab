// Kollár 2022, Fig. 3: stability of the continuous loop without delay.

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/boundary/boundary.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/design/max_delay.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"

#include "support/dense_routes.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(Figure3, TheEdgeAtTheTunedGainIsWhereThePaperReadsIt) {
  const auto polynomial = characteristic_polynomial(kollar2022_plant());
  const auto intervals = stable_differential_gains(polynomial, -557.0);
  ASSERT_FALSE(intervals.empty());
  EXPECT_NEAR(intervals.front().lower, -33.7, 0.05);
}

TEST(Figure3, TheEdgeIsAPairOnTheImaginaryAxis) {
  const auto polynomial = characteristic_polynomial(kollar2022_plant());
  const auto points = stability_boundary(polynomial, {-558.0, -556.0});
  bool found = false;
  for (const auto& point : points) {
    found = found || (point.curve == BoundaryCurve::imaginary_pair &&
                      std::abs(point.gains.differential + 33.7) < 0.1);
  }
  EXPECT_TRUE(found);
}

// Kollár 2022, Fig. 4 and §4.1: stability of the sampled loop.

SampledLoop<double> loop_with(double period, double delay_fraction) {
  return sampled_loop(kollar2022_plant(), Sampling<double>{period, delay_fraction * period});
}

std::vector<Interval<double>> stable_gains(double period, double delay_fraction) {
  return stable_differential_gains(characteristic_polynomial(loop_with(period, delay_fraction)),
                                   -557.0);
}

struct LowestGain {
  double period, delay_fraction, gain, tolerance;
};

TEST(Figure4, LowestStableGainsAreTheStatedOnes) {
  const LowestGain rows[] = {
      {0.01, 0.0, -15.5, 0.05},    // the paper's
      {0.01, 1.0, -7.16, 0.005},   // by Eq. (14) as printed: a force one whole period late
      {0.01, 0.5, -22.39, 0.005},  // half a period of delay widens the domain
      {1e-6, 0.0, -33.7, 0.05}};   // ever faster, that of the continuous loop
  for (const LowestGain& row : rows) {
    const auto intervals = stable_gains(row.period, row.delay_fraction);
    ASSERT_FALSE(intervals.empty()) << row.gain;
    EXPECT_NEAR(intervals.front().lower, row.gain, row.tolerance);
  }
}

TEST(Figure4, ThatEdgeIsAForceThatAlternatesFromSampleToSample) {
  // The paper's b₀ = 0 is a root λ = −1.
  const auto loop = loop_with(0.01, 0.0);
  const double edge = stable_gains(0.01, 0.0).front().lower;
  const Eigen::VectorXcd roots = test::eigenvalues_of(loop.engaged_map({-557.0, edge}));
  EXPECT_LE((roots.array() + 1.0).abs().minCoeff(), 1e-9);
  EXPECT_LE(std::abs(roots.cwiseAbs().maxCoeff() - 1.0), 1e-9);
}

TEST(Figure4, AtFiftyMillisecondsNothingIsStable) {
  EXPECT_TRUE(stable_gains(0.05, 0.0).empty());
  EXPECT_TRUE(stable_gains(0.05, 1.0).empty());
}

TEST(Figure4, AtElevenMillisecondsTheControlOfFigure9IsStableUnlessDelayedByAPeriod) {
  const PdGains<double> gains{-557.0, -13.0};
  EXPECT_LT(spectral_radius(loop_with(0.011, 0.0).engaged_map(gains)), 1.0);
  EXPECT_NEAR(spectral_radius(loop_with(0.011, 1.0).engaged_map(gains)), 1.25, 0.005);
}

// Kollár 2022, Fig. 5: the largest sampling period that still attenuates.

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
