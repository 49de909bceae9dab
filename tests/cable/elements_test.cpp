#include "holdfast/cable/elements.hpp"

#include <unsupported/Eigen/AutoDiff>

#include "holdfast/cable/chain_modes.hpp"
#include "holdfast/cable/statics.hpp"
#include "support/dense_routes.hpp"
#include "support/random.hpp"
#include "support/reference/cable_energy.hpp"

namespace holdfast {
namespace {

const RayleighDamping undamped_cable{0.0, 0.0};
const RayleighDamping kollar_damping = rayleigh_damping(0.02, 2.0, 7.0);

const HangingAbsorber all_absorbers[] = {{AbsorberReading::weight, 0.16},
                                         {AbsorberReading::rigid_mass, 0.16},
                                         {AbsorberReading::spring_mass, 0.16, 74.4, 4.0}};

CableElements cable_with(const HangingAbsorber& absorber, const RayleighDamping& damping,
                         int elements = 10) {
  return {kollar2022_conductor(), 0.64, elements, absorber, damping};
}

/// Near the equilibrium: 0.1 mm and 0.1 m/s away from it.
Eigen::VectorXd random_state(const CableElements& cable, test::Random& random) {
  Eigen::VectorXd state = cable.held_by(0.0).state;
  for (Eigen::Index k = 0; k < state.size(); ++k) {
    // Velocities, and the place of the hung mass, are zero at rest.
    const double size = state[k] == 0.0 ? 0.1 : 1e-4;
    state[k] += size * random.uniform(-1.0, 1.0);
  }
  return state;
}

Eigen::VectorXd rate_at(const CableElements& cable, const Eigen::VectorXd& state) {
  Eigen::VectorXd rate(cable.states());
  cable.rate(state.data(), rate.data());
  return rate;
}

Eigen::MatrixXd analytic_jacobian(const CableElements& cable, const Eigen::VectorXd& state) {
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(cable.states(), cable.states());
  cable.jacobian(state.data(), [&](int row, int column, double value) {
    EXPECT_LE(std::abs(row - column), cable.half_bandwidth());
    jacobian(row, column) = value;
  });
  return jacobian;
}

/// The same column by column, by automatic differentiation of the rate.
Eigen::MatrixXd differentiated_jacobian(const CableElements& cable, const Eigen::VectorXd& state) {
  using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, 1, 1>>;
  const auto size = static_cast<std::size_t>(cable.states());
  Eigen::MatrixXd jacobian(cable.states(), cable.states());
  for (std::size_t column = 0; column < size; ++column) {
    std::vector<Dual> seeded(size), rate(size);
    for (std::size_t k = 0; k < size; ++k) {
      seeded[k].value() = state[static_cast<Eigen::Index>(k)];
      seeded[k].derivatives()[0] = k == column ? 1.0 : 0.0;
    }
    cable.rate(seeded.data(), rate.data());
    for (std::size_t row = 0; row < size; ++row)
      jacobian(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) =
          rate[row].derivatives()[0];
  }
  return jacobian;
}

TEST(CableElements, TheJacobianIsTheDerivativeOfTheRateWithinItsBand) {
  test::Random random(361);
  for (const auto& absorber : all_absorbers) {
    for (const double place : {0.1, 0.64, 3.2, 6.3}) {
      const CableElements cable(kollar2022_conductor(), place, 10, absorber, kollar_damping);
      const auto state = random_state(cable, random);
      const auto analytic = analytic_jacobian(cable, state);
      const auto differentiated = differentiated_jacobian(cable, state);
      for (Eigen::Index row = 0; row < analytic.rows(); ++row) {
        const double scale = differentiated.row(row).cwiseAbs().maxCoeff();
        for (Eigen::Index column = 0; column < analytic.cols(); ++column)
          EXPECT_NEAR(analytic(row, column), differentiated(row, column),
                      1e-6 * std::abs(differentiated(row, column)) + 1e-12 * scale)
              << row << ' ' << column;
      }
    }
  }
}

TEST(CableElements, NothingMovesAtRestUnderTheAbsorbersWeight) {
  for (const auto& absorber : all_absorbers) {
    const auto cable = cable_with(absorber, kollar_damping);
    ASSERT_EQ(cable.rest().outcome, EquilibriumOutcome::converged);
    const auto start = cable.held_by(0.0);
    EXPECT_NEAR(cable.displacement(start.state), 0.0, 1e-15);
    // m/s²: the round-off of a bar's pull on the mass of a node.
    EXPECT_LE(rate_at(cable, start.state).cwiseAbs().maxCoeff(), 1e-5);
  }
}

TEST(CableElements, WhatHoldsItStartsTheMotionOfTheLoadedNode) {
  const double force = 0.2;
  for (const auto& absorber : all_absorbers) {
    const auto cable = cable_with(absorber, kollar_damping);
    const auto start = cable.held_by(force);
    ASSERT_EQ(start.outcome, EquilibriumOutcome::converged);
    const auto rate = rate_at(cable, start.state);
    const bool rigid = absorber.reading == AbsorberReading::rigid_mass;
    const double inertia = cable.chain().mass(cable.chain().loaded_node()) + (rigid ? 0.16 : 0.0);
    // Once the force is gone, it is what the node lacks: alone upward, nothing elsewhere.
    EXPECT_NEAR(rate.minCoeff(), -force / inertia, 1e-5);
    EXPECT_NEAR(rate.norm(), force / inertia, 1e-5);
  }
}

TEST(CableElements, TheSpringMassHangsStillUnderItsNode) {
  const auto cable = cable_with(all_absorbers[2], undamped_cable);
  const auto start = cable.held_by(0.2);
  const int own = 4 * cable.chain().loaded_node();
  EXPECT_EQ(start.state[own + 4], cable.displacement(start.state));
  EXPECT_EQ(start.state[own + 5], 0.0);
  EXPECT_EQ(cable.states(), cable_with(all_absorbers[0], undamped_cable).states() + 2);
}

/// dE/dt along the motion by a central difference.
double power(const CableElements& cable, const HangingAbsorber& absorber,
             const Eigen::VectorXd& state) {
  const Eigen::VectorXd step = 1e-6 * rate_at(cable, state);
  return (test::energy_of(cable, absorber, state + step) -
          test::energy_of(cable, absorber, state - step)) /
         2e-6;
}

Eigen::VectorXd velocities_of(const CableElements& cable, const Eigen::VectorXd& state) {
  const Eigen::VectorXd rate = rate_at(cable, state);
  const bool sprung = cable.states() > 4 * cable.chain().free_nodes();
  Eigen::VectorXd velocities(2 * cable.chain().free_nodes());
  for (int node = 0; node < cable.chain().free_nodes(); ++node) {
    const int first = 4 * node + (sprung && node > cable.chain().loaded_node() ? 2 : 0);
    velocities.segment<2>(2 * node) = rate.segment<2>(first);
  }
  return velocities;
}

TEST(CableElements, WithoutDampingTheEnergyStays) {
  test::Random random(362);
  for (auto absorber : all_absorbers) {
    absorber.damping = 0.0;
    const auto cable = cable_with(absorber, undamped_cable);
    for (int draw = 0; draw < 20; ++draw) {
      const auto state = random_state(cable, random);
      // A millionth of a newton at the nodes' speeds; the bars' pulls change by some 10 N.
      EXPECT_LE(std::abs(power(cable, absorber, state)), 1e-6 * velocities_of(cable, state).norm());
    }
  }
}

TEST(CableElements, DampingTakesWhatRayleighsMatrixAndTheDamperDo) {
  test::Random random(363);
  for (const auto& absorber : all_absorbers) {
    const auto cable = cable_with(absorber, kollar_damping);
    const auto& chain = cable.chain();
    const Eigen::MatrixXd stiffness(tangent_stiffness(chain, cable.rest().nodes));
    for (int draw = 0; draw < 20; ++draw) {
      const auto state = random_state(cable, random);
      const auto v = velocities_of(cable, state);
      double loss = kollar_damping.stiffness_factor * v.dot(stiffness * v);
      for (int node = 0; node < chain.free_nodes(); ++node) {
        const bool carries =
            node == chain.loaded_node() && absorber.reading == AbsorberReading::rigid_mass;
        loss += kollar_damping.mass_factor * (chain.mass(node) + (carries ? 0.16 : 0.0)) *
                v.segment<2>(2 * node).squaredNorm();
      }
      const int own = 4 * chain.loaded_node();
      if (absorber.reading == AbsorberReading::spring_mass)
        loss += 4.0 * std::pow(state[own + 5] - state[own + 3], 2);
      EXPECT_GT(loss, 0.0);
      EXPECT_NEAR(power(cable, absorber, state) / loss, -1.0, 1e-5);
    }
  }
}

TEST(CableElements, RayleighsFactorsGiveTheRatioAtBothFrequencies) {
  for (const double frequency : {2.0, 7.0}) {
    const double omega = 2 * pi<double> * frequency;
    EXPECT_NEAR(
        kollar_damping.mass_factor / (2 * omega) + kollar_damping.stiffness_factor * omega / 2,
        0.02, 1e-15);
  }
}

TEST(CableElements, ItsSmallMotionsAreTheModesWithRayleighsDamping) {
  const auto conductor = kollar2022_conductor();
  const CableElements cable(conductor, conductor.span / 2, 10, {AbsorberReading::weight, 0.0},
                            kollar_damping);
  const Eigen::VectorXcd found =
      test::eigenvalues_of(analytic_jacobian(cable, cable.held_by(0.0).state));
  for (const auto& mode : elements_modes(conductor, 10, 8).modes) {
    const double omega = 2 * pi<double> * mode.frequency;
    const double decay =
        (kollar_damping.mass_factor + kollar_damping.stiffness_factor * omega * omega) / 2;
    const std::complex<double> pole(-decay, std::sqrt(omega * omega - decay * decay));
    EXPECT_LE((found.array() - pole).abs().minCoeff(), 1e-6 * omega) << mode.frequency;
  }
}

TEST(CableElements, BadInputIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double mass : {-0.1, nan})
    for (const auto reading : {AbsorberReading::weight, AbsorberReading::spring_mass})
      EXPECT_THROW(cable_with({reading, mass, 74.4, 4.0}, kollar_damping), InvalidParameter);
  const auto sprung = AbsorberReading::spring_mass;
  EXPECT_THROW(cable_with({sprung, 0.0, 74.4, 4.0}, kollar_damping), InvalidParameter);
  EXPECT_THROW(cable_with({sprung, 0.16}, kollar_damping), InvalidParameter);
  EXPECT_THROW(cable_with({sprung, 0.16, 74.4, -1.0}, kollar_damping), InvalidParameter);
  EXPECT_THROW(cable_with(all_absorbers[0], {-1.0, 0.0}), InvalidParameter);
  EXPECT_THROW(cable_with(all_absorbers[0], {0.0, nan}), InvalidParameter);
  EXPECT_THROW(cable_with(all_absorbers[0], kollar_damping, 1), InvalidParameter);
  EXPECT_THROW(rayleigh_damping(nan, 2.0, 7.0), InvalidParameter);
  EXPECT_THROW(rayleigh_damping(0.02, 0.0, 7.0), InvalidParameter);
  EXPECT_THROW(static_cast<void>(cable_with(all_absorbers[0], kollar_damping).held_by(nan)),
               InvalidParameter);
}

}  // namespace
}  // namespace holdfast
