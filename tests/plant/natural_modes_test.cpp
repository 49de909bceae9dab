#include "holdfast/plant/natural_modes.hpp"

#include "holdfast/plant/two_mass.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

/// m1 = m2 = 1 kg, k1 = k2 = 1 N/m.
TwoMass<double> equal_masses(double conductor_damping, double absorber_damping) {
  return {1.0, 1.0, conductor_damping, 1.0, 1.0, absorber_damping};
}

TEST(NaturalModes, OfTwoEqualMassesAreThoseOfTheGoldenRatio) {
  const auto modes = natural_modes(equal_masses(0.0, 0.0));
  ASSERT_EQ(modes.size(), 2U);
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  EXPECT_NEAR(2.0 * pi<double> * modes[0].frequency(), 1.0 / golden, 1e-15);
  EXPECT_NEAR(2.0 * pi<double> * modes[1].frequency(), golden, 1e-15);
  EXPECT_NEAR(modes[0].damping_ratio(), 0.0, 1e-15);
}

TEST(NaturalModes, OfStiffnessProportionalDampingHaveRatiosThatGrowWithTheFrequency) {
  const double factor = 0.02;  // C = 0.02 s · K
  const auto modes = natural_modes(equal_masses(factor, factor));
  ASSERT_EQ(modes.size(), 2U);
  for (const NaturalMode& mode : modes)
    EXPECT_NEAR(mode.damping_ratio(), factor * pi<double> * mode.frequency(), 1e-15);
}

TEST(NaturalModes, LeaveOutWhatDoesNotOscillate) {
  EXPECT_EQ(natural_modes(equal_masses(0.0, 100.0)).size(), 1U);
  EXPECT_TRUE(natural_modes(equal_masses(100.0, 100.0)).empty());
}

}  // namespace
}  // namespace holdfast
