// Kollár 2022, Table 1: the plant, its poles and natural frequencies, and Eq. (6) for it.

#include "holdfast/control/gains.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "support/dense_routes.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

/// Poles in the upper half-plane, fastest decay first.
std::vector<std::complex<double>> upper_poles(const TwoMass<double>& plant) {
  std::vector<std::complex<double>> poles;
  for (const auto& pole : test::eigenvalues_of(plant.state_matrix())) {
    if (pole.imag() > 0) poles.push_back(pole);
  }
  std::sort(poles.begin(), poles.end(), [](auto a, auto b) { return a.real() < b.real(); });
  return poles;
}

TEST(Table1, HasTheStatedPoles) {
  const auto poles = upper_poles(kollar2022_plant());
  ASSERT_EQ(poles.size(), 2U);
  EXPECT_NEAR(poles[0].real(), -38.0078, 0.00005);
  EXPECT_NEAR(poles[0].imag(), 18.3331, 0.00005);
  EXPECT_NEAR(poles[1].real(), -1.08277, 0.000005);
  EXPECT_NEAR(poles[1].imag(), 13.0415, 0.00005);
}

TEST(Table1, HasTheNaturalFrequenciesThatItWasReducedFrom) {
  auto undamped = kollar2022_plant();
  undamped.conductor_damping = undamped.absorber_damping = 0.0;
  const auto poles = upper_poles(undamped);
  ASSERT_EQ(poles.size(), 2U);
  std::vector<double> frequencies = {poles[0].imag() / (2 * pi<double>),
                                     poles[1].imag() / (2 * pi<double>)};
  std::sort(frequencies.begin(), frequencies.end());
  EXPECT_NEAR(frequencies[0], 1.999, 0.0005);
  EXPECT_NEAR(frequencies[1], 6.998, 0.0005);
}

TEST(Table1, TheConductorAloneVibratesAtTheFrequencyOfFigure5) {
  const auto plant = kollar2022_plant();
  EXPECT_NEAR(std::sqrt(plant.conductor_stiffness / plant.conductor_mass) / (2 * pi<double>), 4.1,
              0.05);
}

TEST(Equation6, TunesTheProportionalGainToTheExcitation) {
  const auto plant = kollar2022_plant();
  const double gain = tuned_proportional_gain(plant.absorber_stiffness, plant.absorber_mass, 10.0);
  EXPECT_NEAR(gain, -557.25, 0.005);
  EXPECT_NEAR(gain, -557.0, 0.5) << "as the paper rounds it";
}

}  // namespace
}  // namespace holdfast
