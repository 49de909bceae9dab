// The modes of a hanging cable as its absorber sees them: against eigenvectors of the elements,
// against their linearised motion with the absorber, and against the taut string.

#include "holdfast/cable/cable_place_modes.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "holdfast/cable/elements.hpp"
#include "holdfast/plant/plant_poles.hpp"
#include "support/string_case.hpp"

namespace holdfast::test {
namespace {

using Complex = std::complex<double>;

BarChain papers_chain(int bars) { return {kollar2022_conductor(), 0.64, bars}; }

std::vector<PlaceMode<double>> damped(std::vector<PlaceMode<double>> modes,
                                      const RayleighDamping& damping) {
  for (auto& mode : modes) mode.damping_ratio = damping.damping_ratio(mode.angular_frequency);
  return modes;
}

/// Bar by bar, what its ends' motion carries: [5 1; 1 5]/12 of its mass, or [1 0; 0 1]/2.
Eigen::MatrixXd dense_masses(const BarChain& chain, BarMass mass) {
  const double own = mass == BarMass::averaged ? 5.0 / 12.0 : 0.5;
  Eigen::MatrixXd masses = Eigen::MatrixXd::Zero(2 * chain.free_nodes(), 2 * chain.free_nodes());
  const auto add = [&](int one, int other, double share) {
    if (one < 0 || other < 0 || one >= chain.free_nodes() || other >= chain.free_nodes()) return;
    for (int i = 0; i < 2; ++i) masses(2 * one + i, 2 * other + i) += share;
  };
  for (int e = 0; e < chain.elements(); ++e) {
    const double whole = chain.conductor().mass_per_length * chain.length(e);
    for (const int node : {e - 1, e}) add(node, node, own * whole);
    add(e - 1, e, (0.5 - own) * whole);
    add(e, e - 1, (0.5 - own) * whole);
  }
  return masses;
}

/// eᵀ((1 + βs)K + αsM + s²M)⁻¹e by a dense solve.
Complex dense_receptance(const BarChain& chain, const HungMass& hung, BarMass mass,
                         const RayleighDamping& damping, const Complex& s) {
  const auto rest = chain_equilibrium(chain, hung.weight * chain.conductor().gravity);
  Eigen::MatrixXd masses = dense_masses(chain, mass);
  masses(2 * chain.loaded_node(), 2 * chain.loaded_node()) += hung.sideways;
  const Eigen::MatrixXcd matrix =
      (1.0 + s * damping.stiffness_factor) *
          Eigen::MatrixXd(tangent_stiffness(chain, rest.nodes)).cast<Complex>() +
      s * (s + damping.mass_factor) * masses.cast<Complex>();
  const Eigen::Index place = 2 * chain.loaded_node() + 1;
  return matrix.partialPivLu().solve(Eigen::VectorXcd::Unit(matrix.rows(), place))[place];
}

TEST(CablePlaceModes, OfAllStepsAreTheElementsToRoundOff) {
  const BarChain chain = papers_chain(12);
  for (const BarMass mass : {BarMass::lumped, BarMass::averaged}) {
    for (const double sideways : {0.0, 0.17}) {
      const HungMass hung{0.16, sideways};
      const auto found = cable_place_modes(chain, hung, 22, mass);
      ASSERT_EQ(found.outcome, EquilibriumOutcome::converged);
      EXPECT_EQ(found.apart, 22);
      for (const double omega : {1.0, 30.0, 400.0, 1e4, 1e6}) {
        const Complex s(0.3 * omega, omega);
        const Complex expected = dense_receptance(chain, hung, mass, {0.0, 0.0}, s);
        EXPECT_LT(std::abs(receptance(found.modes, s) - expected), 1e-9 * std::abs(expected))
            << omega;
      }
    }
  }
}

/// Ten times fewer steps than degrees of freedom; the slow modes are there, and of the fast ones as
/// much as is seen through Rayleigh's damping.
TEST(CablePlaceModes, OfFewStepsAnswerAsTheElements) {
  const BarChain chain = papers_chain(300);
  const HungMass hung{0.16, 0.01};
  const RayleighDamping damping = rayleigh_damping(0.02, 2.0, 7.0);
  const auto found = cable_place_modes(chain, hung, 60);
  const auto modes = damped(found.modes, damping);
  EXPECT_GT(found.apart, 25);
  for (const double frequency : {0.5, 3.0, 10.0, 30.0, 100.0, 400.0, 1e4}) {
    const Complex s(0.0, 2.0 * pi<double> * frequency);
    const Complex expected = dense_receptance(chain, hung, BarMass::averaged, damping, s);
    EXPECT_LT(std::abs(receptance(modes, s) - expected),
              (frequency < 5.0 ? 1e-5 : 0.03) * std::abs(expected))
        << frequency;
  }
}

/// The poles of modes and absorber are the eigenvalues of the elements' own Jacobian with a mass on
/// a spring below their node, damped by Rayleigh, many of them more than critically.
TEST(CablePlaceModes, WithTheAbsorberMoveAsTheElements) {
  const RayleighDamping damping = rayleigh_damping(0.02, 2.0, 7.0);
  const Absorber<double> absorber = papers_absorber(0.0);
  constexpr int bars = 24;
  const CableElements elements(
      kollar2022_conductor(), 0.64, bars,
      {AbsorberReading::spring_mass, absorber.mass, absorber.stiffness, absorber.damping}, damping);
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(elements.states(), elements.states());
  elements.jacobian(elements.held_by(0.0).state.data(),
                    [&](int row, int column, double value) { jacobian(row, column) = value; });
  const Eigen::VectorXcd values = jacobian.eigenvalues();
  const auto modes = damped(
      cable_place_modes(elements.chain(), {absorber.mass}, 2 * (bars - 1), BarMass::lumped).modes,
      damping);
  const auto poles = plant_poles(modes, absorber);
  ASSERT_EQ(poles.size(), static_cast<std::size_t>(4 * (bars - 1) + 2));
  int overdamped = 0;
  for (const PlantPole& pole : poles) {
    overdamped += std::abs(pole.s.imag()) < 1e-9 * std::abs(pole.s) ? 1 : 0;
    EXPECT_LT((values.array() - pole.s).abs().minCoeff(), 1e-5 * std::abs(pole.s)) << pole.s;
  }
  EXPECT_GT(overdamped, 20);
}

PlaceMode<double> nearest(const CablePlaceModes& found, double omega) {
  return *std::min_element(
      found.modes.begin(), found.modes.end(), [&](const auto& one, const auto& other) {
        return std::abs(one.angular_frequency - omega) < std::abs(other.angular_frequency - omega);
      });
}

/// A cable of next to no sag and no load is the string of its bars, ω = (2c/l) sin(nπ/2N) of lumped
/// masses; averaged, they leave the true string by the fourth power of the bars' length.
TEST(CablePlaceModes, OfATautCableAreTheStrings) {
  Conductor<double> conductor = kollar2022_conductor();
  conductor.sag = 1e-5 * conductor.span;
  conductor.youngs_modulus = 1e5 * conductor.parabolic_tension() / conductor.area;
  constexpr int bars = 40;
  const BarChain chain(conductor, conductor.span / 5.0, bars);
  const auto lumped = cable_place_modes(chain, {0.0}, 38, BarMass::lumped);
  const auto averaged = cable_place_modes(chain, {0.0}, 38);
  const double wave = std::sqrt(conductor.parabolic_tension() / conductor.mass_per_length);
  for (int n = 1; n < 20; ++n) {
    if (n % 5 == 0) continue;                      // a node
    const double radians = n * pi<double> / bars;  // of the wave on a bar
    const double omega = wave * bars / conductor.span * radians;
    const double slow = 2.0 / radians * std::sin(radians / 2.0);
    const PlaceMode<double> mode = nearest(lumped, slow * omega);
    EXPECT_NEAR(mode.angular_frequency, slow * omega, 1e-4 * omega) << n;
    EXPECT_NEAR(nearest(averaged, omega).angular_frequency,
                omega * (1.0 - std::pow(radians, 4) / 480.0),
                (1e-4 + 0.001 * std::pow(radians, 6)) * omega)
        << n;
    const double effective = conductor.mass_per_length * conductor.span / 2.0 /
                             std::pow(std::sin(n * pi<double> / 5.0), 2);
    EXPECT_NEAR(1.0 / std::pow(mode.shape, 2), effective, 1e-3 * effective) << n;
  }
}

/// A long process finds each mode once: without exact orthogonality to the vectors before, slow
/// modes come again. A line has the modes of its string and those of waves along the conductor.
TEST(CablePlaceModes, NoneComesTwice) {
  Conductor<double> line = kollar2022_conductor();
  line.mass_per_length = 1.829;
  line.span = 350.0;
  line.sag = line.weight() * line.span / (8.0 * 30070.0);
  line.area = 5.47e-4;
  line.youngs_modulus = 6.9e10;
  const auto found = cable_place_modes(BarChain(line, 1.5, 1500), {5.0}, 400);
  const double across = pi<double> / line.span * std::sqrt(30070.0 / line.mass_per_length);
  const double along =
      pi<double> / line.span * std::sqrt(line.axial_stiffness() / line.mass_per_length);
  ASSERT_GT(found.apart, 110);
  for (int n = 1; n <= 100; ++n) {
    const int slower = n - 1 + static_cast<int>(n * across / along);
    EXPECT_NEAR(found.modes[static_cast<std::size_t>(slower)].angular_frequency, n * across,
                1.5 * across);
  }
}

/// No wave may come back from a bundle as from a mode: it is as wide as the way to its neighbours.
TEST(CablePlaceModes, BundlesAreWideAndModesAreNot) {
  const auto found = cable_place_modes(papers_chain(200), {0.16}, 80);
  ASSERT_LT(found.apart, 80);
  for (int n = 0; n < found.apart; ++n)
    EXPECT_EQ(found.modes[static_cast<std::size_t>(n)].damping_ratio, 0.0) << n;
  const auto at = static_cast<std::size_t>(found.apart) + 5;
  const double to_next =
      found.modes[at + 1].angular_frequency / found.modes[at].angular_frequency - 1.0;
  EXPECT_NEAR(found.modes[at].damping_ratio, 0.5 * to_next, 0.3 * to_next);
}

TEST(CablePlaceModes, RefuseWhatIsNotAdmissible) {
  const BarChain chain = papers_chain(10);
  EXPECT_THROW(cable_place_modes(chain, {-0.1}, 5), InvalidParameter);
  EXPECT_THROW(cable_place_modes(chain, {0.1, -0.1}, 5), InvalidParameter);
  EXPECT_THROW(cable_place_modes(chain, {0.1}, 0), InvalidParameter);
  EXPECT_THROW(cable_place_modes(chain, {0.1}, 19), InvalidParameter);
}

}  // namespace
}  // namespace holdfast::test
