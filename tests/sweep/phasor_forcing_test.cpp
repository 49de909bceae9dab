#include "holdfast/sweep/phasor_forcing.hpp"
#include "holdfast/plant/two_mass.hpp"

#include <gtest/gtest.h>

#include "holdfast/excitation/forcing.hpp"
#include "support/kollar_case.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

TEST(TurningForcing, GivesWhatTheHarmonicOneDoesToTheLastBit) {
  test::Random random(912);
  for (const ForceHold hold : {ForceHold::sampled, ForceHold::exact}) {
    for (int k = 0; k < 20; ++k) {
      test::KollarCase which;
      which.sampling_period = random.log_uniform(1e-4, 0.1);
      const HarmonicExcitation<double> excitation{2.0, random.log_uniform(0.1, 100.0)};
      const auto input =
          harmonic_input(kollar2022_plant(), which.loop(), hold, excitation.angular_frequency());
      HarmonicForcing<double> harmonic(input, excitation, which.sampling_period);
      TurningTable<double> table(input, excitation, which.sampling_period);
      TurningForcing<double> turning(table);
      for (int j = 0; j < 5000; ++j) {
        if (j % 16 == 0) table.turn_to(j);
        ASSERT_EQ(harmonic.next(), turning.next()) << j;
      }
    }
  }
}

}  // namespace
}  // namespace holdfast
