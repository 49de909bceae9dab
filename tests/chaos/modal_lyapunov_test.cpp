// Exponents and classification of a conductor by its modes.

#include "holdfast/chaos/modal_lyapunov.hpp"

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/chaos/lyapunov_spectrum.hpp"
#include "holdfast/chaos/modal_classification.hpp"
#include "support/string_case.hpp"

namespace holdfast::test {
namespace {

ModalLoop loop_of(int modes, double late = 0.001) {
  return {papers_modes(modes), papers_absorber(modes == 1 ? 0.0 : 0.01),
          {0.005, late},       {-557.0, -4.0},
          {0.6, 10.0},         5e-4,
          ForceHold::sampled};
}

IdealLoop<double> two_masses_of(const ModalLoop& loop) {
  return {test::two_masses_of(loop.modes.front(), loop.absorber),
          loop.sampling,
          loop.gains,
          loop.excitation,
          loop.backlash_width,
          loop.hold};
}

ModalMotion::Full at_rest(const ModalLoop& loop) {
  return ModalMotion::Full::Zero(2 * static_cast<Eigen::Index>(loop.modes.size()) + 2);
}

TEST(ModalSpectrum, IsThatOfTheWholeMaps) {
  const ModalLoop loop = loop_of(3);
  const NaturalMotions motions(loop, plant_poles(loop.modes, loop.absorber));
  ModalDeviations deviations(motions, loop.gains);
  const Eigen::Index order = deviations.order();
  std::array<Eigen::MatrixXd, 2> maps;
  for (const bool engaged : {false, true}) {
    deviations.begin(Eigen::MatrixXd::Identity(order, order));
    deviations.advance(engaged);
    maps[engaged ? 1 : 0] = deviations.columns();
  }
  ModalSpectrum leading(motions, loop.gains, true);
  LyapunovSpectrum<double, Eigen::Dynamic> whole(
      detail::oblique_basis<double, Eigen::Dynamic>(order));
  Random random(4221);
  for (int j = 0; j < 20000; ++j) {
    const bool engaged = random.index(3) > 0;
    leading.push(engaged);
    whole.push(maps[engaged ? 1 : 0]);
    if (j != 2000) continue;
    leading.restart();
    whole.restart();
  }
  EXPECT_EQ(leading.spectrum().steps(), whole.steps());
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(leading.spectrum().exponents()[i], whole.exponents()[i], 1e-9) << i;
    EXPECT_NEAR(leading.spectrum().standard_errors()[i], whole.standard_errors()[i], 1e-9) << i;
  }
}

TEST(ModalLyapunov, OfAnOrbitIsItsLargestMultiplier) {
  const ModalLoop loop = loop_of(6);
  const OrbitResult found = find_periodic_orbit(loop, at_rest(loop));
  ASSERT_EQ(found.outcome, OrbitOutcome::certified);
  ModalMotion motion = *modal_motion(loop, at_rest(loop));
  const LyapunovResult result = run_lyapunov(motion, loop, {200000, 20000});
  const double expected = found.orbit->multipliers.front().log_modulus /
                          static_cast<double>(found.orbit->period_samples());
  EXPECT_NEAR(result.exponents[0], expected, 2e-2 * std::abs(expected));
}

TEST(ModalLyapunov, OfASingleModeHasNoMoreExponentsThanItsMap) {
  const ModalLoop loop = loop_of(1, 0.0);
  ModalMotion motion = *modal_motion(loop, at_rest(loop));
  const LyapunovResult result = run_lyapunov(motion, loop, {2000, 100});
  EXPECT_TRUE(std::isfinite(result.exponents[3]));
  EXPECT_EQ(result.exponents[4], -std::numeric_limits<double>::infinity());
}

/// However late the force acts, the gap loses one direction; without play all five are finite.
TEST(ModalLyapunov, ABacklashLosesADirectionAtOnce) {
  for (const double late : {0.0025, 0.005}) {
    ModalLoop loop = loop_of(1, late);
    for (const double width : {5e-4, 0.0}) {
      loop.backlash_width = width;
      ModalMotion motion = *modal_motion(loop, at_rest(loop));
      const LyapunovResult result = run_lyapunov(motion, loop, {60, 0});
      EXPECT_EQ(std::isfinite(result.exponents[4]), width == 0.0) << late;
      EXPECT_GT(result.exponents[3], -1.0);
    }
  }
}

TEST(ModalLyapunov, StopsWhereTheMotionDiverges) {
  ModalLoop loop = loop_of(2);
  loop.gains = {-557.0, 400.0};
  loop.backlash_width = 0.0;
  ModalMotion motion = *modal_motion(loop, at_rest(loop));
  EXPECT_TRUE(run_lyapunov(motion, loop, {1000000, 0}).diverged);
}

/// Periodic, chaotic and diverging motions of one mode are those of its two masses.
TEST(ModalClassification, OfOneModeIsThatOfItsTwoMasses) {
  Random random(4222);
  int periodic = 0, others = 0;
  for (int trial = 0; trial < 24; ++trial) {
    ModalLoop loop = loop_of(1, trial % 2 == 0 ? 0.0 : 0.001);
    loop.gains = {random.uniform(-1500.0, 900.0), random.uniform(-50.0, 30.0)};
    loop.backlash_width = random.uniform(1e-4, 2e-3);
    const OrbitLimits limits{2000, 40000, {}};
    const SampledClassification found = classify_motion(loop, at_rest(loop), limits);
    const SampledClassification expected =
        classify_motion(two_masses_of(loop), Vector<double, 4>(Vector<double, 4>::Zero()), limits);
    EXPECT_EQ(found.classification.kind, expected.classification.kind)
        << loop.gains.proportional << ' ' << loop.gains.differential;
    EXPECT_EQ(found.classification.period, expected.classification.period);
    const bool is_periodic = expected.classification.kind == AttractorType::periodic;
    ++(is_periodic ? periodic : others);
    ASSERT_EQ(found.indicators.largest_exponent.has_value(),
              expected.indicators.largest_exponent.has_value());
    if (!expected.indicators.largest_exponent) continue;
    const auto &here = *found.indicators.largest_exponent,
               &there = *expected.indicators.largest_exponent;
    const bool certified = expected.indicators.certified_period.has_value();
    EXPECT_NEAR(here.value, there.value, certified ? 1e-8 : here.half_width + there.half_width);
  }
  EXPECT_GT(periodic, 3);
  EXPECT_GT(others, 3);
}

}  // namespace
}  // namespace holdfast::test
