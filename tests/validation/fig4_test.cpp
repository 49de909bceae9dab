// Kollár 2022, Fig. 4 and §4.1: stability of the sampled loop.

#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "support/dense_routes.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

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

}  // namespace
}  // namespace holdfast
