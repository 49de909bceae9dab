// A conductor by its modes with the absorber: the state matrix against the receptance, which forms
// none.

#include <Eigen/Eigenvalues>

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/plant/modal_plant.hpp"
#include "holdfast/plant/plant_poles.hpp"

#include "support/dense_routes.hpp"
#include "support/message_of.hpp"
#include "support/random.hpp"
#include "support/string_case.hpp"

namespace holdfast::test {
namespace {

using Complex = std::complex<double>;

std::vector<PlaceMode<double>> random_modes(Random& random, std::size_t count) {
  std::vector<PlaceMode<double>> modes;
  for (std::size_t n = 0; n < count; ++n)
    modes.push_back({random.log_uniform(3.0, 300.0), random.uniform(0.0, 0.1), random.normal(),
                     random.log_uniform(0.01, 10.0)});
  return modes;
}

Absorber<double> random_absorber(Random& random) {
  return {random.log_uniform(0.01, 5.0), random.log_uniform(1.0, 1e4), random.uniform(0.0, 20.0),
          random.unit() < 0.3 ? 0.0 : random.log_uniform(1e-3, 1.0)};
}

/// h (sI − A)⁻¹ b.
template <int States>
Complex transfer(const LinearPlant<double, States>& plant, const RowVector<double, States>& h,
                 const Vector<double, States>& b, const Complex& s) {
  const Eigen::Index n = plant.order();
  const Eigen::MatrixXcd shifted =
      s * Eigen::MatrixXcd::Identity(n, n) - plant.state_matrix().template cast<Complex>();
  const Eigen::VectorXcd right = b.template cast<Complex>();
  return (h.template cast<Complex>() * solution_of(shifted, right)).value();
}

TEST(ModalPlant, AnswersAsTheReceptanceSays) {
  Random random(252);
  for (int draw = 0; draw < 300; ++draw) {
    const auto modes = random_modes(random, 1 + random.index(8));
    const Absorber<double> absorber = random_absorber(random);
    const LinearPlant<double> plant = modal_plant(modes, absorber);
    validate(plant);
    const Complex s(random.uniform(0.0, 5.0), random.log_uniform(1.0, 500.0));
    const PlaceResponse<double> expected = place_response(receptance(modes, s), absorber, s);
    const Ports<double, Eigen::Dynamic>& ports = plant.ports();
    const Complex to_force = transfer(plant, ports.displacement, plant.excitation, s);
    const Complex to_drive = transfer(plant, ports.displacement, plant.force_input, s);
    EXPECT_LT(std::abs(to_force - expected.to_force), 1e-10 * std::abs(expected.to_force)) << draw;
    EXPECT_LT(std::abs(to_drive - expected.to_drive), 1e-10 * std::abs(expected.to_drive)) << draw;
    const Complex velocity = transfer(plant, ports.velocity, plant.force_input, s);
    EXPECT_LT(std::abs(velocity - s * expected.to_drive), 1e-10 * std::abs(velocity)) << draw;
  }
}

TEST(ModalPlant, RefusesWhatIsNotAdmissible) {
  const std::vector<PlaceMode<double>> modes = {{10.0, 0.01, 0.5, 1.0}};
  const Absorber<double> absorber{0.16, 74.4, 4.0, 0.01};
  EXPECT_THROW(modal_plant<double>({}, absorber), InvalidParameter);
  const auto refused = [&](const PlaceMode<double>& mode) {
    return tests::message_of<InvalidParameter>([&] { modal_plant<double>({mode}, absorber); });
  };
  EXPECT_NE(refused({0.0, 0.01, 0.5, 1.0}).find("angular frequency"), std::string::npos);
  EXPECT_NE(refused({10.0, -0.01, 0.5, 1.0}).find("damping ratio"), std::string::npos);
  EXPECT_NE(refused({10.0, 0.01, NAN, 1.0}).find("shape"), std::string::npos);
  EXPECT_NE(refused({10.0, 0.01, 0.5, 0.0}).find("mass of a mode"), std::string::npos);
  for (const Absorber<double>& other :
       {Absorber<double>{0.0, 74.4, 4.0}, Absorber<double>{0.16, -1.0, 4.0},
        Absorber<double>{0.16, 74.4, -4.0}, Absorber<double>{0.16, 74.4, 4.0, -0.01}})
    EXPECT_THROW(modal_plant(modes, other), InvalidParameter);
}

// Poles of a conductor with its absorber one by one, against eigenvalues of the plant's matrix and
// the closed transfer function.

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

/// Modes at any distances, with nodes, absorbers from hardly to more than critically damped, some
/// tuned to a mode's eigenvalue exactly or damped critically.
TEST(PlantPoles, AreTheEigenvaluesOfRandomPlants) {
  Random random(20251125);
  int found = 0;
  constexpr int plants = 400;
  for (int k = 0; k < plants; ++k) {
    // Of a third of them some modes are overdamped.
    const std::vector<PlaceMode<double>> modes = random_modes(random, k % 3 == 0 ? 20.0 : 0.5);
    const double own = random.uniform(0.5, 1.5) * modes[modes.size() / 2].angular_frequency;
    const double mass = random.log_uniform(0.01, 1.0);
    Absorber<double> absorber{mass, mass * own * own,
                              2.0 * random.log_uniform(1e-3, 1.6) * mass * own,
                              k % 2 == 0 ? 0.0 : random.uniform(0.0, 0.1)};
    const PlaceMode<double>& first = modes.front();
    if (k % 5 == 0) absorber.damping = 2.0 * mass * own;
    if (k % 5 == 1) {
      absorber.stiffness = mass * first.angular_frequency * first.angular_frequency;
      absorber.damping = 2.0 * first.damping_ratio * mass * first.angular_frequency;
    }
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
  EXPECT_GE(found, plants * 99 / 100);
}

/// Two modes of one frequency are one to the absorber.
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
