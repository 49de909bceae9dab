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

TEST(Figure4, AtTenMillisecondsTheLowestStableGainIsThePapers) {
  const auto intervals = stable_gains(0.01, 0.0);
  ASSERT_FALSE(intervals.empty());
  EXPECT_NEAR(intervals.front().lower, -15.5, 0.05);
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

TEST(Figure4, TheMatricesAsPrintedWouldHaveAnotherEdge) {
  // Eq. (14) as printed applies a force one whole period late (δ = τ).
  const auto printed = stable_gains(0.01, 1.0);
  ASSERT_FALSE(printed.empty());
  EXPECT_NEAR(printed.front().lower, -7.16, 0.005);
}

TEST(Figure4, HalfAPeriodOfDelayWidensTheDomain) {
  const auto half = stable_gains(0.01, 0.5);
  ASSERT_FALSE(half.empty());
  EXPECT_NEAR(half.front().lower, -22.39, 0.005);
}

TEST(Figure4, AtElevenMillisecondsTheControlOfFigure9IsStableUnlessDelayedByAPeriod) {
  const PdGains<double> gains{-557.0, -13.0};
  EXPECT_LT(spectral_radius(loop_with(0.011, 0.0).engaged_map(gains)), 1.0);
  EXPECT_NEAR(spectral_radius(loop_with(0.011, 1.0).engaged_map(gains)), 1.25, 0.005);
}

TEST(Figure4, SamplingEverFasterApproachesTheContinuousEdge) {
  EXPECT_NEAR(stable_gains(1e-6, 0.0).front().lower, -33.7, 0.05);
}

}  // namespace
}  // namespace holdfast
