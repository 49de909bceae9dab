#include "holdfast/stability/design/minimum_amplitude.hpp"

#include "support/testing.hpp"

namespace holdfast {
namespace {

/// Against a dense scan over D by eigenvalues and by the response of each loop.
TEST(MinimumAmplitude, IsNoWorseThanADenseScan) {
  const auto plant = kollar2022_plant();
  for (const Sampling<double>& sampling :
       {Sampling<double>{0.001, 0.0}, {0.01, 0.0}, {0.01, 0.01}}) {
    const auto loop = sampled_loop(plant, sampling);
    for (const double frequency : {6.0, 10.0, 15.0}) {
      for (const double largest_radius : {1.0, 0.99}) {
        const double p = tuned_proportional_gain(74.4, 0.16, frequency);
        const AmplitudeOptions options{sampling, ForceHold::sampled, largest_radius};
        const MinimumAmplitude answer = minimum_amplitude(plant, options, frequency, p);
        const SteadyResponse<double> response(loop, held_harmonic(loop),
                                              2.0 * pi<double> * frequency);
        double least = std::numeric_limits<double>::infinity();
        for (int step = 0; step <= 8000; ++step) {
          const double d = -200.0 + step * 0.03;
          if (!(spectral_radius<double, 5>(loop.engaged_map({p, d})) < largest_radius)) continue;
          least = std::min(least, response.ratio_to_uncontrolled({p, d}));
        }
        if (answer.outcome == MinimumAmplitudeOutcome::none) {
          EXPECT_TRUE(std::isinf(least)) << "no D of the scan is admissible";
          EXPECT_TRUE(std::isnan(answer.differential_gain));
          continue;
        }
        EXPECT_LE(answer.ratio_to_uncontrolled, least + 1e-9);
        EXPECT_NEAR(answer.ratio_to_uncontrolled, least, 0.05 * least);
        const PdGains<double> gains{p, answer.differential_gain};
        EXPECT_NEAR(response.ratio_to_uncontrolled(gains), answer.ratio_to_uncontrolled, 1e-12);
        EXPECT_NEAR(std::pow(10.0, -answer.attenuation / 20.0), answer.ratio_to_uncontrolled,
                    1e-12);
        const double radius = spectral_radius<double, 5>(loop.engaged_map(gains));
        EXPECT_LE(radius, largest_radius + 1e-9);
        EXPECT_EQ(answer.outcome == MinimumAmplitudeOutcome::edge, radius > largest_radius - 1e-9);
      }
    }
  }
}

/// Half the way to the boundary, along D and in the rate of decay, at any P that can be stabilised.
TEST(MinimumAmplitude, WithAMarginKeepsAwayFromTheBoundary) {
  const auto plant = kollar2022_plant();
  for (const Sampling<double>& sampling : {Sampling<double>{0.001}, {0.01}, {0.01, 0.005}}) {
    for (const double frequency : {5.0, 10.0, 15.0, 20.0}) {
      const auto loop = sampled_loop(plant, sampling);
      const double p = tuned_proportional_gain(74.4, 0.16, frequency);
      const auto answer =
          minimum_amplitude(plant, {sampling, ForceHold::sampled, 1.0, 0.5}, frequency, p);
      const auto radius = [&](double d) {
        return spectral_radius<double, 5>(loop.engaged_map({p, d}));
      };
      const MinimumRadius fastest = minimum_radius(loop, p);
      if (!(fastest.radius < 1.0)) {
        EXPECT_EQ(answer.outcome, MinimumAmplitudeOutcome::none);
        continue;
      }
      const double d = answer.differential_gain, away = d - fastest.differential_gain;
      EXPECT_LE(std::log(radius(d)), 0.5 * std::log(fastest.radius) * (1.0 - 1e-6));
      for (int k = 1; k < 40; ++k) EXPECT_LT(radius(d + away * k / 40.001), 1.0) << d << ' ' << k;
    }
  }
}

TEST(MinimumAmplitude, SaysWhereTheSamplesDoNotShowTheVibration) {
  for (const double frequency : {50.0, 100.0, 123.0}) {
    const auto answer =
        minimum_amplitude(kollar2022_plant(), {Sampling<double>{0.01}}, frequency, -557.0);
    EXPECT_EQ(answer.outcome, MinimumAmplitudeOutcome::aliased);
    EXPECT_TRUE(std::isnan(answer.differential_gain));
    EXPECT_TRUE(std::isnan(answer.ratio_to_uncontrolled));
  }
}

TEST(MinimumAmplitude, RefusesWhatIsNoQuestion) {
  const auto plant = kollar2022_plant();
  const AmplitudeOptions options{Sampling<double>{0.001}};
  EXPECT_THROW(minimum_amplitude(plant, options, 0.0, -557.0), InvalidParameter);
  EXPECT_THROW(minimum_amplitude(plant, options, 10.0, INFINITY), InvalidParameter);
  EXPECT_THROW(minimum_amplitude(plant, {Sampling<double>{0.0}}, 10.0, -557.0), InvalidParameter);
  AmplitudeOptions no_radius = options;
  no_radius.largest_radius = 0.0;
  EXPECT_THROW(minimum_amplitude(plant, no_radius, 10.0, -557.0), InvalidParameter);
  AmplitudeOptions divergent = options;
  divergent.largest_radius = 1.1;
  EXPECT_THROW(minimum_amplitude(plant, divergent, 10.0, -557.0), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
