#include "holdfast/plant/two_mass.hpp"
#include "holdfast/plant/energy.hpp"

#include "support/dense_routes.hpp"
#include "support/random.hpp"
#include "support/random_loop.hpp"

namespace holdfast {
namespace {

TwoMass<double> drawn_plant(test::Random& random) {
  return {random.log_uniform(0.01, 10), random.log_uniform(1, 1000), random.log_uniform(0.01, 10),
          random.log_uniform(0.01, 10), random.log_uniform(1, 1000), random.log_uniform(0.01, 10)};
}

TEST(TwoMass, ObeysNewtonForEachMass) {
  test::Random random(51);
  for (int draw = 0; draw < 1000; ++draw) {
    const auto p = drawn_plant(random);
    const auto z = random.matrix<Vector<double, 4>>();
    const double u = random.uniform(-1, 1), force = random.uniform(-1, 1);
    const Vector<double, 4> rate =
        p.state_matrix() * z + p.control_input() * u + p.excitation_input() * force;
    const double drive =
        p.absorber_stiffness * (z[2] - z[0]) + p.absorber_damping * (z[3] - z[1]) + u;
    const double conductor =
        -p.conductor_stiffness * z[0] - p.conductor_damping * z[1] + drive + force;
    const double scale =
        p.conductor_stiffness + p.absorber_stiffness + p.conductor_damping + p.absorber_damping + 2;
    EXPECT_EQ(rate[0], z[1]);
    EXPECT_EQ(rate[2], z[3]);
    EXPECT_NEAR(p.conductor_mass * rate[1], conductor, 1e-14 * scale);
    EXPECT_NEAR(p.absorber_mass * rate[3], -drive, 1e-14 * scale);
  }
}

TEST(TwoMass, TheDriveExertsNoNetForce) {
  test::Random random(52);
  const auto p = drawn_plant(random);
  const Vector<double, 4> b = p.control_input();
  EXPECT_NEAR(p.conductor_mass * b[1] + p.absorber_mass * b[3], 0.0, 1e-15);
}

TEST(TwoMass, EnergyIsLostToTheDampersOnly) {
  test::Random random(53);
  for (int draw = 0; draw < 1000; ++draw) {
    const auto p = drawn_plant(random);
    const auto z = random.matrix<Vector<double, 4>>();
    const Vector<double, 4> rate = p.state_matrix() * z;
    const double stretch = z[2] - z[0], stretch_rate = z[3] - z[1];
    const double power = p.conductor_mass * z[1] * rate[1] + p.absorber_mass * z[3] * rate[3] +
                         p.conductor_stiffness * z[0] * z[1] +
                         p.absorber_stiffness * stretch * stretch_rate;
    const double loss =
        p.conductor_damping * z[1] * z[1] + p.absorber_damping * stretch_rate * stretch_rate;
    const double scale =
        p.conductor_stiffness + p.absorber_stiffness + p.conductor_damping + p.absorber_damping;
    EXPECT_NEAR(power, -loss, 1e-13 * scale);
  }
}

TEST(TwoMass, TheSamePlantServesOtherNumberTypes) {
  const TwoMass<long double> precise{0.0767L, 50.3L, 0.079L, 0.16L, 74.4L, 4.0L};
  const Matrix<double, 4> rounded = precise.state_matrix().cast<double>();
  EXPECT_LE((rounded - kollar2022_plant().state_matrix()).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(TwoMass, EveryMemberOutOfRangeIsRefusedByItsName) {
  struct Member {
    double TwoMass<double>::*member;
    const char* name;
    const char* unit;
    bool zero_is_admissible;
  };
  const Member members[] = {
      {&TwoMass<double>::conductor_mass, "conductor mass m1", "kg", false},
      {&TwoMass<double>::conductor_stiffness, "conductor stiffness k1", "N/m", false},
      {&TwoMass<double>::conductor_damping, "conductor damping c1", "N s/m", true},
      {&TwoMass<double>::absorber_mass, "absorber mass m2", "kg", false},
      {&TwoMass<double>::absorber_stiffness, "absorber stiffness k2", "N/m", false},
      {&TwoMass<double>::absorber_damping, "absorber damping c2", "N s/m", true}};
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const Member& m : members) {
    for (const double value :
         {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity, -1.0}) {
      auto plant = kollar2022_plant();
      plant.*(m.member) = value;
      try {
        validate(plant);
        ADD_FAILURE() << m.name << " = " << value << " was admitted";
      } catch (const InvalidParameter& error) {
        EXPECT_EQ(error.name(), m.name);
        EXPECT_EQ(error.unit(), m.unit);
        EXPECT_FALSE(error.admissible().empty());
      }
    }
    auto plant = kollar2022_plant();
    plant.*(m.member) = 0.0;
    if (m.zero_is_admissible) {
      EXPECT_NO_THROW(validate(plant)) << m.name;
    } else {
      EXPECT_THROW(validate(plant), InvalidParameter) << m.name;
    }
  }
  EXPECT_NO_THROW(validate(kollar2022_plant()));
}

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
