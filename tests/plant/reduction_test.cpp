#include "holdfast/plant/reduction.hpp"

#include "support/random.hpp"

namespace holdfast {
namespace {

using Asked = FrequencyReduction<double>;

double angular(double frequency) { return 2 * pi<double> * frequency; }

/// Two frequencies, a stiffness and a mass that leaves the roots `room` apart: m₂ is 1/(1 + room)
/// times the largest.
Asked random_reduction(test::Random& random, double room) {
  const double first = random.log_uniform(0.1, 20.0), second = first * random.uniform(1.2, 10.0);
  const double stiffness = random.log_uniform(1.0, 1e4);
  const double gap = 1.0 / angular(first) - 1.0 / angular(second);
  return {stiffness, stiffness * gap * gap / (1.0 + room), first, second};
}

/// Squared angular frequencies of the undamped plant, ascending: det(K − ω² M) = 0.
Vector<double, 2> squared_frequencies(const Asked& asked, const ReducedMasses& found) {
  Matrix<double, 2> stiffness, mass;
  stiffness << asked.conductor_stiffness + found.absorber_stiffness, -found.absorber_stiffness,
      -found.absorber_stiffness, found.absorber_stiffness;
  mass << found.conductor_mass, 0.0, 0.0, asked.absorber_mass;
  return Eigen::GeneralizedSelfAdjointEigenSolver<Matrix<double, 2>>(stiffness, mass).eigenvalues();
}

TEST(Reduction, ThePlantOfEitherRootHasTheFrequenciesAskedFor) {
  test::Random random(381);
  for (int draw = 0; draw < 500; ++draw) {
    const auto asked = random_reduction(random, random.log_uniform(1e-3, 1e3));
    const auto result = reduce_to_frequencies(asked);
    ASSERT_EQ(result.outcome, ReductionOutcome::two_solutions);
    for (const auto& solution : result.solutions) {
      const auto squared = squared_frequencies(asked, solution);
      EXPECT_NEAR(std::sqrt(squared[0]) / angular(asked.first_frequency), 1.0, 1e-9);
      EXPECT_NEAR(std::sqrt(squared[1]) / angular(asked.second_frequency), 1.0, 1e-9);
    }
  }
}

TEST(Reduction, TheRootsSolveTheQuadraticAndTheirProductIsFixed) {
  test::Random random(382);
  for (int draw = 0; draw < 500; ++draw) {
    const auto asked = random_reduction(random, random.log_uniform(1e-3, 1e3));
    const auto result = reduce_to_frequencies(asked);
    const double m2 = asked.absorber_mass, k1 = asked.conductor_stiffness;
    const double w1 = std::pow(angular(asked.first_frequency), 2);
    const double w2 = std::pow(angular(asked.second_frequency), 2);
    for (const auto& solution : result.solutions) {
      const double k2 = solution.absorber_stiffness;
      const double residual = k2 * k2 / m2 + k2 * (m2 * w1 * w2 / k1 - w1 - w2) + m2 * w1 * w2;
      EXPECT_LE(std::abs(residual), 1e-13 * (k2 * k2 / m2 + m2 * w1 * w2 + k2 * (w1 + w2)));
      EXPECT_NEAR(solution.conductor_mass * m2 * w1 * w2 / (k1 * k2), 1.0, 1e-13);
    }
    EXPECT_LT(result.solutions[0].absorber_stiffness, result.solutions[1].absorber_stiffness);
    EXPECT_NEAR(result.solutions[0].absorber_stiffness / (m2 * m2 * w1 * w2) *
                    result.solutions[1].absorber_stiffness,
                1.0, 1e-12);
  }
}

TEST(Reduction, TheConditionNumbersAreTheSumsOfTheRelativeDerivatives) {
  test::Random random(384);
  double Asked::*const inputs[] = {&Asked::conductor_stiffness, &Asked::absorber_mass,
                                   &Asked::first_frequency, &Asked::second_frequency};
  for (int draw = 0; draw < 100; ++draw) {
    const auto asked = random_reduction(random, random.log_uniform(1e-2, 10.0));
    const auto result = reduce_to_frequencies(asked);
    for (const std::size_t root : {0U, 1U}) {
      double stiffness = 0.0, mass = 0.0, damping = 0.0;
      for (double Asked::*input : inputs) {
        Asked below = asked, above = asked;
        const double step = 1e-6;
        below.*input *= std::exp(-step);
        above.*input *= std::exp(step);
        const auto low = reduce_to_frequencies(below).solutions[root];
        const auto high = reduce_to_frequencies(above).solutions[root];
        stiffness +=
            std::abs(std::log(high.absorber_stiffness / low.absorber_stiffness)) / (2 * step);
        mass += std::abs(std::log(high.conductor_mass / low.conductor_mass)) / (2 * step);
        const auto c1 = [](const Asked& of, const ReducedMasses& with) {
          return conductor_damping(with.conductor_mass, of.conductor_stiffness, 0.02);
        };
        damping += std::abs(std::log(c1(above, high) / c1(below, low))) / (2 * step);
      }
      EXPECT_NEAR(result.solutions[root].stiffness_condition / stiffness, 1.0, 1e-5);
      EXPECT_NEAR(result.solutions[root].mass_condition / mass, 1.0, 1e-5);
      EXPECT_NEAR(result.solutions[root].damping_condition / damping, 1.0, 1e-5);
    }
  }
}

TEST(Reduction, IsSaidToBeIllConditionedWhereOnePercentMayBecomeAHundred) {
  test::Random random(387);
  int ill = 0;
  for (int draw = 0; draw < 200; ++draw) {
    const auto asked = random_reduction(random, random.log_uniform(1e-6, 1e3));
    const ReducedMasses found = reduce_to_frequencies(asked).solutions[0];
    // Errors of 10⁻⁹ of all inputs, those that add up, small enough to be far from the edge.
    const double error = 1e-9;
    double worst = 0.0;
    for (const double frequencies : {-error, error}) {
      Asked other = asked;
      other.conductor_stiffness *= 1.0 - frequencies;
      other.absorber_mass *= 1.0 + frequencies;
      other.first_frequency *= 1.0 + frequencies;
      other.second_frequency *= 1.0 - frequencies;
      const ReducedMasses moved = reduce_to_frequencies(other).solutions[0];
      worst = std::max({worst, std::abs(moved.absorber_stiffness / found.absorber_stiffness - 1.0),
                        std::abs(moved.conductor_mass / found.conductor_mass - 1.0)});
    }
    if (found.is_ill_conditioned()) ++ill;
    const bool surely = worst > 110.0 * error, surely_not = worst < 50.0 * error;
    EXPECT_TRUE(found.is_ill_conditioned() || !surely) << draw;
    EXPECT_FALSE(found.is_ill_conditioned() && surely_not) << draw;
  }
  EXPECT_GT(ill, 20);
  EXPECT_LT(ill, 180);
}

TEST(Reduction, TheLargestMassAndTheSmallestStiffnessAreTheEdgeOfExistence) {
  test::Random random(385);
  for (int draw = 0; draw < 200; ++draw) {
    const auto asked = random_reduction(random, random.uniform(-0.9, 5.0));
    const auto result = reduce_to_frequencies(asked);
    const double gap = 1.0 / angular(asked.first_frequency) - 1.0 / angular(asked.second_frequency);
    EXPECT_NEAR(std::sqrt(result.largest_absorber_mass / asked.conductor_stiffness) / gap, 1.0,
                1e-13);
    EXPECT_NEAR(std::sqrt(asked.absorber_mass / result.smallest_conductor_stiffness) / gap, 1.0,
                1e-13);
    EXPECT_NEAR(result.largest_absorber_mass / asked.absorber_mass, 1.0 + result.discriminant,
                1e-13 * (1.0 + std::abs(result.discriminant)));
    for (const double off : {1e-6, -1e-6}) {
      Asked heavier = asked, softer = asked;
      heavier.absorber_mass = result.largest_absorber_mass * (1.0 + off);
      softer.conductor_stiffness = result.smallest_conductor_stiffness / (1.0 + off);
      const auto expected =
          off > 0 ? ReductionOutcome::no_solution : ReductionOutcome::two_solutions;
      EXPECT_EQ(reduce_to_frequencies(heavier).outcome, expected);
      EXPECT_EQ(reduce_to_frequencies(softer).outcome, expected);
    }
  }
}

TEST(Reduction, AtTheEdgeItselfTheNumbersAreFiniteWhereverASolutionIsClaimed) {
  test::Random random(386);
  int claimed = 0;
  for (int draw = 0; draw < 500; ++draw) {
    auto asked = random_reduction(random, 1.0);
    asked.absorber_mass = reduce_to_frequencies(asked).largest_absorber_mass;
    const auto result = reduce_to_frequencies(asked);
    if (result.outcome == ReductionOutcome::no_solution) continue;
    ++claimed;
    const double middle = asked.absorber_mass * angular(asked.first_frequency) *
                          angular(asked.second_frequency);  // k₂ = m₂ ω₁ω₂ where the roots meet
    for (const auto& solution : result.solutions) {
      EXPECT_NEAR(solution.absorber_stiffness / middle, 1.0, 1e-6);
      EXPECT_TRUE(std::isfinite(solution.conductor_mass));
      EXPECT_FALSE(std::isnan(solution.stiffness_condition));
      EXPECT_GT(solution.stiffness_condition, 1e6);
    }
  }
  EXPECT_GT(claimed, 100);
}

TEST(Reduction, WithoutSolutionThereIsNoNumber) {
  test::Random random(387);
  const auto result = reduce_to_frequencies(random_reduction(random, -0.1));
  ASSERT_EQ(result.outcome, ReductionOutcome::no_solution);
  EXPECT_LT(result.discriminant, 0.0);
  for (const auto& solution : result.solutions) {
    EXPECT_TRUE(std::isnan(solution.absorber_stiffness));
    EXPECT_TRUE(std::isnan(solution.conductor_mass));
  }
}

TEST(Reduction, BadInputIsRefused) {
  const Asked good{50.3, 0.16, 2.0, 7.0};
  for (double Asked::*input : {&Asked::conductor_stiffness, &Asked::absorber_mass,
                               &Asked::first_frequency, &Asked::second_frequency}) {
    for (const double value : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity()}) {
      Asked asked = good;
      asked.*input = value;
      EXPECT_THROW(reduce_to_frequencies(asked), InvalidParameter);
    }
  }
  EXPECT_THROW(reduce_to_frequencies({50.3, 0.16, 7.0, 2.0}), InvalidParameter);
  EXPECT_THROW(reduce_to_frequencies({50.3, 0.16, 2.0, 2.0}), InvalidParameter);
}

TEST(ConductorDamping, ItIsThatOfOneMassOnOneSpring) {
  // Poles of m z̈ + c ż + k z: real part −ζ ω.
  const double mass = 0.3, stiffness = 20.0, ratio = 0.05;
  const double damping = conductor_damping(mass, stiffness, ratio);
  EXPECT_NEAR(damping / (2 * mass), ratio * std::sqrt(stiffness / mass), 1e-15);
  EXPECT_THROW(conductor_damping(0.0, stiffness, ratio), InvalidParameter);
  EXPECT_THROW(conductor_damping(mass, -1.0, ratio), InvalidParameter);
  EXPECT_THROW(conductor_damping(mass, stiffness, 1.1), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
