#include "holdfast/plant/free_decay.hpp"
#include "holdfast/plant/natural_modes.hpp"
#include "holdfast/plant/two_mass.hpp"

#include "support/testing.hpp"

namespace holdfast {
namespace {

constexpr double start = 3.758e-3;

TwoMass<double> table_plant(double absorber_damping) {
  TwoMass<double> plant = kollar2022_plant();
  plant.absorber_damping = absorber_damping;
  return plant;
}

/// The plant of two masses that never part: one mass on k₁, c₁, whose decay is known.
TwoMass<double> locked_plant() { return {0.1, 40.0, 0.5, 0.15, 1e7, 1e3}; }

TEST(FreeDecay, OfLockedMassesIsThatOfOneMass) {
  const TwoMass<double> plant = locked_plant();
  const double mass = plant.conductor_mass + plant.absorber_mass;
  const double decay = plant.conductor_damping / (2.0 * mass);
  const double omega = std::sqrt(plant.conductor_stiffness / mass - decay * decay);
  for (const double t : {0.1, 0.37, 1.9}) {
    const double expected =
        std::exp(-decay * t) * (std::cos(omega * t) + decay / omega * std::sin(omega * t));
    EXPECT_NEAR(free_decay_at(plant, 1.0, t)[0], expected, 1e-5);
  }
}

TEST(FreeDecay, SatisfiesTheEquationOfMotion) {
  const TwoMass<double> plant = kollar2022_plant();
  const double step = 1e-5;
  for (const double t : {0.05, 0.3, 1.2}) {
    const auto before = free_decay_at(plant, 1.0, t - step);
    const auto now = free_decay_at(plant, 1.0, t);
    const auto after = free_decay_at(plant, 1.0, t + step);
    const Vector<double, 4> rate = (after - before) / (2.0 * step);
    EXPECT_LE((rate - plant.state_matrix() * now).norm(), 1e-4 * rate.norm());
  }
}

TEST(FreeDecay, DoesNotDependOnTheInstantsBetween) {
  const auto even = free_decay(kollar2022_plant(), start, {0.0, 0.1, 0.2, 0.3, 0.4});
  const auto uneven = free_decay(kollar2022_plant(), start, {0.0, 0.05, 0.2, 0.21, 0.4});
  EXPECT_NEAR(even[2], uneven[2], 1e-14);
  EXPECT_NEAR(even[4], uneven[4], 1e-14);
}

TEST(RelativeDecay, AgreesWithTheMeasuresOfASampledRecord) {
  for (const double damping : {1.0, 2.0, 4.0, 8.0}) {
    const TwoMass<double> plant = table_plant(damping);
    DecayRecord record;
    for (int k = 0; k <= 30000; ++k) record.times.push_back(k * 1e-4);
    record.displacements = free_decay(plant, start, record.times);
    const DecayMeasures sampled = decay_measures(record);
    const auto exact = relative_decay(plant, free_decay_events(plant));
    ASSERT_TRUE(exact.has_value());
    EXPECT_NEAR(exact->first_peak * start, sampled.first_peak, 1e-7 * start);
    EXPECT_NEAR(exact->first_peak_time, sampled.first_peak_time, 1e-6);
    EXPECT_NEAR(exact->period, sampled.period, 1e-6);
    EXPECT_NEAR(exact->logarithmic_decrement, sampled.logarithmic_decrement, 1e-5);
  }
}

TEST(RelativeDecay, OfAnOverdampedPlantIsNone) {
  TwoMass<double> plant = kollar2022_plant();
  plant.conductor_damping = 100.0;
  EXPECT_FALSE(relative_decay(plant, free_decay_events(plant)).has_value());
}

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
