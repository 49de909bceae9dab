#include "holdfast/stability/design.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "holdfast/control/gains.hpp"
#include "holdfast/stability/spectral_radius.hpp"

namespace holdfast {
namespace {

/// Against a dense scan over D by eigenvalues and by the response of each loop.
TEST(Design, IsNoWorseThanADenseScan) {
  const auto plant = kollar2022_plant();
  for (const Sampling<double>& sampling :
       {Sampling<double>{0.001, 0.0}, {0.01, 0.0}, {0.01, 0.01}}) {
    for (const double frequency : {6.0, 10.0, 15.0}) {
      const double p = tuned_proportional_gain(74.4, 0.16, frequency);
      const Design answer = design(plant, sampling, {frequency, p});
      const auto loop = sampled_loop(plant, sampling);
      const double omega = 2.0 * pi<double> * frequency;
      const SteadyResponse<double> response(loop, held_harmonic(loop), omega);
      double least_radius = 1e9, least_ratio = 1e9;
      for (int step = 0; step <= 8000; ++step) {
        const double d = -200.0 + step * 0.03;
        const double radius = spectral_radius<double, 5>(loop.engaged_map({p, d}));
        least_radius = std::min(least_radius, radius);
        if (radius < 1.0)
          least_ratio = std::min(least_ratio, response.ratio_to_uncontrolled({p, d}));
      }
      EXPECT_LE(answer.least_radius, least_radius + 1e-12);
      EXPECT_NEAR(answer.least_radius, least_radius, 2e-3);
      const PdGains<double> fastest{p, answer.least_radius_gain};
      EXPECT_NEAR((spectral_radius<double, 5>(loop.engaged_map(fastest))), answer.least_radius,
                  1e-7);
      if (std::isnan(answer.least_amplitude_gain)) {
        EXPECT_EQ(least_ratio, 1e9) << "no D of the scan stabilises";
        continue;
      }
      EXPECT_LE(answer.ratio_to_uncontrolled, least_ratio + 1e-9);
      EXPECT_NEAR(answer.ratio_to_uncontrolled, least_ratio, 0.05 * least_ratio);
      EXPECT_NEAR(std::pow(10.0, -answer.attenuation / 20.0), answer.ratio_to_uncontrolled, 1e-12);
    }
  }
}

TEST(Design, RefusesWhatIsNoQuestion) {
  const auto plant = kollar2022_plant();
  EXPECT_THROW(design(plant, {0.001}, {0.0, -557.0}), InvalidParameter);
  EXPECT_THROW(design(plant, {0.001}, {10.0, INFINITY}), InvalidParameter);
  EXPECT_THROW(design(plant, {0.0}, {10.0, -557.0}), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
