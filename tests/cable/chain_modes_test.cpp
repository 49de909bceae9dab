#include "holdfast/cable/chain_modes.hpp"

#include "support/testing.hpp"

namespace holdfast {
namespace {

/// A string of strain 1 % and next to no sag: λ² below 1e-4.
Conductor<double> taut_string() {
  auto conductor = kollar2022_conductor();
  conductor.sag = 1e-4 * conductor.span;
  conductor.youngs_modulus = 100.0 * conductor.parabolic_tension() / conductor.area;
  return conductor;
}

/// Frequency (Hz) of the n-th mode of the taut string: H on the mass per unstretched length, which
/// the strain spreads over more length.
double string_frequency(const Conductor<double>& conductor, int n) {
  const HangingCable<double> cable(conductor);
  const double stretched = conductor.mass_per_length * cable.unstretched_length() / conductor.span;
  return n / (2 * conductor.span) * std::sqrt(cable.bare_tension() / stretched);
}

/// The same of N equal bars: ω² = (2 − 2 cos θ) H/(l m), θ = nπ/N, with m the lumped mass of a
/// node.
double chain_string_frequency(const Conductor<double>& conductor, int elements, int n) {
  const double turn = n * pi<double> / elements;
  return string_frequency(conductor, n) * std::sin(turn / 2) / (turn / 2);
}

double mode_frequency(const Conductor<double>& conductor, int elements, int n) {
  return elements_modes(conductor, elements, n).modes.back().frequency;
}

TEST(ChainModes, TheyAreTheEigenvectorsOfStiffnessAndMass) {
  const auto conductor = kollar2022_conductor();
  const BarChain chain(conductor, conductor.span / 2, 20);
  const Eigen::MatrixXd stiffness(tangent_stiffness(chain, chain_equilibrium(chain, 0.0).nodes));
  const Eigen::VectorXd masses = detail::mass_matrix(chain, BarMass::lumped).diagonal();
  const auto found = elements_modes(conductor, 20, 38);
  ASSERT_EQ(found.outcome, EquilibriumOutcome::converged);
  ASSERT_EQ(found.modes.size(), 38U);
  double previous = 0.0;
  for (const auto& mode : found.modes) {
    const double squared = std::pow(2 * pi<double> * mode.frequency, 2);
    EXPECT_LE((stiffness * mode.shape - squared * masses.cwiseProduct(mode.shape)).norm(),
              1e-11 * stiffness.norm());
    EXPECT_NEAR(mode.shape.cwiseAbs().maxCoeff(), 1.0, 1e-14);
    EXPECT_GE(mode.frequency, previous);
    previous = mode.frequency;
  }
}

TEST(ChainModes, TheMassesAreTheCables) {
  const auto conductor = kollar2022_conductor();
  const BarChain chain(conductor, conductor.span / 2, 20);
  const Eigen::VectorXd masses = detail::mass_matrix(chain, BarMass::lumped).diagonal();
  // Of the outer bars only a part moves with the free nodes.
  const double bar = conductor.mass_per_length * chain.length(0);
  EXPECT_NEAR(masses.sum(), 2 * (18 + 2 * 0.5) * bar, 1e-14);
}

TEST(ChainModes, ATautStringOfBarsHasItsClosedForm) {
  const auto conductor = taut_string();
  for (int n = 1; n <= 4; ++n)
    EXPECT_NEAR(mode_frequency(conductor, 20, n) / chain_string_frequency(conductor, 20, n), 1.0,
                1e-5)
        << n;
}

TEST(ChainModes, OnATautStringTheyAreLowByTheSquareOfTheLength) {
  const auto conductor = taut_string();
  // Antisymmetric ones, which the little sag that is left leaves alone.
  for (const int n : {2, 4}) {
    const double limit = string_frequency(conductor, n);
    const auto miss = [&](int elements) {
      return mode_frequency(conductor, elements, n) / limit - 1.0;
    };
    for (const int elements : {16, 32}) {
      EXPECT_LT(miss(elements), 0.0);
      EXPECT_NEAR(std::log2(miss(elements) / miss(2 * elements)), 2.0, 0.1) << n;
    }
  }
}

TEST(ChainModes, FamiliesAreThoseOfTheShapes) {
  const auto found = elements_modes(kollar2022_conductor(), 40, 6);
  for (const auto& mode : found.modes) {
    const double sign = mode.family == ModeFamily::symmetric ? 1.0 : -1.0;
    for (Eigen::Index node = 0; node < 39; ++node)
      EXPECT_NEAR(mode.shape[2 * node + 1], sign * mode.shape[2 * (38 - node) + 1], 1e-7);
  }
}

/// The paper's conductor with another sag ratio and Young's modulus, λ² held.
Conductor<double> shallower(double sag_ratio, double parameter) {
  auto conductor = kollar2022_conductor();
  conductor.sag = sag_ratio * conductor.span;
  conductor.youngs_modulus *= parameter / conductor.irvine_parameter();
  return conductor;
}

/// Relative difference between the elements' frequencies, freed of the error of their length, and
/// Irvine–Caughey's, for the first `count` modes.
std::vector<double> apart_from_irvine(const Conductor<double>& conductor, int count) {
  const auto coarse = elements_modes(conductor, 60, count).modes;
  const auto fine = elements_modes(conductor, 120, count).modes;
  const auto irvine = irvine_modes(conductor, count);
  std::vector<double> apart;
  for (std::size_t k = 0; k < irvine.size(); ++k) {
    const double limit = fine[k].frequency + (fine[k].frequency - coarse[k].frequency) / 3;
    apart.push_back(std::abs(limit / irvine[k].frequency - 1.0));
    EXPECT_EQ(fine[k].family, irvine[k].family) << k;
  }
  return apart;
}

TEST(ChainModes, TheyApproachIrvineAndCaugheyWithTheSquareOfTheSagRatio) {
  for (const double parameter : {20.0, 400.0}) {
    const auto deep = apart_from_irvine(shallower(1.0 / 20, parameter), 4);
    const auto middle = apart_from_irvine(shallower(1.0 / 80, parameter), 4);
    const auto shallow = apart_from_irvine(shallower(1.0 / 320, parameter), 4);
    for (std::size_t k = 0; k < deep.size(); ++k) {
      EXPECT_NEAR(std::log(deep[k] / middle[k]) / std::log(4.0), 2.0, 0.2) << parameter << ' ' << k;
      EXPECT_LT(shallow[k], 0.1 * middle[k]) << parameter << ' ' << k;
      EXPECT_LT(shallow[k], 1e-4) << parameter << ' ' << k;
    }
  }
}

TEST(ChainModes, BadInputIsRefused) {
  auto conductor = kollar2022_conductor();
  for (const int elements : {-2, 0, 1, 11})
    EXPECT_THROW(elements_modes(conductor, elements, 1), InvalidParameter) << elements;
  for (const int count : {0, 19, -1})
    EXPECT_THROW(elements_modes(conductor, 10, count), InvalidParameter) << count;
  EXPECT_NO_THROW(elements_modes(conductor, 10, 18));
  conductor.sag = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(elements_modes(conductor, 10, 1), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
