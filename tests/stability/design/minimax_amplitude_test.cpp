#include "holdfast/stability/design/minimax_amplitude.hpp"

#include "support/testing.hpp"

namespace holdfast {
namespace {

struct BandCase {
  TwoMass<double> plant;
  AmplitudeOptions options;
  double proportional_gain;
  FrequencyBand band;
};

/// Lightly damped, so that the amplitude has narrow peaks over the frequency.
TwoMass<double> light_plant() {
  TwoMass<double> plant = kollar2022_plant();
  plant.absorber_damping = 0.1;
  return plant;
}

/// The last one is lightly damped.
std::vector<BandCase> band_cases() {
  const TwoMass<double> plant = kollar2022_plant();
  return {
      {plant, {Sampling<double>{0.001}, ForceHold::sampled, 1.0}, -557.0, {9.0, 11.0}},
      {plant, {Sampling<double>{0.010}, ForceHold::exact, 0.995}, -557.0, {8.0, 12.0}},
      {plant, {Sampling<double>{0.005, 0.0025}, ForceHold::sampled, 0.995}, -200.0, {1.0, 20.0}},
      {plant, {Sampling<double>{0.002}, ForceHold::sampled, 1.0}, 0.0, {0.5, 10.0}},
      {plant, {Sampling<double>{0.020}, ForceHold::sampled, 1.0}, -10.0, {1.0, 25.0}},
      {light_plant(), {Sampling<double>{0.02}, ForceHold::exact}, -20.0, {1.0, 20.0}}};
}

/// The ratio at one D and frequency, from the loop's own response.
double ratio_of(const SampledLoop<double>& loop, const BandCase& c, double frequency, double d) {
  const double omega = 2.0 * pi<double> * frequency;
  const auto input = harmonic_input(c.plant, loop, c.options.hold, omega);
  return SteadyResponse<double>(loop, input, omega).ratio_to_uncontrolled({c.proportional_gain, d});
}

TEST(AmplitudeBand, FindsTheWorstFrequencyOfADenseScan) {
  for (const BandCase& c : band_cases()) {
    const bool is_light = c.plant.absorber_damping < 1.0;
    const auto loop = sampled_loop(c.plant, c.options.sampling);
    const AmplitudeBand band(PlantOverBand<TwoMass<double>>{c.plant, c.options}, c.band);
    for (const double d : is_light ? std::vector<double>{-1.0, 0.3, 1.0, 2.0}
                                   : std::vector<double>{-13.0, -5.0, 1.0}) {
      const WorstFrequency worst = band.worst({c.proportional_gain, d});
      double scanned = 0.0;
      for (int k = 0; k <= 20000; ++k) {
        const double f = c.band.lower + (c.band.upper - c.band.lower) * k / 20000.0;
        scanned = std::max(scanned, ratio_of(loop, c, f, d));
      }
      EXPECT_GE(worst.ratio, scanned * (1.0 - 1e-9)) << d;
      EXPECT_LE(worst.ratio, scanned * (1.0 + (is_light ? 1e-2 : 1e-3))) << d;
      EXPECT_NEAR(ratio_of(loop, c, worst.frequency, d), worst.ratio, 1e-9 * worst.ratio);
      EXPECT_TRUE(worst.frequency >= c.band.lower && worst.frequency <= c.band.upper);
    }
  }
}

TEST(MinimaxAmplitude, OfALightlyDampedPlantHasItsBoundsInOrder) {
  const AmplitudeOptions options{Sampling<double>{0.02}, ForceHold::exact};
  const auto answer = minimax_amplitude(light_plant(), options, -20.0, {1.0, 20.0});
  EXPECT_EQ(answer.outcome, MinimaxOutcome::found);
  EXPECT_NEAR(answer.worst_ratio, answer.lower_bound, 1e-7 * answer.lower_bound);
}

TEST(MinimaxAmplitude, NoGainOfADenseScanIsBetter) {
  for (const BandCase& c : band_cases()) {
    if (c.plant.absorber_damping < 1.0) continue;
    const auto answer = minimax_amplitude(c.plant, c.options, c.proportional_gain, c.band);
    ASSERT_EQ(answer.outcome, MinimaxOutcome::found);
    EXPECT_LE(answer.lower_bound, answer.worst_ratio);
    EXPECT_GE(answer.lower_bound, answer.worst_ratio * (1.0 - 1e-8));
    EXPECT_NEAR(std::pow(10.0, -answer.attenuation / 20.0), answer.worst_ratio, 1e-9);
    const auto loop = sampled_loop(c.plant, c.options.sampling);
    double scanned = std::numeric_limits<double>::infinity();
    for (double d = -60.0; d <= 60.0; d += 0.2) {
      const PdGains<double> gains{c.proportional_gain, d};
      if (!(spectral_radius<double, 5>(loop.engaged_map(gains)) < c.options.largest_radius))
        continue;
      double worst = 0.0;
      for (int k = 0; k <= 500 && worst < scanned; ++k) {
        const double f = c.band.lower + (c.band.upper - c.band.lower) * k / 500.0;
        worst = std::max(worst, ratio_of(loop, c, f, d));
      }
      scanned = std::min(scanned, worst);
    }
    EXPECT_LE(answer.worst_ratio, scanned * (1.0 + 1e-3)) << "the scan's peaks are too low";
    EXPECT_GE(answer.worst_ratio, scanned * 0.9) << "and so is its step of D";
  }
}

TEST(MinimaxAmplitude, OfANarrowBandIsThatOfItsFrequency) {
  const AmplitudeOptions options{Sampling<double>{0.01}, ForceHold::sampled, 0.995};
  const auto narrow =
      minimax_amplitude(kollar2022_plant(), options, -557.0, {10.0 - 1e-9, 10.0 + 1e-9});
  const auto single = minimum_amplitude(kollar2022_plant(), options, 10.0, -557.0);
  EXPECT_NEAR(narrow.worst_ratio, single.ratio_to_uncontrolled, 1e-7);
  EXPECT_NEAR(narrow.differential_gain, single.differential_gain, 1e-5);
}

TEST(MinimaxAmplitude, SaysWhereNoGainIsAdmissible) {
  const auto answer =
      minimax_amplitude(kollar2022_plant(), {Sampling<double>{0.05}}, -557.0, {5.0, 9.0});
  EXPECT_EQ(answer.outcome, MinimaxOutcome::none);
  EXPECT_TRUE(std::isnan(answer.differential_gain));
}

TEST(MinimaxAmplitude, RefusesWhatIsNoBand) {
  const auto plant = kollar2022_plant();
  const AmplitudeOptions options{Sampling<double>{0.01}};
  for (const FrequencyBand& band :
       {FrequencyBand{0.0, 1.0}, {2.0, 2.0}, {3.0, 2.0}, {1.0, 50.1}, {NAN, 2.0}}) {
    EXPECT_THROW(minimax_amplitude(plant, options, -557.0, band), InvalidParameter);
  }
}

}  // namespace
}  // namespace holdfast
