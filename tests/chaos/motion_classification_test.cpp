#include "holdfast/chaos/motion_classification.hpp"

#include "holdfast/excitation/band_limited_noise.hpp"
#include "support/dense_routes.hpp"
#include "support/kollar_case.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

struct ClassifiedCase {
  double sampling_period, width, displacement;
};

ImplementedLoop classified_implemented_loop(double sampling_period, double width,
                                            Switching switching = Switching::exact) {
  ImplementedLoop loop = implemented_loop(test::kollar_loop(sampling_period, width));
  loop.switching = switching;
  return loop;
}

/// @tparam Loop  IdealLoop<double> or ImplementedLoop
template <class Loop>
auto classified_from_rest(const Loop& loop) {
  return classify_motion(loop, Vector<double, 4>::Zero());
}

/// ln ρ(S), the exponent per sample of a loop without backlash.
double exponent_without_backlash(const ImplementedLoop& loop) {
  const auto map = sampled_loop(loop.plant, loop.digital.sampling).engaged_map(loop.digital.gains);
  return test::log_moduli_of(map)[0];
}

/// That of the plant left alone.
double exponent_of_plant(const ImplementedLoop& loop) {
  return test::eigenvalues_of(loop.plant.state_matrix()).real().maxCoeff() *
         loop.digital.sampling.period;
}

