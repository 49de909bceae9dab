#include "holdfast/plant/two_mass.hpp"

#include "support/random.hpp"
#include "support/testing.hpp"

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

}  // namespace
}  // namespace holdfast
