#include "holdfast/sundials/load_removal.hpp"

#include "holdfast/cable/statics.hpp"
#include "support/reference/cable_energy.hpp"
#include "support/reference/condensed_cable.hpp"
#include "support/testing.hpp"

namespace holdfast::cvode {
namespace {

const RayleighDamping two_per_cent = rayleigh_damping(0.02, 2.0, 7.0);

const HangingAbsorber weight_alone{AbsorberReading::weight, 0.16};

CableElements kollar_cable(const HangingAbsorber& absorber, int elements,
                           const RayleighDamping& damping = two_per_cent) {
  return {kollar2022_conductor(), 0.64, elements, absorber, damping};
}

CondensedCable<> condensed_kollar() { return {kollar2022_conductor(), 0.64, 0.16, two_per_cent}; }

struct StatedDecay {
  double first_peak, first_peak_time, period, decrement;
};

/// Within 1 %, the first peak by its share of the initial displacement.
void expect_decay(const LoadRemoval& found, const StatedDecay& stated) {
  ASSERT_EQ(found.outcome, LoadRemovalOutcome::completed) << found.words;
  const auto measures = decay_measures(found.record);
  EXPECT_NEAR(-measures.first_peak / found.initial_displacement / stated.first_peak, 1.0, 0.01);
  EXPECT_NEAR(measures.period / stated.period, 1.0, 0.01);
  EXPECT_NEAR(measures.logarithmic_decrement, stated.decrement, 0.01 * stated.decrement);
  EXPECT_NEAR(measures.first_peak_time / stated.first_peak_time, 1.0, 0.01);
}

TEST(LoadRemoval, TheWeightWithoutInertiaDecaysAsStated) {
  const auto found = load_removal(kollar_cable(weight_alone, 100), 0.2, 1.4, 0.001);
  EXPECT_NEAR(found.initial_displacement, 0.003758, 1e-3 * 0.003758);
  expect_decay(found, {.690, .220, .472, .208});
}

TEST(LoadRemoval, TheRigidMassDecaysAsStated) {
  expect_decay(
      load_removal(kollar_cable({AbsorberReading::rigid_mass, 0.16}, 100), 0.2, 1.6, 0.001),
      {.866, .292, .573, .120});
}

TEST(LoadRemoval, TheCondensedCableDecaysAsStated) {
  const auto found = load_removal(condensed_kollar(), 0.2, 1.4, 0.001);
  const auto measures = decay_measures(found.record);
  EXPECT_NEAR(-measures.first_peak / found.initial_displacement / .698, 1.0, 0.01);
  EXPECT_NEAR(measures.period / .468, 1.0, 0.01);
  EXPECT_NEAR(measures.logarithmic_decrement / .199, 1.0, 0.01);
}

TEST(LoadRemoval, FortyElementsAreEnoughForTheFirstPeak) {
  const auto ratio = [](int elements) {
    const auto found = load_removal(kollar_cable(weight_alone, elements), 0.2, 0.5, 0.001);
    return decay_measures(found.record).first_peak / found.initial_displacement;
  };
  EXPECT_NEAR(ratio(40) / ratio(100), 1.0, 0.01);
}

TEST(LoadRemoval, TheRecordStartsUnderTheForceAndHasEveryInstant) {
  const auto cable = kollar_cable(weight_alone, 10);
  const auto found = load_removal(cable, 0.2, 0.3, 0.1);
  ASSERT_EQ(found.outcome, LoadRemovalOutcome::completed);
  ASSERT_EQ(found.record.times.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(found.record.times[k], 0.1 * static_cast<double>(k), 1e-15);
  EXPECT_EQ(found.last_time, found.record.times.back());
  EXPECT_EQ(found.record.displacements.front(), found.initial_displacement);
  EXPECT_EQ(found.initial_displacement, cable.displacement(cable.held_by(0.2).state));
  EXPECT_EQ(load_removal(cable, 0.2, 0.25, 0.1).record.times.size(), 3U);
  EXPECT_GT(found.cost.steps, 0);
}

TEST(LoadRemoval, TheInitialDisplacementIsThatOfTheStatics) {
  const double exact = exact_statics(kollar2022_conductor(), 0.64, 0.16).displacement(0.2);
  const auto found = load_removal(kollar_cable(weight_alone, 100), 0.2, 0.001, 0.001);
  EXPECT_NEAR(found.initial_displacement / exact, 1.0, 1e-3);
}

TEST(LoadRemoval, TheUndampedCableKeepsItsEnergyOverTenPeriods) {
  for (const auto& absorber : {weight_alone, HangingAbsorber{AbsorberReading::rigid_mass, 0.16}}) {
    const auto cable = kollar_cable(absorber, 10, {0.0, 0.0});
    const auto start = cable.held_by(0.2);
    const double initial = test::energy_of(cable, absorber, start.state);
    const double vibration = 0.5 * 0.2 * cable.displacement(start.state);
    EXPECT_NEAR((initial - test::energy_of(cable, absorber, cable.held_by(0.0).state)) / vibration,
                1.0, 0.05);
    Integrator<CableElements> integrator(cable, start.state, {});
    for (int k = 1; k <= 100; ++k) {
      ASSERT_EQ(integrator.advance_to(0.06 * k), IntegrationOutcome::completed);
      const Eigen::Map<const Eigen::VectorXd> state(integrator.state(), cable.states());
      EXPECT_NEAR(test::energy_of(cable, absorber, state), initial, 1e-4 * vibration) << k;
    }
  }
}

/// Largest difference of two records of the same instants.
double records_apart(const DecayRecord& a, const DecayRecord& b, double factor = 1.0) {
  double apart = 0.0;
  for (std::size_t k = 0; k < a.times.size(); ++k)
    apart = std::fmax(apart, std::abs(factor * a.displacements[k] - b.displacements[k]));
  return apart;
}

TEST(LoadRemoval, UnderTinyForcesTheMotionScalesWithTheForce) {
  const Tolerances fine{1e-9, 1e-13};
  for (const auto reading :
       {AbsorberReading::weight, AbsorberReading::rigid_mass, AbsorberReading::spring_mass}) {
    const auto cable = kollar_cable({reading, 0.16, 74.4, 4.0}, 10);
    const auto once = load_removal(cable, 1e-4, 1.0, 0.01, fine);
    const auto twice = load_removal(cable, 2e-4, 1.0, 0.01, fine);
    const auto back = load_removal(cable, -1e-4, 1.0, 0.01, fine);
    const double size = once.initial_displacement;
    EXPECT_LT(records_apart(once.record, twice.record, 2.0), 1e-3 * size);
    EXPECT_LT(records_apart(once.record, back.record, -1.0), 1e-3 * size);
    EXPECT_NEAR(back.initial_displacement / size, -1.0, 1e-3);
  }
}

TEST(LoadRemoval, AMassOnAStiffSpringIsARigidOneWhereItsNodeMovesUpAndDownOnly) {
  // At mid-span, as the spring has no inertia sideways; without α, which damps the rigid mass with
  // the cable but not the one on the spring.
  const auto conductor = kollar2022_conductor();
  const RayleighDamping by_stiffness{0.0, two_per_cent.stiffness_factor};
  const auto record_of = [&](const HangingAbsorber& absorber) {
    const CableElements cable(conductor, conductor.span / 2, 10, absorber, by_stiffness);
    const auto found = load_removal(cable, 0.2, 1.0, 0.01);
    EXPECT_EQ(found.outcome, LoadRemovalOutcome::completed) << found.words;
    return found.record;
  };
  const auto rigid = record_of({AbsorberReading::rigid_mass, 0.16});
  const auto apart = [&](double stiffness) {
    return records_apart(rigid, record_of({AbsorberReading::spring_mass, 0.16, stiffness, 0.0})) /
           rigid.displacements[0];
  };
  EXPECT_LT(apart(1e6), 1e-3);
  EXPECT_LT(apart(1e5), 0.2 * apart(1e4));
}

TEST(LoadRemoval, ACableThatLosesItsTensionEndsTheRecordThere) {
  const auto expect_slack = [](const auto& cable, double force) {
    const auto found = load_removal(cable, force, 1.0, 0.001);
    EXPECT_EQ(found.outcome, LoadRemovalOutcome::slack) << force;
    EXPECT_LT(found.last_time, 0.1) << force;
    ASSERT_FALSE(found.record.times.empty()) << force;
    EXPECT_GE(found.last_time, found.record.times.back()) << force;
    EXPECT_LT(found.last_time, found.record.times.back() + 0.001) << force;
    // Whatever the instants that are asked for, the cable goes slack at the same one.
    for (const double interval : {0.2, 0.05, 0.0103})
      EXPECT_NEAR(load_removal(cable, force, 1.0, interval).last_time, found.last_time, 1e-5);
    EXPECT_TRUE(found.words.empty()) << found.words;
  };
  for (const double force : {-20.0, 20.0}) {
    expect_slack(kollar_cable(weight_alone, 20), force);
    expect_slack(condensed_kollar(), force);
  }
}

TEST(LoadRemoval, AnIntegrationThatFailsEndsTheRecordInCvodesWords) {
  Tolerances few;
  few.largest_number_of_steps = 20;
  const auto found = load_removal(kollar_cable(weight_alone, 10), 0.2, 1.0, 0.1, few);
  EXPECT_EQ(found.outcome, LoadRemovalOutcome::integration_failed);
  EXPECT_NE(found.words.find("CV_TOO_MUCH_WORK"), std::string::npos) << found.words;
  EXPECT_GT(found.last_time, 0.0);
  EXPECT_LT(found.last_time, 0.1);
  EXPECT_EQ(found.record.times.size(), 1U);
}

TEST(LoadRemoval, BadInputIsRefused) {
  const auto cable = kollar_cable(weight_alone, 10);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(load_removal(cable, nan, 1.0, 0.1), InvalidParameter);
  for (const double bad : {0.0, -1.0, nan}) {
    EXPECT_THROW(load_removal(cable, 0.2, bad, 0.1), InvalidParameter);
    EXPECT_THROW(load_removal(cable, 0.2, 1.0, bad), InvalidParameter);
  }
  // More instants than whole numbers of a double.
  EXPECT_THROW(load_removal(cable, 0.2, 1e10, 1e-10), InvalidParameter);
}

}  // namespace
}  // namespace holdfast::cvode
