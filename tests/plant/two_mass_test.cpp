#include "holdfast/plant/two_mass.hpp"
#include "holdfast/plant/energy.hpp"

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

}  // namespace
}  // namespace holdfast
