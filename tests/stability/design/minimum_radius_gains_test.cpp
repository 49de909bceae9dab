#include "holdfast/stability/design/minimum_radius_gains.hpp"

#include "support/testing.hpp"

namespace holdfast {
namespace {

struct PairCase {
  TwoMass<double> plant;
  Sampling<double> sampling;
};

const std::vector<PairCase>& pair_cases() {
  static const std::vector<PairCase> cases = {{kollar2022_plant(), {0.001, 0.0}},
                                              {kollar2022_plant(), {0.010, 0.0}},
                                              {kollar2022_plant(), {0.010, 0.006}},
                                              {kollar2022_plant(), {0.030, 0.030}},
                                              {{0.1, 80.0, 0.2, 0.09, 40.0, 1.5}, {0.004, 0.001}},
                                              {{1.0, 900.0, 0.0, 0.3, 200.0, 0.0}, {0.010, 0.0}}};
  return cases;
}

double radius_at(const PairCase& c, const PdGains<double>& gains) {
  return spectral_radius<double, 5>(sampled_loop(c.plant, c.sampling).engaged_map(gains));
}

TEST(MinimumRadiusGains, HaveTheRadiusThatTheyName) {
  for (const PairCase& c : pair_cases()) {
    const auto best = minimum_radius_gains(sampled_loop(c.plant, c.sampling));
    EXPECT_EQ(best.outcome, MinimumRadiusGainsOutcome::found);
    EXPECT_LE(best.lower_bound, best.radius);
    EXPECT_NEAR(best.radius, 1.0 - best.margin, 1e-15);
    // Gains in double hold the radius to about the square root of their precision.
    EXPECT_NEAR(radius_at(c, best.gains), best.radius, 1e-6);
  }
}

/// Nothing better by eigenvalues: on a coarse grid over the plane, a fine one about the answer, and
/// downhill from there by random steps.
TEST(MinimumRadiusGains, NoOtherGainsAreBetter) {
  std::mt19937 generator(2022);
  for (const PairCase& c : pair_cases()) {
    const auto best = minimum_radius_gains(sampled_loop(c.plant, c.sampling));
    const PdGains<double> at = best.gains;
    const double width = std::max(100.0, std::abs(at.proportional));
    const double height = std::max(5.0, std::abs(at.differential));
    for (const double share : {10.0, 1.0, 0.1, 1e-3}) {
      double least = 2.0;
      std::uniform_real_distribution<double> step(-share, share);
      for (int k = 0; k < 4000; ++k) {
        least = std::min(least, radius_at(c, {at.proportional + width * step(generator),
                                              at.differential + height * step(generator)}));
      }
      EXPECT_GE(least, best.lower_bound - 1e-7) << share;
    }
  }
}

TEST(MinimumRadiusGains, AreNoWorseThanTheBestDifferentialGainAtAnyProportionalGain) {
  for (const PairCase& c : pair_cases()) {
    const auto loop = sampled_loop(c.plant, c.sampling);
    const auto best = minimum_radius_gains(loop);
    double least = 2.0;
    for (double p = -800.0; p <= 800.0; p += 8.0)
      least = std::min(least, minimum_radius(loop, p).radius);
    EXPECT_GE(least, best.radius - 1e-9);
    EXPECT_NEAR(minimum_radius(loop, best.gains.proportional).radius, best.radius, 1e-6);
  }
}

TEST(MinimumRadiusGains, AreIdleWhereTheyMoveNothing) {
  auto loop = sampled_loop(kollar2022_plant(), Sampling<double>{0.01});
  loop.present_force.setZero();
  loop.previous_force.setZero();
  const auto answer = minimum_radius_gains(loop);
  EXPECT_EQ(answer.outcome, MinimumRadiusGainsOutcome::idle);
  EXPECT_EQ(answer.gains.proportional, 0.0);
}

}  // namespace
}  // namespace holdfast
