// The string without ends: its triangle of stable gains in closed form, its receptance.

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/plant/plant_poles.hpp"
#include "holdfast/stability/boundary/resolved_circle.hpp"
#include "support/message_of.hpp"
#include "support/testing.hpp"

namespace holdfast::test {
namespace {

constexpr double impedance = 0.67;

/// The force straight on the string.
ResolvedCircle<double> circle(double clamp_mass, double period) {
  const PlaceMode<double> mode = infinite_string_mode(impedance, clamp_mass, period);
  const auto [s, partner] = holdfast::detail::PoleFinder::bare(mode);
  const std::complex<double> residue = mode.shape * mode.shape / (mode.mass * (s - partner));
  const std::vector<PlantPole> poles = {{s, residue}, {partner, -residue}};
  return ResolvedCircle<double>(modal_response(poles, {period}));
}

/// λ² − (1 + (Pτ + D)/(2 Z_c)) λ + D/(2 Z_c) = 0: stable inside (0, −2Z_c), (0, 2Z_c), (−8Z_c/τ,
/// 2Z_c).
TEST(InfiniteString, StableGainsFormATriangle) {
  constexpr double twice = 2.0 * impedance;
  for (const double period : {1e-3, 0.02}) {
    const ResolvedCircle<double> string = circle(0.0, period);
    for (const double share : {0.01, 0.3, 0.7, 0.99}) {
      const double p = -8.0 * impedance / period * share;
      const auto stable = string.stable_gains(FreeGain::differential, {p, 0.0});
      ASSERT_EQ(stable.size(), 1U) << p;
      EXPECT_NEAR(stable[0].lower, -twice - p * period / 2.0, 1e-12 * twice);
      EXPECT_NEAR(stable[0].upper, twice, 1e-12 * twice);
    }
    EXPECT_TRUE(
        string.stable_gains(FreeGain::differential, {-8.1 * impedance / period, 0.0}).empty());
    EXPECT_TRUE(string.stable_gains(FreeGain::differential, {0.01 / period, 0.0}).empty());
  }
}

/// With a clamp mass and P = 0, C = c₂ + 2Z_c: −C coth(Cτ/(2M)) < D < C. A heavy absorber without
/// spring is a wall for the dashpot.
TEST(InfiniteString, AClampMassWidensThem) {
  const double damping = 4.0, c = damping + 2.0 * impedance, period = 1e-3;
  for (const double mass : {1e-4, 0.002, 0.01}) {
    const std::vector<PlaceMode<double>> modes = {infinite_string_mode(impedance, mass, period)};
    const auto poles = plant_poles(modes, {1e9, 1e-6, damping, 0.0});
    ASSERT_FALSE(poles.empty());
    const ResolvedCircle<double> string(modal_response(poles, {period}));
    const auto stable = string.stable_gains(FreeGain::differential, {0.0, 0.0});
    ASSERT_FALSE(stable.empty());
    EXPECT_NEAR(stable[0].lower, -c / std::tanh(c * period / (2.0 * mass)), 1e-7 * c) << mass;
    EXPECT_NEAR(stable[0].upper, c, 1e-7 * c) << mass;
  }
}

TEST(InfiniteString, ItsReceptanceIsThatOfTwoWaves) {
  const std::vector<PlaceMode<double>> modes = {infinite_string_mode(impedance, 0.003, 1e-3)};
  for (const double omega : {1.0, 60.0, 3000.0}) {
    const std::complex<double> s(0.0, omega);
    const auto expected = 1.0 / (2.0 * impedance * s + 0.003 * s * s);
    EXPECT_LT(std::abs(receptance(modes, s) / expected - 1.0), 1e-8) << omega;
  }
}

TEST(InfiniteString, RefusesWhatIsNone) {
  const auto message = [](double of_string, double clamp_mass, double period) {
    return tests::message_of<InvalidParameter>(
        [&] { infinite_string_mode(of_string, clamp_mass, period); });
  };
  EXPECT_NE(message(0.0, 0.0, 1e-3).find("wave impedance"), std::string::npos);
  EXPECT_NE(message(1.0, -1.0, 1e-3).find("clamp mass"), std::string::npos);
  EXPECT_NE(message(1.0, 0.0, 0.0).find("sampling period"), std::string::npos);
}

}  // namespace
}  // namespace holdfast::test
