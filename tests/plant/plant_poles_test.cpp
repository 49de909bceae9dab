// Poles of a conductor with its absorber one by one, against eigenvalues of the plant's matrix and
// the closed transfer function.

#include "holdfast/plant/plant_poles.hpp"

#include <Eigen/Eigenvalues>

#include "holdfast/cable/taut_string.hpp"
#include "support/random.hpp"
#include "support/string_case.hpp"
#include "support/testing.hpp"

namespace holdfast::test {
namespace {

using Complex = std::complex<double>;

/// Σ r/(s − s_k) against T_a H/(1 + H K), to a share of it.
double misfit(const std::vector<PlantPole>& poles, const std::vector<PlaceMode<double>>& modes,
              const Absorber<double>& absorber, const Complex& s) {
  Complex sum(0);
  for (const PlantPole& pole : poles) sum += pole.residue / (s - pole.s);
  const Complex expected = place_response(receptance(modes, s), absorber, s).to_drive;
  return std::abs(sum - expected) / std::abs(expected);
}

TEST(PlantPoles, OfThePapersStringMakeItsTransferFunction) {
  for (const int count : {1, 7, 40, 200, 400}) {
    for (const double clamp_mass : {0.0, 0.01}) {
      const auto modes = string_modes(taut_string(kollar2022_conductor()), 0.64, count);
      const Absorber<double> absorber = papers_absorber(clamp_mass);
      const auto poles = plant_poles(modes, absorber);
      ASSERT_EQ(poles.size(), 2U * static_cast<std::size_t>(count) + 2U) << clamp_mass;
      for (const double omega : {0.3, 6.0, 20.0, 61.0, 500.0, 3000.0})
        EXPECT_LT(misfit(poles, modes, absorber, {0.1, omega}), 1e-7) << count << ' ' << omega;
    }
  }
}

/// Modes at any distances, with nodes, absorbers from hardly to more than critically damped.
TEST(PlantPoles, AreTheEigenvaluesOfRandomPlants) {
  Random random(20251125);
  int found = 0;
  constexpr int plants = 400;
  for (int k = 0; k < plants; ++k) {
    // Of a third of them some modes are overdamped.
    const std::vector<PlaceMode<double>> modes = random_modes(random, k % 3 == 0 ? 20.0 : 0.5);
    const double own = random.uniform(0.5, 1.5) * modes[modes.size() / 2].angular_frequency;
    const double mass = random.log_uniform(0.01, 1.0);
    const Absorber<double> absorber{mass, mass * own * own,
                                    2.0 * random.log_uniform(1e-3, 1.6) * mass * own,
                                    k % 2 == 0 ? 0.0 : random.uniform(0.0, 0.1)};
    const auto poles = plant_poles(modes, absorber);
    if (poles.empty()) continue;
    ++found;
    const Eigen::VectorXcd expected = modal_plant(modes, absorber).state_matrix().eigenvalues();
    for (const Complex& value : expected) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const PlantPole& pole : poles) nearest = std::min(nearest, std::abs(pole.s - value));
      EXPECT_LT(nearest, 1e-6 * std::abs(value)) << k;
    }
  }
  EXPECT_GT(found, plants * 95 / 100);
}

/// A critically damped absorber has a double pole to begin at, and says so by nothing.
TEST(PlantPoles, AreNoneWhereTheyAreNotAllFound) {
  const std::vector<PlaceMode<double>> modes = {{3.0, 0.01, 1.0, 1.0}, {3.0, 0.01, 1.0, 1.0}};
  EXPECT_TRUE(plant_poles(modes, {0.1, 0.9, 0.1, 0.0}).empty());
}

TEST(PlantPoles, RefuseWhatIsNotAdmissible) {
  EXPECT_THROW(plant_poles({}, {0.1, 1.0, 0.1}), InvalidParameter);
  EXPECT_THROW(plant_poles({{1.0, 0.1, 1.0, 1.0}}, {0.0, 1.0, 0.1}), InvalidParameter);
}

}  // namespace
}  // namespace holdfast::test
