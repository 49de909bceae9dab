#include "holdfast/stability/design/minimum_amplitude.hpp"
#include "holdfast/stability/design/minimum_radius.hpp"

#include "support/lagging_plant.hpp"
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

TEST(AnyOrderAmplitude, OfTwoMassesIsThatOfTheClosedForms) {
  const TwoMass<double> plant = kollar2022_plant();
  for (const double largest_radius : {1.0, 0.995}) {
    const AmplitudeOptions options{{0.002, 0.001}, ForceHold::exact, largest_radius};
    for (const double frequency : {8.0, 10.0}) {
      const double p = tuned_proportional_gain(74.4, 0.16, frequency);
      const MinimumAmplitude closed = minimum_amplitude(plant, options, frequency, p);
      const MinimumAmplitude general =
          minimum_amplitude(test::through_ports(plant), options, frequency, p);
      EXPECT_EQ(general.outcome, closed.outcome);
      if (closed.outcome == MinimumAmplitudeOutcome::none) continue;
      EXPECT_NEAR(general.differential_gain, closed.differential_gain,
                  1e-7 * std::abs(closed.differential_gain));
      EXPECT_NEAR(general.ratio_to_uncontrolled, closed.ratio_to_uncontrolled,
                  1e-7 * closed.ratio_to_uncontrolled);
    }
  }
}

TEST(AnyOrderAmplitude, OfSevenStatesIsTheLeastOfAScan) {
  const auto plant = test::lagging_plant(100.0, 150.0);
  const AmplitudeOptions options{{0.002, 0.001}, ForceHold::sampled, 1.0};
  const MinimumAmplitude least = minimum_amplitude(plant, options, 9.0, -50.0);
  ASSERT_NE(least.outcome, MinimumAmplitudeOutcome::none);
  const LoopMap<double> map = loop_map(plant, options.sampling);
  const auto response =
      steady_response(plant, options.sampling, options.hold, 2.0 * pi<double> * 9.0);
  double scanned = 1e300;
  for (double d = -8.0; d < 8.0; d += 0.01) {
    if (spectral_radius(map.closed_map({-50.0, d})) >= 1.0) continue;
    scanned = std::min(scanned, response.ratio_to_uncontrolled({-50.0, d}));
  }
  EXPECT_LE(least.ratio_to_uncontrolled, scanned * (1.0 + 1e-12));
  EXPECT_GT(least.ratio_to_uncontrolled, 0.98 * scanned);
}

TEST(AnyOrderRadius, OfSevenStatesIsTheLeastOfAScan) {
  const auto plant = test::lagging_plant(100.0, 150.0);
  for (const double delay : {0.001, 0.005}) {
    const LoopMap<double> map = loop_map(plant, {0.002, delay});
    const MinimumRadius least = minimum_radius(map, -50.0);
    double scanned = 1e300;
    for (double d = -10.0; d < 10.0; d += 0.005)
      scanned = std::min(scanned, spectral_radius(map.closed_map({-50.0, d})));
    EXPECT_LE(least.radius, scanned + 1e-9);
    EXPECT_GT(least.radius, scanned - 1e-4);
    EXPECT_NEAR(spectral_radius(map.closed_map({-50.0, least.differential_gain})), least.radius,
                1e-7);
  }
}

}  // namespace
}  // namespace holdfast
