#include "holdfast/chaos/event_classification.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "holdfast/chaos/sampled_classification.hpp"
#include "holdfast/excitation/band_limited_noise.hpp"
#include "support/kollar_case.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

struct JudgedCase {
  double sampling_period, width, displacement;
};

ForcedLoop<double> judged_forced_loop(double sampling_period, double width) {
  test::KollarCase which;
  which.sampling_period = sampling_period;
  which.width = width;
  return which.forced_loop();
}

RealLoop judged_real_loop(double sampling_period, double width,
                          Switching switching = Switching::exact) {
  RealLoop loop = real_loop(judged_forced_loop(sampling_period, width));
  loop.switching = switching;
  return loop;
}

HybridVerdict judged_from_rest(const RealLoop& loop, const OrbitLimits& limits = {}) {
  return classify_motion(loop, Vector<double, 4>::Zero(), limits);
}

/// ln ρ(S), the exponent per sample of a loop without backlash.
double exponent_without_backlash(const RealLoop& loop) {
  const auto map = sampled_loop(loop.plant, loop.digital.sampling).engaged_map(loop.digital.gains);
  return std::log(Eigen::EigenSolver<Matrix<double, 5>>(map).eigenvalues().cwiseAbs().maxCoeff());
}

/// That of the plant left alone.
double exponent_of_plant(const RealLoop& loop) {
  const Eigen::EigenSolver<Matrix<double, 4>> solver(loop.plant.state_matrix());
  return solver.eigenvalues().real().maxCoeff() * loop.digital.sampling.period;
}

void expect_exponent(const HybridVerdict& found, double expected) {
  ASSERT_TRUE(found.evidence.largest_exponent.has_value());
  const ExponentEvidence& exponent = *found.evidence.largest_exponent;
  EXPECT_NEAR(exponent.value, expected, exponent.half_width);
  EXPECT_NEAR(exponent.value, expected, 0.02 * std::abs(expected));
}

/// Steps of random height, one for each sampling period.
std::shared_ptr<const RecordedForce> random_record(double duration, double sampling_period) {
  test::Random random(4071);
  const auto rows = static_cast<std::size_t>(std::round(duration / sampling_period)) + 1;
  std::vector<double> times(rows), forces(rows);
  for (std::size_t row = 0; row < rows; ++row) {
    times[row] = static_cast<double>(row) * sampling_period;
    forces[row] = random.uniform(-0.5, 0.5);
  }
  return std::make_shared<const RecordedForce>(times, forces, RecordInterpolation::held);
}

TEST(HybridVerdict, OfSampledSwitchingIsThatOfTheModelOfThePaper) {
  for (const JudgedCase& which : {JudgedCase{0.001, 0.0005, 0.0},
                                  {0.01, 0.002, 0.0},
                                  {0.003, 0.002, 0.0},
                                  {0.003, 0.002, 1e-5},
                                  {0.01, 0.0, 0.0}}) {
    const Vector<double, 4> start(which.displacement, 0.0, 0.0, 0.0);
    const auto loop = judged_forced_loop(which.sampling_period, which.width);
    const MotionVerdict paper = classify_motion(loop, start);
    const HybridVerdict found = classify_motion(real_loop(loop), start);
    EXPECT_EQ(found.verdict.kind, MotionKind::periodic);
    EXPECT_EQ(found.verdict.kind, paper.verdict.kind);
    EXPECT_EQ(found.verdict.period, paper.verdict.period);
    EXPECT_EQ(found.search.outcome, paper.search.outcome);
    ASSERT_TRUE(found.search.orbit && paper.search.orbit);
    EXPECT_NEAR(found.search.orbit->amplitude(), paper.search.orbit->amplitude(),
                1e-9 * paper.search.orbit->amplitude());
    const double exponent = paper.evidence.largest_exponent->value;
    EXPECT_NEAR(found.evidence.largest_exponent->value, exponent, 1e-6 * std::abs(exponent));
  }
}

TEST(HybridVerdict, OfExactSwitchingIsPeriodicByCertificate) {
  for (const JudgedCase& which :
       {JudgedCase{0.001, 0.0005, 0.0}, {0.005, 0.001, 0.0}, {0.01, 0.002, 0.0}}) {
    for (const ForceHold hold : {ForceHold::sampled, ForceHold::exact}) {
      RealLoop loop = judged_real_loop(which.sampling_period, which.width);
      loop.digital.hold = hold;
      const HybridVerdict found = judged_from_rest(loop);
      ASSERT_EQ(found.search.outcome, OrbitOutcome::certified) << which.sampling_period;
      EXPECT_EQ(found.verdict.kind, MotionKind::periodic);
      EXPECT_EQ(found.verdict.period, found.search.orbit->period_samples());
      EXPECT_EQ(found.evidence.certified_period, found.verdict.period);
      EXPECT_EQ(found.verdict.rests_on.find("Certified orbit"), 0U) << found.verdict.rests_on;
      EXPECT_NE(found.verdict.rests_on.find("switches alike"), std::string::npos);
      EXPECT_TRUE(found.evidence.largest_exponent->negative());
    }
  }
}

