#include <cmath>
#include <limits>

#include "holdfast/span/life/clamp_bending.hpp"
#include "holdfast/span/life/miner_damage.hpp"
#include "holdfast/span/life/safe_border_line.hpp"
#include "span/drake_span.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(ClampBending, OfDrakeIs36MegapascalAMillimetre) {
  EXPECT_NEAR(drake_clamp().stress_of_bending_amplitude(1e-3) / 1e6, 36.01, 5e-3);
}

// The beam itself, integrated: T y″ = EI y⁗ with y = y′ = 0 at the clamp.
TEST(ClampBending, IsThatOfTheBeamUnderTension) {
  const ClampBending clamp = drake_clamp();
  const double p = clamp.decay(), angle = 1e-3, step = 1e-5;
  const auto y = [&](double x) { return angle * (x - (1.0 - std::exp(-p * x)) / p); };
  const double curvature = (y(2.0 * step) - 2.0 * y(step) + y(0.0)) / (step * step);
  EXPECT_NEAR(0.5 * clamp.outer_wire_diameter * curvature / clamp.strain_of_angle(angle), 1.0,
              1e-3);
}

TEST(SafeBorderLine, GivesItsStressesTheirCycles) {
  EXPECT_NEAR(several_layers.cycles(450e6 * std::pow(1e6, -0.20)) / 1e6, 1.0, 1e-12);
  EXPECT_NEAR(several_layers.cycles(263e6 * std::pow(1e9, -0.17)) / 1e9, 1.0, 1e-12);
  EXPECT_NEAR(single_layer.cycles(430e6 * std::pow(1e8, -0.17)) / 1e8, 1.0, 1e-12);
  EXPECT_EQ(several_layers.cycles(0.0), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(several_layers.cycles(-1.0)));
}

TEST(SafeBorderLine, AllowsFewerCyclesOfMoreStress) {
  for (const SafeBorderLine& line : {several_layers, single_layer}) {
    const double steep_begins =
        1e6 * line.steep_stress * std::pow(line.change_of_slope, -line.steep_exponent);
    double before = std::numeric_limits<double>::infinity(), stress_before = 0.0;
    for (double stress = 2e6; stress < 100e6; stress *= 1.003) {
      const double cycles = line.cycles(stress);
      // Where the steep line begins its life is longer than the flat one's, which was taken before.
      const bool steps = stress_before < steep_begins && stress >= steep_begins;
      if (!steps) {
        EXPECT_LT(cycles, before) << stress;
      }
      before = cycles;
      stress_before = stress;
    }
  }
}

TEST(SafeBorderLine, TakesTheShorterLifeBetweenItsParts) {
  EXPECT_NEAR(several_layers.cycles(16e6), std::pow(16.0 / 263.0, -1.0 / 0.17), 1e-3);
  EXPECT_NEAR(several_layers.cycles(15.7e6), std::pow(15.7 / 263.0, -1.0 / 0.17), 1e-3);
  EXPECT_NEAR(several_layers.cycles(16.5e6), std::pow(16.5 / 450.0, -1.0 / 0.20), 1e-3);
}

TEST(MinerDamage, AddsShares) {
  const double stress = 20e6, allowed = several_layers.cycles(stress);
  EXPECT_NEAR(
      miner_damage({{stress, 0.25 * allowed}, {stress, 0.5 * allowed}, {0.0, 1e9}}, several_layers),
      0.75, 1e-12);
}

TEST(WeibullHours, AddUpToTheYearAndKeepTheMean) {
  const auto rows = weibull_hours(5.0, 2.0, 0.0, 60.0, 6000);
  double hours = 0.0, distance = 0.0;
  for (const WindHours& row : rows) {
    hours += row.hours;
    distance += row.hours * row.speed;
  }
  EXPECT_NEAR(hours, 8766.0, 1e-6);
  EXPECT_NEAR(distance / hours, 5.0 * std::tgamma(1.5), 1e-4);
  EXPECT_THROW(weibull_hours(0.0, 2.0, 0.0, 60.0, 10), InvalidParameter);
  EXPECT_THROW(weibull_hours(5.0, 2.0, 9.0, 6.0, 10), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
