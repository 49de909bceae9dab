#include "support/reference/condensed_cable.hpp"

#include "holdfast/cable/modes.hpp"
#include "holdfast/cable/statics.hpp"
#include "support/dense_routes.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

using Condensed = CondensedCable<>;
constexpr int half_the_states = Condensed::coordinates;

Condensed condensed_cable(double mass, const RayleighDamping& damping) {
  return {kollar2022_conductor(), 0.64, mass, damping};
}

Eigen::VectorXd condensed_rate(const Condensed& cable, const Eigen::VectorXd& state) {
  Eigen::VectorXd rate(Condensed::states());
  cable.rate(state.data(), rate.data());
  return rate;
}

/// ∂rate/∂state by central differences, which the cubic force law leaves an error of step².
Eigen::MatrixXd condensed_jacobian(const Condensed& cable, const Eigen::VectorXd& state) {
  const int size = Condensed::states();
  Eigen::MatrixXd jacobian(size, size);
  for (int k = 0; k < size; ++k) {
    const Eigen::VectorXd step = 1e-5 * Eigen::VectorXd::Unit(size, k);
    jacobian.col(k) =
        (condensed_rate(cable, state + step) - condensed_rate(cable, state - step)) / 2e-5;
  }
  return jacobian;
}

/// ∂q̈/∂q.
Eigen::MatrixXd condensed_acceleration(const Condensed& cable, const Eigen::VectorXd& state) {
  return condensed_jacobian(cable, state).bottomLeftCorner(half_the_states, half_the_states);
}

/// μ ∫ φ φᵀ dx by Simpson's rule on either side of the tent's top.
Eigen::MatrixXd quadrature_mass() {
  const auto conductor = kollar2022_conductor();
  const double span = conductor.span, top = 0.64;
  constexpr int intervals = 2000;
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(half_the_states, half_the_states);
  for (const auto& [from, to] : {std::pair{0.0, top}, {top, span}}) {
    for (int k = 0; k <= intervals; ++k) {
      const double weight = k == 0 || k == intervals ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0);
      const double x = from + (to - from) * k / intervals;
      Eigen::VectorXd shape(half_the_states);
      for (int i = 0; i + 1 < half_the_states; ++i)
        shape[i] = std::sin((i + 1) * pi<double> * x / span);
      shape[half_the_states - 1] = x < top ? x / top : (span - x) / (span - top);
      mass += weight * (to - from) / (3.0 * intervals) * shape * shape.transpose();
    }
  }
  return conductor.mass_per_length * mass;
}

TEST(CondensedCable, NothingMovesAtRest) {
  const auto cable = condensed_cable(0.16, rayleigh_damping(0.02, 2.0, 7.0));
  const auto start = cable.held_by(0.0);
  ASSERT_EQ(start.outcome, EquilibriumOutcome::converged);
  EXPECT_NEAR(cable.displacement(start.state), 0.0, 1e-15);
  EXPECT_LE(condensed_rate(cable, start.state).norm(), 1e-8);
}

TEST(CondensedCable, ItsForcesHaveAPotential) {
  // M ∂q̈/∂q = −∂²U/∂q²: symmetric wherever the cable is, negative definite at rest.
  test::Random random(371);
  const Eigen::MatrixXd mass = quadrature_mass();
  const auto cable = condensed_cable(0.16, {0.0, 0.0});
  for (int draw = 0; draw < 20; ++draw) {
    Eigen::VectorXd state = cable.held_by(0.0).state;
    for (double& coordinate : state) coordinate += draw > 0 ? random.uniform(-0.02, 0.02) : 0.0;
    const Eigen::MatrixXd stiffness = -mass * condensed_acceleration(cable, state);
    EXPECT_LE((stiffness - stiffness.transpose()).norm(), 1e-6 * stiffness.norm());
    const double softest = test::eigenvalues_of(stiffness).real().minCoeff();
    EXPECT_TRUE(draw > 0 || softest > 0.0) << softest;
  }
}

TEST(CondensedCable, DampingIsRayleighsAtTheEquilibriumWithTheWeight) {
  const RayleighDamping damping{0.4, 7e-4};
  const auto cable = condensed_cable(0.16, damping);
  const Eigen::VectorXd rest = cable.held_by(0.0).state;
  const Eigen::MatrixXd expected =
      damping.stiffness_factor * condensed_acceleration(cable, rest) -
      damping.mass_factor * Eigen::MatrixXd::Identity(half_the_states, half_the_states);
  const Eigen::MatrixXd by_velocity =
      condensed_jacobian(cable, rest).bottomRightCorner(half_the_states, half_the_states);
  EXPECT_LE((by_velocity - expected).norm(), 1e-6 * expected.norm());
}

TEST(CondensedCable, TheBareOneHasIrvineAndCaugheysFrequencies) {
  for (const double parameter : {0.5, 30.0, 1719.0}) {
    auto conductor = kollar2022_conductor();
    conductor.youngs_modulus *= parameter / conductor.irvine_parameter();
    const Condensed cable(conductor, 0.64, 0.0, {0.0, 0.0});
    const Eigen::VectorXcd squared = test::eigenvalues_of(
        -condensed_acceleration(cable, Eigen::VectorXd::Zero(Condensed::states())));
    for (const auto& mode : irvine_modes(conductor, 4)) {
      const double asked = std::pow(2 * pi<double> * mode.frequency, 2);
      EXPECT_LE((squared.array() - asked).abs().minCoeff(), 2e-3 * asked) << mode.frequency;
    }
  }
}

template <int Sines>
double condensed_miss(double force) {
  const auto conductor = kollar2022_conductor();
  const CondensedCable<Sines> cable(conductor, 0.64, 0.16, {0.0, 0.0});
  return std::abs(cable.displacement(cable.held_by(force).state) /
                      irvine_statics(conductor, 0.64, 0.16).displacement(force) -
                  1.0);
}

TEST(CondensedCable, ItsStaticsApproachEquationOneWithTheNumberOfSines) {
  for (const double force : {-0.4, 0.2, 1.0}) {
    EXPECT_LT(condensed_miss<8>(force), 0.5 * condensed_miss<4>(force)) << force;
    EXPECT_LT(condensed_miss<8>(force), 5e-3) << force;
  }
}

TEST(CondensedCable, ItsTensionApproachesThatOfEquationOne) {
  const auto statics = irvine_statics(kollar2022_conductor(), 0.64, 0.16);
  const auto cable = condensed_cable(0.16, {0.0, 0.0});
  for (const double force : {-0.4, 0.0, 1.0})
    EXPECT_NEAR(cable.tension(cable.held_by(force).state.data()) / statics.tension(force), 1.0,
                5e-3);
}

}  // namespace
}  // namespace holdfast
