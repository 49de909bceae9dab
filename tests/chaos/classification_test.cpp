#include "holdfast/chaos/classification.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "holdfast/chaos/chaos_indicators.hpp"
#include "support/kollar_case.hpp"
#include "support/random.hpp"
#include "support/random_loop.hpp"

namespace holdfast {
namespace {

using Point1 = Vector<double, 1>;
using Slope1 = Matrix<double, 1>;
const double golden_mean = 0.5 * (std::sqrt(5.0) - 1.0);
constexpr double euler_gamma = 0.57721566490153286061;

double first_coordinate(const Point1& x) { return x[0]; }

MotionEvidence logistic_evidence(double r, const EvidencePlan& plan = {}) {
  return gather_evidence<1>(
      Point1(0.3), [r](Point1& x) { x[0] = r * x[0] * (1 - x[0]); }, first_coordinate, plan,
      [r](const Point1& x) { return Slope1(r - 2 * r * x[0]); });
}

bool names(const Verdict& verdict, const std::string& words) {
  return verdict.rests_on.find(words) != std::string::npos;
}

/// The sampled loop as a discrete system of [z; u_{j−1}].
struct LoopSystem {
  test::KollarCase which;
  SampledMotion<double> motion = which.motion();
  SampledLoop<double> loop = which.loop();
  bool engaged = true;

  MotionEvidence evidence(const EvidencePlan& plan) {
    return gather_evidence<5>(
        Vector<double, 5>::Zero(), [this](Vector<double, 5>& state) { step(state); },
        [](const Vector<double, 5>& state) { return state[0]; }, plan,
        [this](const Vector<double, 5>&) {
          return engaged ? loop.engaged_map(which.gains) : loop.backlash_map();
        },
        [this] { return engaged; });
  }