TEST(HybridVerdict, WithoutBacklashBothSwitchingsFollowTheForcing) {
  for (const Switching switching : {Switching::sampled, Switching::exact}) {
    const RealLoop loop = judged_real_loop(0.01, 0.0, switching);
    const HybridVerdict found = judged_from_rest(loop);
    EXPECT_EQ(found.verdict.kind, MotionKind::periodic);
    EXPECT_EQ(found.verdict.period, 10);
    const double expected = exponent_without_backlash(loop);
    EXPECT_NEAR(found.evidence.largest_exponent->value, expected, 1e-9 * std::abs(expected));
  }
}

TEST(HybridVerdict, ADelayOfAWholePeriodDiverges) {
  // With exact switching the stick phases of any backlash would hold the motion.
  for (const auto& [switching, width] :
       {std::pair{Switching::sampled, 0.002}, std::pair{Switching::exact, 0.0}}) {
    RealLoop loop = judged_real_loop(0.011, width, switching);
    loop.digital.sampling.processing_delay = 0.011;
    const HybridVerdict found = judged_from_rest(loop);
    EXPECT_EQ(found.verdict.kind, MotionKind::diverges);
    EXPECT_GT(found.evidence.diverged_at.value_or(0), 0);
  }
}

TEST(HybridVerdict, IncommensurateHarmonicsOfAStableLinearLoopAreQuasiPeriodic) {
  RealLoop loop = judged_real_loop(0.01, 0.0);
  loop.digital.force.harmonics = {{0.3, 10.0}, {0.2, 10.0 * std::sqrt(0.5), 1.0}};
  const HybridVerdict found = judged_from_rest(loop);
  EXPECT_EQ(found.search.outcome, OrbitOutcome::incommensurate);
  EXPECT_EQ(found.verdict.kind, MotionKind::quasi_periodic) << found.verdict.rests_on;
  expect_exponent(found, exponent_without_backlash(loop));
}

TEST(HybridVerdict, AGapThatIsNeverLeftLeavesThePlantAlone) {
  RealLoop loop = judged_real_loop(0.01, 0.02);
  loop.digital.force.harmonics = {{0.5, 10.0 * std::sqrt(0.5)}};
  const HybridVerdict found = judged_from_rest(loop);
  EXPECT_EQ(found.verdict.kind, MotionKind::quasi_periodic) << found.verdict.rests_on;
  expect_exponent(found, exponent_of_plant(loop));
}

TEST(HybridVerdict, AStrayingClockGivesNoPeriodicClaim) {
  for (const Switching switching : {Switching::sampled, Switching::exact}) {
    for (const double width : {0.0, 0.001}) {
      for (const double half_width : {1e-11, 1e-3}) {
        RealLoop loop = judged_real_loop(0.01, width, switching);
        loop.digital.jitter = {half_width, 5};
        const HybridVerdict found = judged_from_rest(loop);
        EXPECT_EQ(found.search.outcome, OrbitOutcome::incommensurate);
        EXPECT_FALSE(found.search.orbit.has_value());
        EXPECT_FALSE(found.evidence.certified_period.has_value());
        EXPECT_FALSE(found.evidence.forcing_incommensurate);
        EXPECT_EQ(found.verdict.kind, MotionKind::irregular_contracting)
            << half_width << ' ' << found.verdict.rests_on;
        EXPECT_EQ(found.verdict.period, 0);
      }
    }
  }
}

TEST(HybridVerdict, RestIsRestAlsoWhereTheClockStrays) {
  RealLoop loop = judged_real_loop(0.01, 0.0);
  loop.digital.jitter = {1e-3, 5};
  loop.digital.force = {};
  const HybridVerdict found = classify_motion(loop, {0.001, 0.0, 0.0, 0.0});
  EXPECT_EQ(found.verdict.kind, MotionKind::periodic);
  EXPECT_EQ(found.verdict.period, 1);
  EXPECT_FALSE(found.evidence.certified_period.has_value());
}

