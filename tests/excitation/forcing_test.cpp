#include "holdfast/excitation/forcing.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/excitation/phasor_table.hpp"

#include "support/kollar_case.hpp"
#include "support/random.hpp"
#include "support/reference/sample_excitation.hpp"

namespace holdfast {
namespace {

TEST(Excitation, ItsAngularFrequencyIsThatOfAFullTurnPerCycle) {
  EXPECT_DOUBLE_EQ((HarmonicExcitation<double>{1.0, 10.0}.angular_frequency()),
                   20.0 * std::acos(-1.0));
}

TEST(UnitPhasor, IsTheCosineAndTheSine) {
  test::Random random(911);
  for (int k = 0; k < 100'000; ++k) {
    const double x = k < 100 ? k / 99.0 : random.unit();
    const auto turn = unit_phasor(x);
    const long double angle = 2.0L * pi<long double> * static_cast<long double>(x);
    ASSERT_NEAR(turn.cosine, static_cast<double>(std::cos(angle)), 3e-16) << x;
    ASSERT_NEAR(turn.sine, static_cast<double>(std::sin(angle)), 3e-16) << x;
  }
}

TEST(UnitPhasor, IsExactAtQuarters) {
  const double cosines[] = {1.0, 0.0, -1.0, 0.0, 1.0}, sines[] = {0.0, 1.0, 0.0, -1.0, 0.0};
  for (int quarter = 0; quarter <= 4; ++quarter) {
    const auto turn = unit_phasor(0.25 * quarter);
    EXPECT_EQ(turn.cosine, cosines[quarter]);
    EXPECT_EQ(turn.sine, sines[quarter]);
  }
}

TEST(PhasorTable, RoundsThePhaseOfALateSampleOnceOnly) {
  const test::KollarCase which;
  const auto input = held_harmonic(which.loop());
  const double frequency = 7.3, period = 0.0031;
  PhasorTable<double> table(input, {1.0, frequency}, period);
  for (const std::int64_t late : {16'000'000LL, 999'999'984LL, 999'999'990'000LL}) {
    const std::int64_t index = late / 16 * 16;
    table.turn_to(index);
    const auto expected = sample_excitation<double>({1.0, frequency}, period, index);
    EXPECT_NEAR(table.addition(0)[1] / input.cosine[1], expected.cosine, 2e-15) << index;
  }
}

using test::KollarCase;

HarmonicInput<double> input_of(const KollarCase& which, ForceHold hold) {
  return harmonic_input(kollar2022_plant(), which.loop(), hold,
                        which.excitation.angular_frequency());
}

constexpr ForceHold both_holds[] = {ForceHold::sampled, ForceHold::exact};

TEST(HarmonicForcing, IsTheDirectFormulaAtEverySample) {
  for (const ForceHold hold : both_holds) {
    KollarCase which;
    which.sampling_period = 0.0031;
    which.excitation.frequency = 7.3;
    const auto input = input_of(which, hold);
    const double size = 0.5 * (input.cosine.norm() + input.sine.norm());
    HarmonicForcing<double> forcing(input, which.excitation, which.sampling_period);
    for (std::int64_t j = 0; j < 100'000; ++j) {
      const auto sample = sample_excitation(which.excitation, which.sampling_period, j);
      const Vector<double, 4> expected = input.cosine * sample.cosine + input.sine * sample.sine;
      // The phase of sample j is rounded to some 1e-16 of its number of turns.
      const double rounding = 1e-14 + 4e-15 * 0.0031 * 7.3 * static_cast<double>(j);
      ASSERT_LE((forcing.next() - expected).norm(), rounding * size) << j;
    }
  }
}

TEST(PhasorForcing, GivesWhatTheHarmonicOneDoesToTheLastBit) {
  test::Random random(912);
  for (const ForceHold hold : both_holds) {
    for (int k = 0; k < 20; ++k) {
      KollarCase which;
      which.sampling_period = random.log_uniform(1e-4, 0.1);
      which.excitation = {2.0, random.log_uniform(0.1, 100.0)};
      const auto input = input_of(which, hold);
      HarmonicForcing<double> harmonic(input, which.excitation, which.sampling_period);
      PhasorTable<double> table(input, which.excitation, which.sampling_period);
      PhasorForcing<double> turning(table);
      for (int j = 0; j < 5000; ++j) {
        if (j % 16 == 0) table.turn_to(j);
        ASSERT_EQ(harmonic.next(), turning.next()) << j;
      }
    }
  }
}

TEST(PeriodicForcing, IsTheHarmonicOneAndRepeatsExactly) {
  for (const ForceHold hold : both_holds) {
    KollarCase which;
    which.sampling_period = 0.011;
    const auto input = input_of(which, hold);
    PeriodicForcing<double> periodic(input, which.excitation.amplitude, {11, 100});
    HarmonicForcing<double> harmonic(input, which.excitation, which.sampling_period);
    ASSERT_EQ(periodic.samples(), 100U);
    const double size = 0.5 * (input.cosine.norm() + input.sine.norm());
    for (std::size_t j = 0; j < 100'000; ++j) {
      ASSERT_EQ(periodic.phase(), j % 100);
      const Vector<double, 4> addition = periodic.next();
      ASSERT_EQ(addition, periodic.additions()[j % 100]);
      ASSERT_LE((addition - harmonic.next()).norm(), 1e-9 * size) << j;
    }
  }
}

TEST(PeriodicForcing, AddsUpToNothingOverACommonPeriod) {
  const KollarCase which;
  const PeriodicForcing<double> forcing(input_of(which, ForceHold::exact), 0.5, {3, 17});
  Vector<double, 4> sum = Vector<double, 4>::Zero();
  double size = 0.0;
  for (const auto& addition : forcing.additions()) sum += addition, size += addition.norm();
  EXPECT_LE(sum.norm(), 1e-15 * size);
}

TEST(PeriodicForcing, CopiesGoOnAlone) {
  PeriodicForcing<double> forcing({Vector<double, 4>(1, 0, 0, 0), Vector<double, 4>(2, 0, 0, 0)});
  forcing.next();
  PeriodicForcing<double> copy = forcing;
  EXPECT_EQ(copy.next()[0], 2.0);
  EXPECT_EQ(copy.next()[0], 1.0);
  EXPECT_EQ(forcing.next()[0], 2.0);
  EXPECT_EQ(&copy.additions(), &forcing.additions()) << "one table";
}

}  // namespace
}  // namespace holdfast
