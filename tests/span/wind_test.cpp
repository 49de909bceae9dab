#include <cmath>

#include "holdfast/span/wind/energy_balance.hpp"
#include "holdfast/span/wind/self_damping_law.hpp"
#include "holdfast/span/wind/wind_power_law.hpp"
#include "span/drake_span.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

double balance(std::size_t wind, std::size_t damping, double frequency) {
  const StrandedConductor drake = drake_strand();
  const BalancedAmplitude found = balanced_amplitude(
      wind_power_laws[wind], frequency, drake.diameter,
      [&](double y) { return self_damping_laws[damping].power(drake, frequency, y); });
  return found.range == BalanceRange::within ? found.amplitude / drake.diameter : 0.0;
}

TEST(WindPowerLaw, FitsItsPrintedCurve) {
  EXPECT_NEAR(wind_power_laws[0].at(0.1), 1.669, 5e-4);
  EXPECT_NEAR(wind_power_laws[0].at(0.3), 8.566, 5e-4);
  EXPECT_NEAR(wind_power_laws[1].at(0.1), 1.070, 5e-4);
  EXPECT_NEAR(wind_power_laws[1].at(0.3), 5.315, 5e-4);
  EXPECT_TRUE(std::isnan(wind_power_laws[1].at(0.41)));
  EXPECT_TRUE(std::isnan(wind_power_laws[0].at(0.009)));
}

// In W/m the conductor would be damped more than critically.
TEST(SelfDampingLaw, IsInMilliwattsAMetre) {
  const StrandedConductor drake = drake_strand();
  const double y = 0.1 * drake.diameter;
  EXPECT_NEAR(self_damping_laws[0].power(drake, 20.0, y), 14.5e-3, 0.1e-3);
  EXPECT_NEAR(self_damping_laws[0].power(drake, 30.0, y), 142e-3, 1e-3);
  EXPECT_NEAR(self_damping_laws[0].power(drake, 50.0, y), 2515e-3, 15e-3);
  const double omega = turn_of(21.3);
  const double ratio = self_damping_laws[0].power(drake, 21.3, y) /
                       damped_power(drake.mass_per_length, 1.0, omega, y);
  EXPECT_LT(ratio, 2e-3);
  EXPECT_GT(1e3 * ratio, 1.0);
}

TEST(EnergyBalance, OfBareDrake) {
  struct Row {
    double frequency;
    std::array<double, 3> diana, brika;  // 0: below the law
  };
  const std::array<Row, 5> rows = {Row{15.0, {.125, .304, .117}, {.075, .202, .072}},
                                   Row{20.0, {.054, .152, .051}, {.030, .096, .029}},
                                   Row{25.0, {.028, .088, .027}, {.016, .050, .016}},
                                   Row{30.0, {.017, .055, .016}, {.010, .030, .010}},
                                   Row{40.0, {.0, .026, .0}, {.0, .015, .0}}};
  for (const Row& row : rows)
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(balance(0, k, row.frequency), row.diana[k], 6e-4) << row.frequency << " " << k;
      // Where the balance is at the law's end, which side of it is a matter of digits.
      if (row.brika[k] < 0.011) continue;
      EXPECT_NEAR(balance(1, k, row.frequency), row.brika[k], 6e-4) << row.frequency << " " << k;
    }
}

TEST(EnergyBalance, SaysWhereTheLawEnds) {
  const WindPowerLaw& law = wind_power_laws[0];
  const auto lossless = balanced_amplitude(law, 10.0, 0.03, [](double) { return 0.0; });
  EXPECT_EQ(lossless.range, law.at(law.highest) > 0.0 ? BalanceRange::above : BalanceRange::within);
  const auto dead = balanced_amplitude(law, 10.0, 0.03, [](double y) { return 1e9 * y * y; });
  EXPECT_EQ(dead.range, BalanceRange::below);
  EXPECT_EQ(dead.amplitude, law.lowest * 0.03);
}

// (0.85 d)/d is above 0.85 for some diameters.
TEST(EnergyBalance, KnowsTheEndsOfItsLawForEveryDiameter) {
  for (double diameter = 0.004; diameter < 0.05; diameter += 1.7e-5)
    for (const WindPowerLaw& law : wind_power_laws) {
      const auto free = balanced_amplitude(law, 10.0, diameter, [](double) { return 0.0; });
      EXPECT_EQ(free.range, BalanceRange::above) << diameter;
    }
  const auto unknown =
      balanced_amplitude(wind_power_laws[0], 10.0, 0.03, [](double) { return std::nan(""); });
  EXPECT_TRUE(std::isnan(unknown.amplitude));
}

// What is found loses exactly what it is given.
TEST(EnergyBalance, Balances) {
  const StrandedConductor drake = drake_strand();
  for (const double frequency : {8.0, 12.0, 18.0, 26.0}) {
    const auto loss = [&](double y) { return self_damping_laws[2].power(drake, frequency, y); };
    const auto found = balanced_amplitude(wind_power_laws[0], frequency, drake.diameter, loss);
    if (found.range != BalanceRange::within) continue;
    const double given = wind_power_laws[0].power(frequency, drake.diameter, found.amplitude);
    EXPECT_NEAR(loss(found.amplitude) / given, 1.0, 1e-9);
  }
}

}  // namespace
}  // namespace holdfast