TEST(HybridVerdict, AMotionUnderARandomRecordFollowsIt) {
  const double period = 0.01, duration = 120.0;
  for (const Switching switching : {Switching::sampled, Switching::exact}) {
    for (const double width : {0.0, 0.001}) {
      RealLoop loop = judged_real_loop(period, width, switching);
      loop.digital.force = {{}, random_record(duration, period)};
      const HybridVerdict found = judged_from_rest(loop);
      EXPECT_EQ(found.search.outcome, OrbitOutcome::incommensurate);
      EXPECT_EQ(found.verdict.kind, MotionKind::irregular_contracting) << found.verdict.rests_on;
      EXPECT_FALSE(found.evidence.forcing_periods.has_value());
      if (width == 0.0) expect_exponent(found, exponent_without_backlash(loop));
      // A sixth of the samples is the largest lag; as many samples again are left out before.
      ASSERT_TRUE(found.evidence.repeat.has_value());
      EXPECT_LE(2 * 6 * found.evidence.repeat->largest_lag,
                static_cast<std::int64_t>(duration / period));
    }
  }
}

TEST(HybridVerdict, AShortRecordDecidesNothing) {
  RealLoop loop = judged_real_loop(0.01, 0.001);
  loop.digital.force = {{}, random_record(41.0, 0.01)};
  const HybridVerdict found = judged_from_rest(loop);
  EXPECT_EQ(found.verdict.kind, MotionKind::undecided);
  EXPECT_NE(found.verdict.rests_on.find("ends before"), std::string::npos);
  EXPECT_FALSE(found.evidence.largest_exponent.has_value());
}

TEST(HybridVerdict, NoiseWithoutACommonPeriodIsNeverCalledPeriodic) {
  RealLoop loop = judged_real_loop(0.01, 0.001);
  loop.digital.force.harmonics = band_limited_noise({0.35, 1.0, 10.0 * pi<double>, 40, 7});
  const HybridVerdict found = judged_from_rest(loop);
  EXPECT_EQ(found.search.outcome, OrbitOutcome::incommensurate);
  EXPECT_FALSE(found.evidence.certified_period.has_value());
  EXPECT_NE(found.verdict.kind, MotionKind::periodic) << found.verdict.rests_on;
  EXPECT_NE(found.verdict.kind, MotionKind::chaotic) << found.verdict.rests_on;
  ASSERT_TRUE(found.evidence.largest_exponent.has_value());
  EXPECT_TRUE(found.evidence.largest_exponent->negative());
}

TEST(HybridVerdict, IrregularForcingClaimsNoSecondFrequency) {
  MotionEvidence evidence;
  evidence.repeat = RepeatEvidence{0, 1000, 1e-9};
  evidence.zero_one = 0.0;
  evidence.lines = SpectralEvidence{0, 0.999, 5, 0.0};
  evidence.extent_growth = 1.0;
  evidence.largest_exponent = ExponentEvidence{0.0, 1e-6};
  ASSERT_EQ(judge(evidence).kind, MotionKind::quasi_periodic);
  EXPECT_EQ(detail::judge_irregularly_forced(evidence, true).kind, MotionKind::undecided);
  evidence.largest_exponent = ExponentEvidence{-0.1, 1e-6};
  evidence.forcing_incommensurate = true;
  ASSERT_EQ(judge(evidence).kind, MotionKind::quasi_periodic);
  EXPECT_EQ(detail::judge_irregularly_forced(evidence, true).kind,
            MotionKind::irregular_contracting);
  evidence.repeat->lag = 7;
  ASSERT_EQ(judge(evidence).kind, MotionKind::periodic);
  EXPECT_EQ(detail::judge_irregularly_forced(evidence, false).kind, MotionKind::periodic);
  EXPECT_EQ(detail::judge_irregularly_forced(evidence, true).kind,
            MotionKind::irregular_contracting);
  evidence.forcing_periods = 3.0;
  EXPECT_EQ(detail::judge_irregularly_forced(evidence, true).kind, MotionKind::undecided);
  evidence.diverged_at = 9;
  EXPECT_EQ(detail::judge_irregularly_forced(evidence, true).kind, MotionKind::diverges);
}

TEST(HybridVerdict, WhatIsOutOfRangeIsRefused) {
  const Vector<double, 4> start = Vector<double, 4>::Zero();
  EXPECT_THROW(classify_motion(judged_real_loop(0.01, -0.002), start), InvalidParameter);
  EXPECT_THROW(classify_motion(judged_real_loop(0.01, 0.002), start, {0, 0}), InvalidParameter);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(classify_motion(judged_real_loop(0.01, 0.002), {nan, 0.0, 0.0, 0.0}),
               InvalidParameter);
}

}  // namespace
}  // namespace holdfast