 private:
  void step(Vector<double, 5>& state) {
    const MotionSample<double> sample = motion.sense();
    engaged = sample.engaged;
    motion.advance();
    state << motion.state(), sample.control_force;
  }
};

// ---- systems whose motion is known -------------------------------------------------------------

TEST(Verdict, TheLogisticMapIsChaoticWhereItIsKnownToBe) {
  for (const double r : {4.0, 3.9}) {
    const MotionEvidence evidence = logistic_evidence(r);
    const Verdict verdict = judge(evidence);
    EXPECT_EQ(motion_kind_text(verdict), "chaotic") << r << " " << verdict.rests_on;
    EXPECT_TRUE(names(verdict, "exponent")) << verdict.rests_on;
    EXPECT_TRUE(names(verdict, "K = ")) << verdict.rests_on;
    EXPECT_GT(evidence.lines->continuous, 0.5) << r;
    EXPECT_LT(evidence.recurrence->determinism, 1.0);
  }
}

TEST(Verdict, TheSkewTentMapIsChaotic) {
  const double a = 0.3;
  const Verdict verdict = judge(gather_evidence<1>(
      Point1(0.2), [a](Point1& x) { x[0] = x[0] < a ? x[0] / a : (1 - x[0]) / (1 - a); },
      first_coordinate, {},
      [a](const Point1& x) { return Slope1(x[0] < a ? 1 / a : 1 / (a - 1)); }));
  EXPECT_EQ(motion_kind_text(verdict), "chaotic") << verdict.rests_on;
}

TEST(Verdict, TheWindowOfPeriodThreeHasPeriodThree) {
  const MotionEvidence evidence = logistic_evidence(3.83);
  const Verdict verdict = judge(evidence);
  EXPECT_EQ(motion_kind_text(verdict), "periodic(3)") << verdict.rests_on;
  EXPECT_TRUE(names(verdict, "no certificate"));
  EXPECT_EQ(evidence.lines->division, 3);
  EXPECT_LT(std::abs(*evidence.zero_one), 0.2);
  EXPECT_TRUE(evidence.largest_exponent->negative());
}

MotionEvidence rotation_evidence(double turns) {
  return gather_evidence<2>(
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

TEST(Verdict, RotationIsQuasiPeriodicByAnIrrationalAngleAndPeriodicByARationalOne) {
  const MotionEvidence evidence = rotation_evidence(golden_mean);
  const Verdict verdict = judge(evidence);
  EXPECT_EQ(motion_kind_text(verdict), "quasi-periodic") << verdict.rests_on;
  EXPECT_FALSE(evidence.largest_exponent->positive() || evidence.largest_exponent->negative());
  EXPECT_EQ(motion_kind_text(judge(rotation_evidence(7.0 / 19.0))), "periodic(19)");
}

TEST(Verdict, AtTheFeigenbaumPointNothingIsClaimedThatIsNotSo) {
  // An exponent of zero, no period, and lines on the multiples of 1/2^k alone: neither periodic nor
  // chaotic nor quasi-periodic.
  const Verdict verdict = judge(logistic_evidence(3.569945671870945));
  EXPECT_EQ(verdict.kind, MotionKind::undecided) << verdict.rests_on;
  EXPECT_TRUE(names(verdict, "no repetition")) << verdict.rests_on;
}

MotionEvidence forced_linear_evidence(double turns, bool incommensurate) {
  EvidencePlan plan;
  plan.forcing_incommensurate = incommensurate;
  return gather_evidence<1>(
      Point1(0.0),
      [turns, n = 0](Point1& x) mutable {
        x[0] = 0.7 * x[0] + std::cos(2 * pi<double> * turns * ++n);
      },
      first_coordinate, plan, [](const Point1&) { return Slope1(0.7); });
}

TEST(Verdict, AStableLinearMapUnderIncommensurateForcingIsQuasiPeriodicInSpiteOfItsExponent) {
  const MotionEvidence evidence = forced_linear_evidence(golden_mean / 3, true);
  EXPECT_TRUE(evidence.largest_exponent->negative());
  const Verdict verdict = judge(evidence);
  EXPECT_EQ(motion_kind_text(verdict), "quasi-periodic") << verdict.rests_on;
  EXPECT_TRUE(names(verdict, "forcing"));
  EXPECT_EQ(motion_kind_text(judge(forced_linear_evidence(3.0 / 16.0, false))), "periodic(16)");
}

TEST(Verdict, TheLoopWithoutBacklashRepeatsAsSamplingAndForcingDo) {
  for (const double tau : {0.010, 0.011}) {
    EvidencePlan plan;
    plan.samples = 20000;  // whole periods of both
    LoopSystem system{{tau, 0.0}};
    const MotionEvidence evidence = system.evidence(plan);
    const Verdict verdict = judge(evidence);
    EXPECT_EQ(verdict.kind, MotionKind::periodic) << verdict.rests_on;
    EXPECT_EQ(verdict.period, samples_per_coincidence(10.0, tau)) << verdict.rests_on;
    EXPECT_EQ(evidence.switching->switches, 0U);
    EXPECT_EQ(evidence.lines->division, verdict.period);
  }
}

TEST(Verdict, TheLoopWithoutBacklashIsQuasiPeriodicWhereTheForcingNeverCoincides) {
  test::KollarCase which{0.010, 0.0};
  which.excitation.frequency = 10.0 * std::sqrt(1.1);
  EvidencePlan plan;
  plan.forcing_incommensurate = samples_per_coincidence(which.excitation.frequency, 0.010) == 0;
  LoopSystem system{which};
  const Verdict verdict = judge(system.evidence(plan));
  EXPECT_TRUE(plan.forcing_incommensurate);
  EXPECT_EQ(motion_kind_text(verdict), "quasi-periodic") << verdict.rests_on;
}

TEST(Verdict, MotionsWithBacklashThatRepeatAreFoundToRepeat) {
  // 0.1 s at 1 ms, 23.1 s at 11 ms; the second is irregular to the eye for as long.
  const struct {
    double tau, width;
    std::int64_t period;
  } known[] = {{0.001, 0.0005, 100}, {0.011, 0.002, 2100}};
  for (const auto& motion : known) {
    EvidencePlan plan;
    plan.transient = 40000;
    plan.samples = 21000;
    LoopSystem system{{motion.tau, motion.width}};
    const MotionEvidence evidence = system.evidence(plan);
    const Verdict verdict = judge(evidence);
    EXPECT_EQ(verdict.kind, MotionKind::periodic) << verdict.rests_on;
    EXPECT_EQ(verdict.period, motion.period) << verdict.rests_on;
    EXPECT_GT(evidence.switching->switches, 0U);
    EXPECT_FALSE(evidence.largest_exponent->positive());
  }
}

TEST(Verdict, APeriodLongerThanTheSearchIsCalledIrregularAndSaysHowFarWasLooked) {
  EvidencePlan plan;
  plan.transient = 40000;
  plan.samples = 5040;
  LoopSystem system{{0.011, 0.002}};
  const Verdict verdict = judge(system.evidence(plan));
  EXPECT_EQ(motion_kind_text(verdict), "irregular, exponent <= 0") << verdict.rests_on;
  EXPECT_TRUE(names(verdict, "within 840 samples")) << verdict.rests_on;
  EXPECT_TRUE(names(verdict, "bit per sample")) << verdict.rests_on;
}

TEST(Verdict, TheLoopThatWaitsAWholeSampleDiverges) {
  test::KollarCase which{0.011, 0.002};
  which.processing_delay = which.sampling_period;
  LoopSystem system{which};
  const MotionEvidence evidence = system.evidence({});
  EXPECT_EQ(motion_kind_text(judge(evidence)), "diverges");
  EXPECT_LT(*evidence.diverged_at, 1000);
}

TEST(Verdict, AMotionThatHasDecayedToRestHasPeriodOne) {
  const Verdict verdict = judge(gather_evidence<2>(
      Vector<double, 2>(1, -3), [](Vector<double, 2>& z) { z *= 0.99; },
      [](const Vector<double, 2>& z) { return z[0]; }));
  EXPECT_EQ(motion_kind_text(verdict), "periodic(1)") << verdict.rests_on;
}

/// A spiral that turns by 1.1 and stretches by `growth` a sample.
MotionEvidence spiral_evidence(double growth) {
  const double c = growth * std::cos(1.1), s = growth * std::sin(1.1);
  Matrix<double, 2> map;
  map << c, -s, s, c;
  return gather_evidence<2>(
      Vector<double, 2>(1, 0), [&map](Vector<double, 2>& z) { z = Vector<double, 2>(map * z); },
      [](const Vector<double, 2>& z) { return z[0]; }, {},
      [&map](const Vector<double, 2>&) { return map; });
}

TEST(Verdict, SlowDecayIsNotCalledIrregular) {
  const MotionEvidence evidence = spiral_evidence(0.99999);
  EXPECT_TRUE(evidence.largest_exponent->negative());
  EXPECT_EQ(judge(evidence).kind, MotionKind::undecided) << judge(evidence).rests_on;
}

TEST(Verdict, SlowGrowthIsNoChaos) {
  // 1.0005^20160 = 2 · 10⁴: far from any bound of the number type, a positive exponent throughout.
  const MotionEvidence evidence = spiral_evidence(1.0005);
  EXPECT_TRUE(evidence.largest_exponent->positive());
  const Verdict verdict = judge(evidence);
  EXPECT_EQ(verdict.kind, MotionKind::undecided);
  EXPECT_TRUE(names(verdict, "not steady")) << verdict.rests_on;
  EXPECT_EQ(judge(spiral_evidence(1.00001)).kind, MotionKind::undecided) << "K is low";
}

// ---- the rules ---------------------------------------------------------------------------------

MotionEvidence chaotic_evidence() {
  MotionEvidence evidence;
  evidence.largest_exponent = exponent_evidence(0.5, 0.01);
  evidence.zero_one = 0.99;
  evidence.repeat = RepeatEvidence{0, 3000, 1e-9};
  evidence.lines = SpectralEvidence{0, 0.999, 5000, 0.9};
  evidence.extent_growth = 1.0;
  return evidence;
}

MotionKind kind_of(const MotionEvidence& evidence) { return judge(evidence).kind; }

TEST(Judge, NothingKnownIsUndecided) {
  EXPECT_EQ(kind_of({}), MotionKind::undecided);
  EXPECT_FALSE(judge({}).rests_on.empty());
}

TEST(Judge, DivergenceComesBeforeACertificateAndACertificateBeforeEverythingElse) {
  MotionEvidence evidence = chaotic_evidence();
  evidence.certified_period = 2100;
  EXPECT_EQ(motion_kind_text(judge(evidence)), "periodic(2100)");
  EXPECT_TRUE(names(judge(evidence), "Certified"));
  evidence.diverged_at = 77;
  EXPECT_EQ(motion_kind_text(judge(evidence)), "diverges");
  EXPECT_TRUE(names(judge(evidence), "77"));
}

TEST(Judge, ChaosTakesAPositiveExponentAndAHighKThatNothingContradicts) {
  EXPECT_EQ(kind_of(chaotic_evidence()), MotionKind::chaotic);
  const auto spoiled = [](auto&& spoil) {
    MotionEvidence evidence = chaotic_evidence();
    spoil(evidence);
    return kind_of(evidence);
  };
  using Evidence = MotionEvidence;
  EXPECT_EQ(spoiled([](Evidence& e) { e.largest_exponent.reset(); }), MotionKind::undecided);
  EXPECT_EQ(spoiled([](Evidence& e) { e.largest_exponent->half_width = 0.6; }),
            MotionKind::undecided);
  EXPECT_EQ(spoiled([](Evidence& e) { e.zero_one.reset(); }), MotionKind::undecided);
  for (const double k : {0.0, 0.5, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(spoiled([k](Evidence& e) { e.zero_one = k; }), MotionKind::undecided) << k;
  EXPECT_EQ(spoiled([](Evidence& e) { e.lines->continuous = 0.0; }), MotionKind::undecided);
  EXPECT_EQ(spoiled([](Evidence& e) { e.lines->division = 4; }), MotionKind::undecided);
  EXPECT_EQ(spoiled([](Evidence& e) { e.extent_growth = 2.5; }), MotionKind::undecided);
  EXPECT_EQ(spoiled([](Evidence& e) { e.repeat->lag = 12; }), MotionKind::undecided)
      << "an unstable orbit, or round-off";
}

TEST(Judge, AZeroExponentNeedsALowKNoRepetitionAndLinesWithoutACommonBase) {
  MotionEvidence evidence = chaotic_evidence();
  evidence.largest_exponent = exponent_evidence(0.0, 0.0);
  evidence.zero_one = 0.02;
  evidence.lines = SpectralEvidence{0, 0.999, 6, 1e-6};
  EXPECT_EQ(kind_of(evidence), MotionKind::quasi_periodic);
  for (auto spoil :
       {+[](MotionEvidence& e) { e.zero_one = 0.9; }, +[](MotionEvidence& e) { e.repeat.reset(); },
        +[](MotionEvidence& e) { e.lines.reset(); },
        +[](MotionEvidence& e) { e.lines->division = 64; },
        +[](MotionEvidence& e) { e.lines->continuous = 0.1; }}) {
    MotionEvidence spoiled = evidence;
    spoil(spoiled);
    EXPECT_EQ(kind_of(spoiled), MotionKind::undecided);
  }
  evidence.repeat->lag = 12;
  EXPECT_EQ(motion_kind_text(judge(evidence)), "periodic(12)");
}

TEST(Judge, ANegativeExponentWithoutRepetitionIsIrregularUnlessTheForcingIsIncommensurate) {
  MotionEvidence evidence = chaotic_evidence();
  evidence.largest_exponent = exponent_evidence(-0.01, 0.001);
  EXPECT_EQ(motion_kind_text(judge(evidence)), "irregular, exponent <= 0");
  evidence.largest_exponent->value = -std::numeric_limits<double>::infinity();
  EXPECT_EQ(kind_of(evidence), MotionKind::irregular_contracting);
  evidence.forcing_incommensurate = true;
  EXPECT_EQ(kind_of(evidence), MotionKind::irregular_contracting) << "K is high";
  evidence.zero_one = 0.01;
  EXPECT_EQ(kind_of(evidence), MotionKind::irregular_contracting) << "a floor under the lines";
  evidence.lines->continuous = 1e-5;
  EXPECT_EQ(kind_of(evidence), MotionKind::quasi_periodic);
  evidence.forcing_incommensurate = false;
  EXPECT_EQ(kind_of(evidence), MotionKind::undecided) << "a regular series: a slow transient";
  evidence.zero_one = 0.99;
  EXPECT_EQ(kind_of(evidence), MotionKind::irregular_contracting);
  evidence.lines->division = 7;
  EXPECT_EQ(kind_of(evidence), MotionKind::undecided) << "a longer period";
  evidence.repeat.reset();
  EXPECT_EQ(kind_of(evidence), MotionKind::undecided);
}

TEST(Judge, EveryKindHasItsWords) {
  EXPECT_EQ(motion_kind_text(MotionKind::periodic, 12), "periodic(12)");
  EXPECT_EQ(motion_kind_text(MotionKind::undecided), "undecided");
  EXPECT_EQ(motion_kind_text(MotionKind::irregular_contracting), "irregular, exponent <= 0");
}

TEST(ExponentEvidence, IsNeverNarrowerThanTheRoundingOfLogarithms) {
  EXPECT_FALSE(exponent_evidence(5e-13, 0.0).positive());
  EXPECT_TRUE(exponent_evidence(5e-12, 0.0).positive());
  EXPECT_TRUE(exponent_evidence(-1.0, 0.4).negative());
  EXPECT_FALSE(exponent_evidence(-1.0, 0.6).negative());
  EXPECT_THROW(exponent_evidence(0.0, std::numeric_limits<double>::quiet_NaN()), InvalidParameter);
}

// ---- the gathering -----------------------------------------------------------------------------

TEST(GatherEvidence, KeepsQuietOnWhatItWasNotGiven) {
  EvidencePlan plan;
  plan.samples = 2000;
  plan.transient = 0;
  const MotionEvidence evidence = gather_evidence<1>(
      Point1(0.3), [](Point1& x) { x[0] = 4 * x[0] * (1 - x[0]); }, first_coordinate, plan);
  EXPECT_FALSE(evidence.largest_exponent);
  EXPECT_FALSE(evidence.switching);
  EXPECT_FALSE(evidence.certified_period);
  EXPECT_TRUE(evidence.zero_one && evidence.lines && evidence.repeat && evidence.recurrence);
  EXPECT_EQ(kind_of(evidence), MotionKind::undecided) << "K alone claims no chaos";
  EXPECT_GT(*evidence.zero_one, zero_one_high);
}

TEST(GatherEvidence, StopsAtTheFirstStateThatIsNoNumber) {
  std::int64_t steps = 0;
  const MotionEvidence evidence = gather_evidence<1>(
      Point1(2.0), [&steps](Point1& x) { ++steps, x[0] = 4 * x[0] * (1 - x[0]); },
      first_coordinate);
  EXPECT_EQ(*evidence.diverged_at, steps);
  EXPECT_LT(steps, 20);
}

TEST(GatherEvidence, WhatIsOutOfRangeIsRefused) {
  const auto gathers = [](double start, const EvidencePlan& plan) {
    return gather_evidence<1>(
        Point1(start), [](Point1& x) { x *= 0.5; }, first_coordinate, plan);
  };
  EvidencePlan few, stride;
  few.samples = 1999;
  stride.zero_one_stride = 41;
  EXPECT_THROW(gathers(1.0, few), InvalidParameter);
  EXPECT_THROW(gathers(1.0, stride), InvalidParameter);
  EXPECT_THROW(gathers(std::numeric_limits<double>::infinity(), {}), InvalidParameter);
}

// ---- 95 % intervals of the largest exponent ----------------------------------------------------

/// How many of 100 seeded repeats cover: `evidence(random)` gives the exponent, `truth` what is
/// known.
template <class Exponent>
int covered_of_hundred(double truth, std::uint64_t first_seed, Exponent exponent) {
  int covered = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    test::Random random(first_seed + seed);
    const ExponentEvidence found = exponent(random);
    if (std::abs(found.value - truth) <= found.half_width) ++covered;
  }
  return covered;
}

template <int Size>
ExponentEvidence largest_of_spectrum(const LyapunovSpectrum<double, Size>& spectrum) {
  return exponent_evidence(spectrum.exponents()[0], spectrum.standard_errors()[0]);
}

double entropy_of_split(double a) { return -a * std::log(a) - (1 - a) * std::log(1 - a); }

TEST(ExponentInterval, CoversLogTwoOfTheLogisticMap) {
  const int covered = covered_of_hundred(std::log(2.0), 5000, [](test::Random& random) {
    LyapunovSpectrum<double, 1> spectrum;
    double x = random.uniform(0.01, 0.99);
    for (int n = 0; n < 10000; ++n) {
      spectrum.push(Slope1(4 - 8 * x), 1);
      x = 4 * x * (1 - x);
    }
    return largest_of_spectrum(spectrum);
  });
  EXPECT_GE(covered, 90);
}

TEST(ExponentInterval, CoversTheEntropyOfTheSkewTentMap) {
  const double a = 0.3;
  const int covered = covered_of_hundred(entropy_of_split(a), 5200, [a](test::Random& random) {
    LyapunovSpectrum<double, 1> spectrum;
    double x = random.uniform(0.01, 0.99);
    for (int n = 0; n < 10000; ++n) {
      spectrum.push(Slope1(x < a ? 1 / a : 1 / (a - 1)), 1);
      x = x < a ? x / a : (1 - x) / (1 - a);
    }
    return largest_of_spectrum(spectrum);
  });
  EXPECT_GE(covered, 90);
  EXPECT_LT(covered, 100) << "an interval far too wide would be no measure";
}

TEST(ExponentInterval, CoversTheEntropyOfTheBakersMap) {
  const double a = 0.4;
  const int covered = covered_of_hundred(entropy_of_split(a), 5400, [a](test::Random& random) {
    LyapunovSpectrum<double, 2> spectrum;
    double y = random.uniform(0.01, 0.99);
    for (int n = 0; n < 10000; ++n) {
      const double stretch = y < a ? 1 / a : 1 / (1 - a);
      spectrum.push(Vector<double, 2>(stretch, y < a ? 0.2 : 0.3).asDiagonal().toDenseMatrix(), 2);
      y = y < a ? y / a : (y - a) / (1 - a);
    }
    return largest_of_spectrum(spectrum);
  });
  EXPECT_GE(covered, 90);
  EXPECT_LT(covered, 100);
}

TEST(ExponentInterval, CoversTheExponentsOfProductsOfGaussianMatrices) {
  // λ₁ = ½ (ln 2 + ψ(1)) for 2 × 2 matrices of independent standard normals (C. M. Newman, Commun.
  // Math. Phys. 103, 1986).
  const double truth = 0.5 * (std::log(2.0) - euler_gamma);
  const int covered = covered_of_hundred(truth, 5600, [](test::Random& random) {
    LyapunovSpectrum<double, 2> spectrum;
    for (int n = 0; n < 3000; ++n) {
      Matrix<double, 2> map;
      for (double& entry : map.reshaped()) entry = random.normal();
      spectrum.push(map, 2);
    }
    return largest_of_spectrum(spectrum);
  });
  EXPECT_GE(covered, 90);
  EXPECT_LT(covered, 100);
}

TEST(ExponentInterval, CoversTheLargestModulusOfAStableLoop) {
  // The batch means are nearly constant; what remains is the turning of the basis, bounded in its
  // sum, and round-off.
  constexpr std::int64_t steps = 5000;
  int covered = 0, stable = 0, sharp = 0;
  for (std::uint64_t seed = 5800; stable < 100; ++seed) {
    test::Random random(seed);
    const auto plant = test::random_plant(random);
    const auto sampling = test::random_sampling(plant, random);
    const auto gains = test::random_gains(plant, sampling.period, random);
    const Matrix<double, 5> map = sampled_loop(plant, sampling).engaged_map(gains);
    const double truth = std::log(map.eigenvalues().cwiseAbs().maxCoeff());
    if (!(truth < 0.0)) continue;
    ++stable;
    SettledExponent<5> exponent(steps);
    for (int n = 0; n < 5000; ++n) exponent.settle(map);
    for (int n = 0; n < steps; ++n) exponent.push(map);
    const ExponentEvidence found = exponent.evidence();
    if (std::abs(found.value - truth) <= found.half_width) ++covered;
    if (found.half_width < 20.0 / steps) ++sharp;
  }
  EXPECT_GE(covered, 90);
  EXPECT_GE(sharp, 90) << "and not by being wide";
}

}  // namespace
}  // namespace holdfast
