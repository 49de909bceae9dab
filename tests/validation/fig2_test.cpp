// Kollár 2022, Eqs. (1)–(3), Fig. 2 and Table 1: the statics, the modes and the reduction of the
// conductor, in the numbers of the paper and of the model description.

#include "holdfast/cable/chain_modes.hpp"
#include "holdfast/cable/statics.hpp"
#include "holdfast/control/zero_order_hold.hpp"
#include "holdfast/math/signal/decay_measures.hpp"
#include "holdfast/plant/reduction.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

constexpr double millimetre = 1e-3, per_mille = 1e-3;

struct StaticsRow {
  double force;         // N
  double exact;         // mm
  double equation_one;  // mm
};

const StaticsRow statics_rows[] = {{0.2, 3.759, 3.845},
                                   {0.4, 7.087, 7.242},
                                   {-0.4, -9.093, -9.333},
                                   {1.0, 15.03, 15.32},
                                   {-1.0, -28.04, -28.86}};

auto kollar_exact() { return exact_statics(kollar2022_conductor(), 0.64, 0.16); }
auto kollar_equation_one() { return irvine_statics(kollar2022_conductor(), 0.64, 0.16); }

void expect_within(double found, double stated, double relative) {
  EXPECT_NEAR(found, stated, relative * std::abs(stated));
}

TEST(Figure2, TheConductorIsPracticallyInextensible) {
  const auto conductor = kollar2022_conductor();
  EXPECT_NEAR(conductor.parabolic_tension(), 7.4475, 0.00005);
  EXPECT_NEAR(kollar_exact().model().cable().bare_tension(), 7.467, 0.0005);
  EXPECT_NEAR(conductor.irvine_parameter(), 1719.0, 0.5);
  EXPECT_NEAR(0.16 * conductor.gravity, 1.57, 0.005);
  EXPECT_NEAR(conductor.weight(), 2.70, 0.005);
}

TEST(Figure2, TheEquilibriumWithTheAbsorberIsTheStatedOne) {
  expect_within(kollar_exact().tension(0.0), 10.431, per_mille);
  expect_within(kollar_equation_one().tension(0.0), 10.484, per_mille);
  expect_within(kollar_exact().resting_displacement(), 54.42 * millimetre, per_mille);
  expect_within(kollar_equation_one().resting_displacement(), 56.00 * millimetre, per_mille);
  expect_within(kollar_exact().stiffness(0.0), 50.05, per_mille);
  expect_within(kollar_equation_one().stiffness(0.0), 48.87, per_mille);
}

TEST(Figure2, DisplacementsUnderTheForcesAreTheStatedOnes) {
  for (const auto& row : statics_rows) {
    expect_within(kollar_exact().displacement(row.force), row.exact * millimetre, per_mille);
    expect_within(kollar_equation_one().displacement(row.force), row.equation_one * millimetre,
                  per_mille);
  }
  EXPECT_NEAR(kollar_exact().displacement(0.2), 3.76 * millimetre, 0.005 * millimetre);
}

TEST(Figure2, TheLinearSpringIsATenthOffAtAThirdOfANewton) {
  const double spring = 50.3;
  for (const double force : {0.33, -0.31}) {
    const auto discrepancy = [&](double f) {
      return std::abs(f / spring / kollar_exact().displacement(f) - 1.0);
    };
    EXPECT_LT(discrepancy(force * (1 - 0.005 / 0.31)), 0.1) << force;
    EXPECT_GT(discrepancy(force * (1 + 0.005 / 0.31)), 0.1) << force;
  }
}

struct Spread {
  double lowest, highest;
};

/// k₁ by the tangent, the secant and the nearest line over "about 7–8 mm below and above".
template <class Statics>
Spread readings_of(const Statics& statics) {
  Spread spread{1e9, 0.0};
  for (const auto reading :
       {StiffnessReading::tangent, StiffnessReading::secant, StiffnessReading::least_squares}) {
    for (const ReadingRange& range : {ReadingRange{0.007, 0.007}, {0.008, 0.008}, {0.008, 0.007}}) {
      const double stiffness = conductor_stiffness(statics, reading, range);
      spread.lowest = std::fmin(spread.lowest, stiffness);
      spread.highest = std::fmax(spread.highest, stiffness);
    }
  }
  return spread;
}

TEST(Figure2, ThePapersStiffnessLiesAmongTheReadings) {
  const double nearest = conductor_stiffness(kollar_equation_one(), StiffnessReading::least_squares,
                                             {8 * millimetre, 7 * millimetre});
  expect_within(nearest, 50.17, per_mille);
  const auto equation_one = readings_of(kollar_equation_one());
  const auto exact = readings_of(kollar_exact());
  EXPECT_NEAR(equation_one.lowest, 48.9, 0.05);
  EXPECT_NEAR(equation_one.highest, 50.5, 0.05);
  expect_within(exact.lowest, 50.05, per_mille);  // the tangent
  EXPECT_NEAR(exact.highest, 51.7, 0.05);
  EXPECT_LT(exact.lowest, 50.3) << "the paper's k1";
  EXPECT_GT(equation_one.highest, 50.3) << "the paper's k1";
}

