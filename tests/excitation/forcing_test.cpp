#include "holdfast/excitation/forcing.hpp"

#include "support/kollar_case.hpp"
#include "support/random.hpp"
#include "support/reference/sample_excitation.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

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

TEST(PeriodicForcing, HalfACommonPeriodOfAnEvenNumberTurnsTheSign) {
  const KollarCase which;
  const PeriodicForcing<double> forcing(input_of(which, ForceHold::sampled), 0.5, {11, 100});
  const auto& additions = forcing.additions();
  for (std::size_t j = 0; j < 50; ++j)
    EXPECT_LE((additions[j] + additions[j + 50]).norm(), 1e-15 * additions[0].norm());
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