void expect_exponent(const EventClassification& found, double expected) {
  ASSERT_TRUE(found.indicators.largest_exponent.has_value());
  const ExponentEstimate& exponent = *found.indicators.largest_exponent;
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

TEST(MotionClassification, OfSampledSwitchingIsThatOfTheModelOfThePaper) {
  for (const ClassifiedCase& which : {ClassifiedCase{0.001, 0.0005, 0.0},
                                      {0.01, 0.002, 0.0},
                                      {0.003, 0.002, 0.0},
                                      {0.003, 0.002, 1e-5},
                                      {0.01, 0.0, 0.0}}) {
    const Vector<double, 4> start(which.displacement, 0.0, 0.0, 0.0);
    const auto loop = test::kollar_loop(which.sampling_period, which.width);
    const SampledClassification paper = classify_motion(loop, start);
    const EventClassification found = classify_motion(implemented_loop(loop), start);
    EXPECT_EQ(found.classification.kind, AttractorType::periodic);
    EXPECT_EQ(found.classification.kind, paper.classification.kind);
    EXPECT_EQ(found.classification.period, paper.classification.period);
    EXPECT_EQ(found.search.outcome, paper.search.outcome);
    ASSERT_TRUE(found.search.orbit && paper.search.orbit);
    EXPECT_NEAR(found.search.orbit->amplitude(), paper.search.orbit->amplitude(),
                1e-9 * paper.search.orbit->amplitude());
    const double exponent = paper.indicators.largest_exponent->value;
    EXPECT_NEAR(found.indicators.largest_exponent->value, exponent, 1e-6 * std::abs(exponent));
  }
}

TEST(MotionClassification, OfExactSwitchingIsPeriodicByCertificate) {
  for (const ClassifiedCase& which :
       {ClassifiedCase{0.001, 0.0005, 0.0}, {0.005, 0.001, 0.0}, {0.01, 0.002, 0.0}}) {
    for (const ForceHold hold : {ForceHold::sampled, ForceHold::exact}) {
      ImplementedLoop loop = classified_implemented_loop(which.sampling_period, which.width);
      loop.digital.hold = hold;
      const EventClassification found = classified_from_rest(loop);
      ASSERT_EQ(found.search.outcome, OrbitOutcome::certified) << which.sampling_period;
      EXPECT_EQ(found.classification.kind, AttractorType::periodic);
      EXPECT_EQ(found.classification.period, found.search.orbit->period_samples());
      EXPECT_EQ(found.indicators.certified_period, found.classification.period);
      EXPECT_EQ(found.classification.rests_on.find("Certified orbit"), 0U)
          << found.classification.rests_on;
      EXPECT_NE(found.classification.rests_on.find("changes agree"), std::string::npos);
      EXPECT_TRUE(found.indicators.largest_exponent->negative());
    }
  }
}

TEST(MotionClassification, WithoutBacklashBothSwitchingsFollowTheForcing) {
  for (const Switching switching : {Switching::sampled, Switching::exact}) {
    const ImplementedLoop loop = classified_implemented_loop(0.01, 0.0, switching);
    const EventClassification found = classified_from_rest(loop);
    EXPECT_EQ(found.classification.kind, AttractorType::periodic);
    EXPECT_EQ(found.classification.period, 10);
    const double expected = exponent_without_backlash(loop);
    EXPECT_NEAR(found.indicators.largest_exponent->value, expected, 1e-9 * std::abs(expected));
  }
}

TEST(MotionClassification, ADelayOfAWholePeriodDiverges) {
  IdealLoop<double> paper = test::kollar_loop(0.011, 0.002);
  paper.sampling.processing_delay = 0.011;
  EXPECT_EQ(classified_from_rest(paper).classification.kind, AttractorType::diverges);
  // With exact switching the stick phases of any backlash would hold the motion.
  for (const auto& [switching, width] :
       {std::pair{Switching::sampled, 0.002}, std::pair{Switching::exact, 0.0}}) {
    ImplementedLoop loop = classified_implemented_loop(0.011, width, switching);
    loop.digital.sampling.processing_delay = 0.011;
    const EventClassification found = classified_from_rest(loop);
    EXPECT_EQ(found.classification.kind, AttractorType::diverges);
    EXPECT_GT(found.indicators.diverged_at.value_or(0), 0);
  }
}

TEST(MotionClassification, IncommensurateHarmonicsOfAStableLinearLoopAreQuasiPeriodic) {
  ImplementedLoop loop = classified_implemented_loop(0.01, 0.0);
  loop.digital.force.harmonics = {{0.3, 10.0}, {0.2, 10.0 * std::sqrt(0.5), 1.0}};
  const EventClassification found = classified_from_rest(loop);
  EXPECT_EQ(found.search.outcome, OrbitOutcome::incommensurate);
  EXPECT_EQ(found.classification.kind, AttractorType::quasi_periodic)
      << found.classification.rests_on;
  expect_exponent(found, exponent_without_backlash(loop));
}

TEST(MotionClassification, UnderAnIncommensurateForcingThePapersLoopIsNeverPeriodicByCertificate) {
  for (const double width : {0.0, 0.002}) {
    IdealLoop<double> loop = test::kollar_loop(0.011, width);
    loop.excitation.frequency = 9.8765432101;
    const SampledClassification found = classified_from_rest(loop);
    EXPECT_EQ(found.search.outcome, OrbitOutcome::incommensurate);
    EXPECT_FALSE(found.indicators.certified_period.has_value());
    if (width == 0.0) {
      EXPECT_EQ(found.classification.kind, AttractorType::quasi_periodic);
    }
    EXPECT_NE(found.classification.kind, AttractorType::chaotic);
    ASSERT_TRUE(found.indicators.largest_exponent.has_value());
    EXPECT_TRUE(found.indicators.largest_exponent->negative());
  }
}

TEST(MotionClassification, AGapThatIsNeverLeftLeavesThePlantAlone) {
  ImplementedLoop loop = classified_implemented_loop(0.01, 0.02);
  loop.digital.force.harmonics = {{0.5, 10.0 * std::sqrt(0.5)}};
  const EventClassification found = classified_from_rest(loop);
  EXPECT_EQ(found.classification.kind, AttractorType::quasi_periodic)
      << found.classification.rests_on;
  expect_exponent(found, exponent_of_plant(loop));
}

TEST(MotionClassification, AJitteringClockGivesNoPeriodicClaim) {
  for (const Switching switching : {Switching::sampled, Switching::exact}) {
    for (const double width : {0.0, 0.001}) {
      for (const double half_width : {1e-11, 1e-3}) {
        ImplementedLoop loop = classified_implemented_loop(0.01, width, switching);
        loop.digital.jitter = {half_width, 5};
        const EventClassification found = classified_from_rest(loop);
        EXPECT_EQ(found.search.outcome, OrbitOutcome::incommensurate);
        EXPECT_FALSE(found.search.orbit.has_value());
        EXPECT_FALSE(found.indicators.certified_period.has_value());
        EXPECT_FALSE(found.indicators.forcing_incommensurate);
        EXPECT_EQ(found.classification.kind, AttractorType::irregular_contracting)
            << half_width << ' ' << found.classification.rests_on;
        EXPECT_EQ(found.classification.period, 0);
      }
    }
  }
}

TEST(MotionClassification, RestIsRestAlsoWhereTheClockJitters) {
  ImplementedLoop loop = classified_implemented_loop(0.01, 0.0);
  loop.digital.jitter = {1e-3, 5};
  loop.digital.force = {};
  const EventClassification found = classify_motion(loop, {0.001, 0.0, 0.0, 0.0});
  EXPECT_EQ(found.classification.kind, AttractorType::periodic);
  EXPECT_EQ(found.classification.period, 1);
  EXPECT_FALSE(found.indicators.certified_period.has_value());
}

TEST(MotionClassification, AMotionUnderARandomRecordFollowsIt) {
  const double period = 0.01, duration = 120.0;
  for (const Switching switching : {Switching::sampled, Switching::exact}) {
    for (const double width : {0.0, 0.001}) {
      ImplementedLoop loop = classified_implemented_loop(period, width, switching);
      loop.digital.force = {{}, random_record(duration, period)};
      const EventClassification found = classified_from_rest(loop);
      EXPECT_EQ(found.search.outcome, OrbitOutcome::incommensurate);
      EXPECT_EQ(found.classification.kind, AttractorType::irregular_contracting)
          << found.classification.rests_on;
      EXPECT_FALSE(found.indicators.forcing_periods.has_value());
      if (width == 0.0) expect_exponent(found, exponent_without_backlash(loop));
      // A sixth of the samples is the largest lag; as many samples again are left out before.
      ASSERT_TRUE(found.indicators.repeat.has_value());
      EXPECT_LE(2 * 6 * found.indicators.repeat->largest_lag,
                static_cast<std::size_t>(duration / period));
    }
  }
}

TEST(MotionClassification, AShortRecordDecidesNothing) {
  ImplementedLoop loop = classified_implemented_loop(0.01, 0.001);
  loop.digital.force = {{}, random_record(41.0, 0.01)};
  const EventClassification found = classified_from_rest(loop);
  EXPECT_EQ(found.classification.kind, AttractorType::undecided);
  EXPECT_NE(found.classification.rests_on.find("too short"), std::string::npos);
  EXPECT_FALSE(found.indicators.largest_exponent.has_value());
}

TEST(MotionClassification, NoiseWithoutACommonPeriodIsNeverCalledPeriodic) {
  ImplementedLoop loop = classified_implemented_loop(0.01, 0.001);
  loop.digital.force.harmonics = band_limited_noise({0.35, 1.0, 10.0 * pi<double>, 40, 7});
  const EventClassification found = classified_from_rest(loop);
  EXPECT_EQ(found.search.outcome, OrbitOutcome::incommensurate);
  EXPECT_FALSE(found.indicators.certified_period.has_value());
  EXPECT_NE(found.classification.kind, AttractorType::periodic) << found.classification.rests_on;
  EXPECT_NE(found.classification.kind, AttractorType::chaotic) << found.classification.rests_on;
  ASSERT_TRUE(found.indicators.largest_exponent.has_value());
  EXPECT_TRUE(found.indicators.largest_exponent->negative());
}

TEST(MotionClassification, IrregularForcingClaimsNoSecondFrequency) {
  ChaosIndicators indicators;
  indicators.repeat = RepeatSearch{0, 1000, 1e-9};
  indicators.zero_one = 0.0;
  indicators.lines = SpectralIndicators{0, 0.999, 5, 0.0};
  indicators.extent_growth = 1.0;
  indicators.largest_exponent = ExponentEstimate{0.0, 1e-6};
  ASSERT_EQ(classify(indicators).kind, AttractorType::quasi_periodic);
  const auto kind = [&indicators](bool samples_jitter) {
    return detail::Classifier(indicators).classify_irregularly_forced(samples_jitter).kind;
  };
  EXPECT_EQ(kind(true), AttractorType::undecided);
  indicators.largest_exponent = ExponentEstimate{-0.1, 1e-6};
  indicators.forcing_incommensurate = true;
  ASSERT_EQ(classify(indicators).kind, AttractorType::quasi_periodic);
  EXPECT_EQ(kind(true), AttractorType::irregular_contracting);
  indicators.repeat->lag = 7;
  ASSERT_EQ(classify(indicators).kind, AttractorType::periodic);
  EXPECT_EQ(kind(false), AttractorType::periodic);
  EXPECT_EQ(kind(true), AttractorType::irregular_contracting);
  indicators.forcing_periods = 3.0;
  EXPECT_EQ(kind(true), AttractorType::undecided);
  indicators.diverged_at = 9;
  EXPECT_EQ(kind(true), AttractorType::diverges);
}

TEST(MotionClassification, WhatIsOutOfRangeIsRefused) {
  const Vector<double, 4> start = Vector<double, 4>::Zero();
  EXPECT_THROW(classify_motion(classified_implemented_loop(0.01, -0.002), start), InvalidParameter);
  EXPECT_THROW(classify_motion(classified_implemented_loop(0.01, 0.002), start, {0, 0}),
               InvalidParameter);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(classify_motion(classified_implemented_loop(0.01, 0.002), {nan, 0.0, 0.0, 0.0}),
               InvalidParameter);
}

}  // namespace
}  // namespace holdfast