TEST(Figure2, TheModesAreTheStatedOnes) {
  const double irvine[] = {2.056, 2.934, 4.113, 5.043, 6.169, 7.114};
  const double elements[] = {2.038, 2.928, 4.100, 5.036, 6.158, 7.108};
  const auto conductor = kollar2022_conductor();
  const auto theory = irvine_modes(conductor, 6);
  const auto chain = elements_modes(conductor, 200, 6);
  ASSERT_EQ(chain.outcome, EquilibriumOutcome::converged);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_NEAR(theory[k].frequency, irvine[k], 0.0005) << k;
    expect_within(chain.modes[k].frequency, elements[k], per_mille);
    EXPECT_EQ(theory[k].family, chain.modes[k].family) << k;
  }
}

TEST(Table1, IsTheSmallerRootOfTheReductionFromItsOwnFrequencies) {
  const auto result = reduce_to_frequencies({50.3, 0.16, 1.999, 6.998});
  ASSERT_EQ(result.outcome, ReductionOutcome::two_solutions);
  EXPECT_GT(result.discriminant, 0.0);
  const auto& smaller = result.solutions[0];
  // The frequencies are given to half of their last digit, and the conditions say what that does.
  const double spread = 0.0005 / 1.999;
  const double paper_digits = 0.05 / 74.4;
  EXPECT_NEAR(smaller.absorber_stiffness / 74.4, 1.0,
              smaller.stiffness_condition * spread + paper_digits);
  EXPECT_NEAR(smaller.conductor_mass / 0.0767, 1.0,
              smaller.mass_condition * spread + 0.00005 / 0.0767);
  EXPECT_GT(smaller.stiffness_condition, 10.0) << "close to the double root: ill-conditioned";
  EXPECT_GT(result.solutions[1].absorber_stiffness, 1.05 * 74.4) << "the paper took the smaller";
}

TEST(Table1, IrvinesFirstAndSixthFrequenciesHaveNoPlant) {
  const auto result = reduce_to_frequencies({50.3, 0.16, 2.056, 7.114});
  EXPECT_EQ(result.outcome, ReductionOutcome::no_solution);
  EXPECT_LT(result.discriminant, 0.0);
  // 1/ω₁ − 1/ω₂ ≥ √(m₂/k₁), met exactly by what the result names.
  const double room = (1 / 2.056 - 1 / 7.114) / (2 * pi<double>);
  EXPECT_NEAR(std::sqrt(result.largest_absorber_mass / 50.3) / room, 1.0, 1e-14);
  EXPECT_NEAR(std::sqrt(0.16 / result.smallest_conductor_stiffness) / room, 1.0, 1e-14);
  EXPECT_LT(result.largest_absorber_mass, 0.16);
  EXPECT_GT(result.smallest_conductor_stiffness, 50.3);
}

TEST(Table1, TheConductorsDampingIsTwoPerCentOfCritical) {
  const double damping = conductor_damping(0.0767, 50.3, 0.02);
  EXPECT_NEAR(damping, 0.0786, 0.00005);
  EXPECT_NEAR(damping, 0.079, 0.0005) << "as the paper prints it";
}

struct DecayRow {
  double absorber_damping, first_peak, first_peak_time, period, decrement;
};

/// The plant from rest at z₁ = z₂ = 3.758 mm, by e^{Ah}.
DecayMeasures plant_decay(double absorber_damping) {
  auto plant = kollar2022_plant();
  plant.absorber_damping = absorber_damping;
  const double interval = 0.001;
  const Matrix<double, 4> transition =
      zero_order_hold<double, 4, 1>(plant.state_matrix(), plant.excitation_input(), interval)
          .transition;
  Vector<double, 4> state(0.003758, 0.0, 0.003758, 0.0);
  DecayRecord record;
  for (int k = 0; k <= 2000; ++k) {
    record.times.push_back(k * interval);
    record.displacements.push_back(state[0]);
    state = (transition * state).eval();
  }
  return decay_measures(record);
}

TEST(Figure2, TheTwoMassesDecayAsStatedForEachAbsorberDamping) {
  const DecayRow rows[] = {{1.0, .687, .236, .498, .213},
                           {2.0, .649, .235, .497, .330},
                           {4.0, .670, .220, .481, .522},
                           {8.0, .755, .212, .454, .542}};
  for (const auto& row : rows) {
    const auto found = plant_decay(row.absorber_damping);
    EXPECT_NEAR(-found.first_peak / 0.003758, row.first_peak, 0.0005) << row.absorber_damping;
    expect_within(found.first_peak_time, row.first_peak_time, 0.01);
    EXPECT_NEAR(found.period, row.period, 0.0005) << row.absorber_damping;
    EXPECT_NEAR(found.logarithmic_decrement, row.decrement, 0.0005) << row.absorber_damping;
  }
}

}  // namespace
}  // namespace holdfast
