#include "holdfast/plant/energy.hpp"

#include "support/dense_routes.hpp"
#include "support/random.hpp"
#include "support/random_loop.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

/// G with ‖z‖ = |G z|: the parts of the energy one below the other.
Matrix<double, 4> energy_coordinates(const TwoMass<double>& plant) {
  Matrix<double, 4> g = Matrix<double, 4>::Zero();
  const double spring = std::sqrt(plant.absorber_stiffness);
  g(0, 0) = std::sqrt(plant.conductor_stiffness);
  g(1, 1) = std::sqrt(plant.conductor_mass);
  g(2, 0) = -spring;
  g(2, 2) = spring;
  g(3, 3) = std::sqrt(plant.absorber_mass);
  return g;
}

double spectral_norm(const Matrix<double, 4>& matrix) {
  return test::singular_values_of(matrix)[0];
}

/// A state whose parts of the energy are of the same size.
Vector<double, 4> energetic_state(const TwoMass<double>& plant, test::Random& random) {
  return energy_coordinates(plant).inverse() * random.matrix<Vector<double, 4>>();
}

TEST(EnergyNorm, IsTheRootOfTwiceTheEnergy) {
  test::Random random(1301);
  for (int draw = 0; draw < 200; ++draw) {
    const auto plant = test::random_plant(random);
    const EnergyNorm norm(plant);
    const Vector<double, 4> z = energetic_state(plant, random);
    const double expected = (energy_coordinates(plant) * z).norm();
    EXPECT_NEAR(norm(z), expected, 1e-14 * expected);
    EXPECT_NEAR(norm(-3.0 * z), 3.0 * expected, 1e-13 * expected);
  }
  EXPECT_EQ(EnergyNorm(kollar2022_plant())(Vector<double, 4>::Zero()), 0.0);
}

TEST(EnergyNorm, NothingGrowsByItself) {
  test::Random random(1302);
  double largest = 0.0;
  for (int draw = 0; draw < 2000; ++draw) {
    const auto plant = test::random_plant(random);
    const double time = random.log_uniform(1e-5, 1.0);
    const auto step =
        zero_order_hold<double, 4, 1>(plant.state_matrix(), Vector<double, 4>::Zero().eval(), time);
    const Matrix<double, 4> g = energy_coordinates(plant);
    const double growth = spectral_norm(g * step.transition * g.inverse());
    largest = std::max(largest, growth);
    ASSERT_LE(growth, 1.0 + 1e-11) << draw;
  }
  std::cout << "largest norm of exp(A t) less one: " << largest - 1.0 << '\n';
}

TEST(EnergyNorm, WithoutDampersItIsConserved) {
  test::Random random(1303);
  for (int draw = 0; draw < 500; ++draw) {
    auto plant = test::random_plant(random);
    plant.conductor_damping = plant.absorber_damping = 0.0;
    const auto step = zero_order_hold<double, 4, 1>(
        plant.state_matrix(), Vector<double, 4>::Zero().eval(), random.log_uniform(1e-4, 1.0));
    const EnergyNorm norm(plant);
    const Vector<double, 4> z = energetic_state(plant, random);
    ASSERT_NEAR(norm(step.transition * z), norm(z), 1e-11 * norm(z)) << draw;
  }
}

TEST(EnergyNorm, ItsDualBoundsEveryFunctionalAndIsAttained) {
  test::Random random(1304);
  for (int draw = 0; draw < 500; ++draw) {
    const auto plant = test::random_plant(random);
    const EnergyNorm norm(plant);
    const Matrix<double, 4> g = energy_coordinates(plant);
    const Vector<double, 4> functional = g.transpose() * random.matrix<Vector<double, 4>>();
    const double dual = norm.dual(functional);
    for (int trial = 0; trial < 20; ++trial) {
      const Vector<double, 4> z = energetic_state(plant, random);
      ASSERT_LE(std::abs(functional.dot(z)), dual * norm(z) * (1.0 + 1e-12));
    }
    const Vector<double, 4> steepest = (g.transpose() * g).inverse() * functional;
    ASSERT_NEAR(functional.dot(steepest), dual * norm(steepest), 1e-10 * dual * norm(steepest));
  }
}

// ‖z(t)‖ ≤ ‖z(0)‖ + ∫ ‖b u + c F‖ ds along motions under forces that are constant for random
// times.
TEST(EnergyNorm, AForceAddsNoMoreThanItsOwnNorm) {
  test::Random random(1305);
  double tightest = 0.0;
  for (int draw = 0; draw < 300; ++draw) {
    const auto plant = test::random_plant(random);
    const EnergyNorm norm(plant);
    Matrix<double, 4, 2> inputs;
    inputs << plant.control_input(), plant.excitation_input();
    Vector<double, 4> z = 0.1 * energetic_state(plant, random);
    double bound = norm(z);
    for (int part = 0; part < 30; ++part) {
      const double length = random.log_uniform(1e-4, 0.1);
      const auto step = zero_order_hold<double, 4, 2>(plant.state_matrix(), inputs, length);
      const Vector<double, 2> forces = random.matrix<Vector<double, 2>>();
      z = step.transition * z + step.input * forces;
      bound += norm(inputs * forces) * length;
      ASSERT_LE(norm(z), bound * (1.0 + 1e-12)) << draw << ", part " << part;
      tightest = std::max(tightest, norm(z) / bound);
    }
  }
  EXPECT_GT(tightest, 0.9) << "the bound is of no use if it is never come near";
}

}  // namespace
}  // namespace holdfast
