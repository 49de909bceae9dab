#include "holdfast/chaos/classification.hpp"

#include "holdfast/chaos/motion_classification.hpp"
#include "support/kollar_case.hpp"

namespace holdfast {
namespace {

// Maps of one number are those of [x; 0], so that one size does for all maps here.
using Point = Vector<double, 2>;
Point point(double x) { return {x, 0.0}; }
Matrix<double, 2> slope(double by_x) { return point(by_x).asDiagonal(); }
const double golden_mean = 0.5 * (std::sqrt(5.0) - 1.0);

double first_coordinate(const Point& x) { return x[0]; }

ChaosIndicators logistic_indicators(double r, const IndicatorOptions& options = {}) {
  return chaos_indicators<2>(
      point(0.3), [r](Point& x) { x[0] = r * x[0] * (1 - x[0]); }, first_coordinate, options,
      [r](const Point& x) { return slope(r - 2 * r * x[0]); });
}

bool names(const Classification& classification, const std::string& words) {
  return classification.rests_on.find(words) != std::string::npos;
}

ChaosIndicators loop_indicators(const test::KollarCase& which,
                                const IndicatorOptions& options = {}) {
  const IdealLoop<double> loop = which.ideal_loop();
  const auto motion = harmonically_forced_motion(loop, which.initial_state);
  return detail::indicators_of_motion(loop, motion, options);
}

// ---- systems whose motion is known -------------------------------------------------------------

TEST(Classification, TheLogisticMapIsChaoticWhereItIsKnownToBe) {
  for (const double r : {4.0, 3.9}) {
    const ChaosIndicators indicators = logistic_indicators(r);
    const Classification classification = classify(indicators);
    EXPECT_EQ(attractor_type_text(classification), "chaotic")
        << r << " " << classification.rests_on;
    EXPECT_TRUE(names(classification, "exponent")) << classification.rests_on;
    EXPECT_TRUE(names(classification, "K = ")) << classification.rests_on;
    EXPECT_GT(indicators.lines->continuous, 0.5) << r;
    EXPECT_LT(*indicators.determinism, 1.0);
  }
}

TEST(Classification, TheWindowOfPeriodThreeHasPeriodThree) {
  const ChaosIndicators indicators = logistic_indicators(3.83);
  const Classification classification = classify(indicators);
  EXPECT_EQ(attractor_type_text(classification), "periodic(3)") << classification.rests_on;
  EXPECT_TRUE(names(classification, "no certificate"));
  EXPECT_EQ(indicators.lines->division, 3);
  EXPECT_LT(std::abs(*indicators.zero_one), 0.2);
  EXPECT_TRUE(indicators.largest_exponent->negative());
}

ChaosIndicators rotation_indicators(double turns) {
  return chaos_indicators<2>(
      Vector<double, 2>(1, 0),
      [turns, n = 0](Vector<double, 2>& z) mutable {
        const double angle = 2 * pi<double> * turns * ++n;
        z = {std::cos(angle), std::sin(angle)};
      },
      [](const Vector<double, 2>& z) { return z[0] + 0.3 * z[0] * z[1]; }, {},
      [turns](const Vector<double, 2>&) {
        const double c = std::cos(2 * pi<double> * turns), s = std::sin(2 * pi<double> * turns);
        return (Matrix<double, 2>() << c, -s, s, c).finished();
      });
}

TEST(Classification, RotationIsQuasiPeriodicByAnIrrationalAngleAndPeriodicByARationalOne) {
  const ChaosIndicators indicators = rotation_indicators(golden_mean);
  const Classification classification = classify(indicators);
  EXPECT_EQ(attractor_type_text(classification), "quasi-periodic") << classification.rests_on;
  EXPECT_FALSE(indicators.largest_exponent->positive() || indicators.largest_exponent->negative());
  EXPECT_EQ(attractor_type_text(classify(rotation_indicators(7.0 / 19.0))), "periodic(19)");
}

TEST(Classification, AtTheFeigenbaumPointNothingIsClaimedThatIsNotSo) {
  // An exponent of zero, no period, and lines on the multiples of 1/2^k alone: neither periodic nor
  // chaotic nor quasi-periodic.
  const Classification classification = classify(logistic_indicators(3.569945671870945));
  EXPECT_EQ(classification.kind, AttractorType::undecided) << classification.rests_on;
  EXPECT_TRUE(names(classification, "no repetition")) << classification.rests_on;
}

ChaosIndicators forced_linear_indicators(double turns, bool incommensurate) {
  IndicatorOptions options;
  options.forcing_incommensurate = incommensurate;
  return chaos_indicators<2>(
      point(0.0),
      [turns, n = 0](Point& x) mutable {
        x[0] = 0.7 * x[0] + std::cos(2 * pi<double> * turns * ++n);
      },
      first_coordinate, options, [](const Point&) { return slope(0.7); });
}

TEST(Classification,
     AStableLinearMapUnderIncommensurateForcingIsQuasiPeriodicInSpiteOfItsExponent) {
  const ChaosIndicators indicators = forced_linear_indicators(golden_mean / 3, true);
  EXPECT_TRUE(indicators.largest_exponent->negative());
  const Classification classification = classify(indicators);
  EXPECT_EQ(attractor_type_text(classification), "quasi-periodic") << classification.rests_on;
  EXPECT_TRUE(names(classification, "forcing"));
  EXPECT_EQ(attractor_type_text(classify(forced_linear_indicators(3.0 / 16.0, false))),
            "periodic(16)");
}

TEST(Classification, TheLoopWithoutBacklashRepeatsAsSamplingAndForcingDo) {
  for (const double tau : {0.010, 0.011}) {
    IndicatorOptions options;
    options.samples = 20000;  // whole periods of both
    const ChaosIndicators indicators = loop_indicators({tau, 0.0}, options);
    const Classification classification = classify(indicators);
    EXPECT_EQ(classification.kind, AttractorType::periodic) << classification.rests_on;
    EXPECT_EQ(classification.period, samples_per_common_period(10.0, tau))
        << classification.rests_on;
    EXPECT_EQ(indicators.switching->switches, 0U);
    EXPECT_EQ(indicators.lines->division, classification.period);
  }
}

TEST(Classification, TheLoopWithoutBacklashIsQuasiPeriodicWhereTheForcingNeverCoincides) {
  test::KollarCase which{0.010, 0.0};
  which.excitation.frequency = 10.0 * std::sqrt(1.1);
  IndicatorOptions options;
  options.forcing_incommensurate =
      samples_per_common_period(which.excitation.frequency, 0.010) == 0;
  const Classification classification = classify(loop_indicators(which, options));
  EXPECT_TRUE(options.forcing_incommensurate);
  EXPECT_EQ(attractor_type_text(classification), "quasi-periodic") << classification.rests_on;
}

TEST(Classification, MotionsWithBacklashThatRepeatAreFoundToRepeat) {
  // 0.1 s at 1 ms, 23.1 s at 11 ms; the second is irregular to the eye for as long.
  const struct {
    double tau, width;
    std::int64_t period;
  } known[] = {{0.001, 0.0005, 100}, {0.011, 0.002, 2100}};
  for (const auto& motion : known) {
    IndicatorOptions options;
    options.transient = 40000;
    options.samples = 21000;
    const ChaosIndicators indicators = loop_indicators({motion.tau, motion.width}, options);
    const Classification classification = classify(indicators);
    EXPECT_EQ(classification.kind, AttractorType::periodic) << classification.rests_on;
    EXPECT_EQ(classification.period, motion.period) << classification.rests_on;
    EXPECT_GT(indicators.switching->switches, 0U);
    EXPECT_FALSE(indicators.largest_exponent->positive());
  }
}

TEST(Classification, APeriodLongerThanTheSearchIsCalledIrregularAndSaysHowFarWasLooked) {
  IndicatorOptions options;
  options.transient = 40000;
  options.samples = 5040;
  const Classification classification = classify(loop_indicators({0.011, 0.002}, options));
  EXPECT_EQ(attractor_type_text(classification), "irregular, exponent <= 0")
      << classification.rests_on;
  EXPECT_TRUE(names(classification, "within 840 samples")) << classification.rests_on;
  EXPECT_TRUE(names(classification, "bit per sample")) << classification.rests_on;
}

TEST(Classification, TheLoopThatWaitsAWholeSampleDiverges) {
  test::KollarCase which{0.011, 0.002};
  which.processing_delay = which.sampling_period;
  const ChaosIndicators indicators = loop_indicators(which);
  EXPECT_EQ(attractor_type_text(classify(indicators)), "diverges");
  EXPECT_LT(*indicators.diverged_at, 1000);
}

TEST(Classification, AMotionThatHasDecayedToRestHasPeriodOne) {
  const Classification classification = classify(chaos_indicators<2>(
      Vector<double, 2>(1, -3), [](Vector<double, 2>& z) { z *= 0.99; },
      [](const Vector<double, 2>& z) { return z[0]; }));
  EXPECT_EQ(attractor_type_text(classification), "periodic(1)") << classification.rests_on;
}

/// A spiral that turns by 1.1 and stretches by `growth` a sample.
ChaosIndicators spiral_indicators(double growth) {
  const double c = growth * std::cos(1.1), s = growth * std::sin(1.1);
  Matrix<double, 2> map;
  map << c, -s, s, c;
  return chaos_indicators<2>(
      Vector<double, 2>(1, 0), [&map](Vector<double, 2>& z) { z = Vector<double, 2>(map * z); },
      [](const Vector<double, 2>& z) { return z[0]; }, {},
      [&map](const Vector<double, 2>&) { return map; });
}

TEST(Classification, SlowDecayIsNotCalledIrregular) {
  const ChaosIndicators indicators = spiral_indicators(0.99999);
  EXPECT_TRUE(indicators.largest_exponent->negative());
  EXPECT_EQ(classify(indicators).kind, AttractorType::undecided) << classify(indicators).rests_on;
}

TEST(Classification, SlowGrowthIsNoChaos) {
  // 1.0005^20160 = 2 · 10⁴: far from any bound of the number type, a positive exponent throughout.
  const ChaosIndicators indicators = spiral_indicators(1.0005);
  EXPECT_TRUE(indicators.largest_exponent->positive());
  const Classification classification = classify(indicators);
  EXPECT_EQ(classification.kind, AttractorType::undecided);
  EXPECT_TRUE(names(classification, "not steady")) << classification.rests_on;
  EXPECT_EQ(classify(spiral_indicators(1.00001)).kind, AttractorType::undecided) << "K is low";
}

// ---- the rules ---------------------------------------------------------------------------------

ChaosIndicators chaotic_indicators() {
  ChaosIndicators indicators;
  indicators.largest_exponent = exponent_estimate(0.5, 0.01);
  indicators.zero_one = 0.99;
  indicators.repeat = RepeatSearch{0, 3000, 1e-9};
  indicators.lines = SpectralIndicators{0, 0.999, 5000, 0.9};
  indicators.extent_growth = 1.0;
  return indicators;
}

AttractorType kind_of(const ChaosIndicators& indicators) { return classify(indicators).kind; }

TEST(Classify, NothingKnownIsUndecided) {
  EXPECT_EQ(kind_of({}), AttractorType::undecided);
  EXPECT_FALSE(classify({}).rests_on.empty());
}

TEST(Classify, DivergenceComesBeforeACertificateAndACertificateBeforeEverythingElse) {
  ChaosIndicators indicators = chaotic_indicators();
  indicators.certified_period = 2100;
  EXPECT_EQ(attractor_type_text(classify(indicators)), "periodic(2100)");
  EXPECT_TRUE(names(classify(indicators), "Certified"));
  indicators.diverged_at = 77;
  EXPECT_EQ(attractor_type_text(classify(indicators)), "diverges");
  EXPECT_TRUE(names(classify(indicators), "77"));
}

TEST(Classify, ChaosTakesAPositiveExponentAndAHighKThatNothingContradicts) {
  EXPECT_EQ(kind_of(chaotic_indicators()), AttractorType::chaotic);
  const auto spoiled = [](auto&& spoil) {
    ChaosIndicators indicators = chaotic_indicators();
    spoil(indicators);
    return kind_of(indicators);
  };
  using Indicators = ChaosIndicators;
  EXPECT_EQ(spoiled([](Indicators& e) { e.largest_exponent.reset(); }), AttractorType::undecided);
  EXPECT_EQ(spoiled([](Indicators& e) { e.largest_exponent->half_width = 0.6; }),
            AttractorType::undecided);
  EXPECT_EQ(spoiled([](Indicators& e) { e.zero_one.reset(); }), AttractorType::undecided);
  for (const double k : {0.0, 0.5, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(spoiled([k](Indicators& e) { e.zero_one = k; }), AttractorType::undecided) << k;
  EXPECT_EQ(spoiled([](Indicators& e) { e.lines->continuous = 0.0; }), AttractorType::undecided);
  EXPECT_EQ(spoiled([](Indicators& e) { e.lines->division = 4; }), AttractorType::undecided);
  EXPECT_EQ(spoiled([](Indicators& e) { e.extent_growth = 2.5; }), AttractorType::undecided);
  EXPECT_EQ(spoiled([](Indicators& e) { e.repeat->lag = 12; }), AttractorType::undecided)
      << "an unstable orbit, or round-off";
}

TEST(Classify, AZeroExponentNeedsALowKNoRepetitionAndLinesWithoutACommonBase) {
  ChaosIndicators indicators = chaotic_indicators();
  indicators.largest_exponent = exponent_estimate(0.0, 0.0);
  indicators.zero_one = 0.02;
  indicators.lines = SpectralIndicators{0, 0.999, 6, 1e-6};
  EXPECT_EQ(kind_of(indicators), AttractorType::quasi_periodic);
  for (auto spoil :
       {+[](ChaosIndicators& e) { e.zero_one = 0.9; },
        +[](ChaosIndicators& e) { e.repeat.reset(); }, +[](ChaosIndicators& e) { e.lines.reset(); },
        +[](ChaosIndicators& e) { e.lines->division = 64; },
        +[](ChaosIndicators& e) { e.lines->continuous = 0.1; }}) {
    ChaosIndicators spoiled = indicators;
    spoil(spoiled);
    EXPECT_EQ(kind_of(spoiled), AttractorType::undecided);
  }
  indicators.repeat->lag = 12;
  EXPECT_EQ(attractor_type_text(classify(indicators)), "periodic(12)");
}

TEST(Classify, ANeighbourDecidesWhereTheZeroOneTestDoesNot) {
  ChaosIndicators indicators = chaotic_indicators();
  indicators.zero_one = 0.0;
  indicators.lines = SpectralIndicators{0, 0.999, 6, 1e-6};
  for (const auto& [came_to, kind] : {std::pair{1e-3, AttractorType::chaotic},
                                      {9e-4, AttractorType::undecided},
                                      {1e-9, AttractorType::undecided}}) {
    indicators.neighbour = came_to;
    EXPECT_EQ(kind_of(indicators), kind) << came_to;
  }
  indicators.largest_exponent = exponent_estimate(0.0, 0.0);
  indicators.zero_one = 0.5;
  for (const auto& [came_to, kind] : {std::pair{1e-7, AttractorType::quasi_periodic},
                                      {2e-7, AttractorType::undecided},
                                      {0.5, AttractorType::undecided}}) {
    indicators.neighbour = came_to;
    EXPECT_EQ(kind_of(indicators), kind) << came_to;
  }
  indicators.neighbour = 1e-9;
  EXPECT_TRUE(names(classify(indicators), "a neighbouring motion went from 1e-09 to 1e-09"));
  indicators.zero_one = 0.9;
  EXPECT_EQ(kind_of(indicators), AttractorType::undecided) << "the two contradict each other";
  indicators.zero_one = 0.5;
  indicators.lines->continuous = 0.1;
  EXPECT_EQ(kind_of(indicators), AttractorType::undecided);
  indicators.repeat->lag = 12;
  indicators.neighbour = 0.5;
  EXPECT_EQ(kind_of(indicators), AttractorType::periodic);
}

TEST(Classify, ANegativeExponentWithoutRepetitionIsIrregularUnlessTheForcingIsIncommensurate) {
  ChaosIndicators indicators = chaotic_indicators();
  indicators.largest_exponent = exponent_estimate(-0.01, 0.001);
  EXPECT_EQ(attractor_type_text(classify(indicators)), "irregular, exponent <= 0");
  indicators.largest_exponent->value = -std::numeric_limits<double>::infinity();
  EXPECT_EQ(kind_of(indicators), AttractorType::irregular_contracting);
  indicators.forcing_incommensurate = true;
  EXPECT_EQ(kind_of(indicators), AttractorType::irregular_contracting) << "K is high";
  indicators.zero_one = 0.01;
  EXPECT_EQ(kind_of(indicators), AttractorType::irregular_contracting) << "a floor under the lines";
  indicators.lines->continuous = 1e-5;
  EXPECT_EQ(kind_of(indicators), AttractorType::quasi_periodic);
  indicators.forcing_incommensurate = false;
  EXPECT_EQ(kind_of(indicators), AttractorType::undecided) << "a regular series: a slow transient";
  indicators.zero_one = 0.99;
  EXPECT_EQ(kind_of(indicators), AttractorType::irregular_contracting);
  indicators.lines->division = 7;
  EXPECT_EQ(kind_of(indicators), AttractorType::undecided) << "a longer period";
  indicators.repeat.reset();
  EXPECT_EQ(kind_of(indicators), AttractorType::undecided);
}

TEST(Classify, EveryKindHasItsWords) {
  EXPECT_EQ(attractor_type_text(AttractorType::periodic, 12), "periodic(12)");
  EXPECT_EQ(attractor_type_text(AttractorType::undecided), "undecided");
  EXPECT_EQ(attractor_type_text(AttractorType::irregular_contracting), "irregular, exponent <= 0");
}

TEST(ExponentEstimate, IsNeverNarrowerThanTheRoundingOfLogarithms) {
  EXPECT_FALSE(exponent_estimate(5e-13, 0.0).positive());
  EXPECT_TRUE(exponent_estimate(5e-12, 0.0).positive());
  EXPECT_TRUE(exponent_estimate(-1.0, 0.36).negative());
  EXPECT_FALSE(exponent_estimate(-1.0, 0.37).negative());
  EXPECT_THROW(exponent_estimate(0.0, std::numeric_limits<double>::quiet_NaN()), InvalidParameter);
}

// ---- the gathering -----------------------------------------------------------------------------

TEST(ChaosIndicators, KeepsQuietOnWhatItWasNotGiven) {
  IndicatorOptions options;
  options.samples = 2000;
  options.transient = 0;
  const ChaosIndicators indicators = chaos_indicators<2>(
      point(0.3), [](Point& x) { x[0] = 4 * x[0] * (1 - x[0]); }, first_coordinate, options);
  EXPECT_FALSE(indicators.largest_exponent);
  EXPECT_FALSE(indicators.switching);
  EXPECT_FALSE(indicators.certified_period);
  EXPECT_TRUE(indicators.zero_one && indicators.lines && indicators.repeat &&
              indicators.determinism);
  EXPECT_EQ(kind_of(indicators), AttractorType::undecided) << "K alone claims no chaos";
  EXPECT_GT(*indicators.zero_one, zero_one_high);
}

TEST(ChaosIndicators, StopsAtTheFirstStateThatIsNoNumber) {
  std::int64_t steps = 0;
  const ChaosIndicators indicators = chaos_indicators<2>(
      point(2.0), [&steps](Point& x) { ++steps, x[0] = 4 * x[0] * (1 - x[0]); }, first_coordinate);
  EXPECT_EQ(*indicators.diverged_at, steps);
  EXPECT_LT(steps, 20);
}

TEST(ChaosIndicators, WhatIsOutOfRangeIsRefused) {
  const auto gathers = [](double start, const IndicatorOptions& options) {
    return chaos_indicators<2>(
        point(start), [](Point& x) { x *= 0.5; }, first_coordinate, options);
  };
  IndicatorOptions few, stride;
  few.samples = 1999;
  stride.zero_one_stride = 41;
  EXPECT_THROW(gathers(1.0, few), InvalidParameter);
  EXPECT_THROW(gathers(1.0, stride), InvalidParameter);
  EXPECT_THROW(gathers(std::numeric_limits<double>::infinity(), {}), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
