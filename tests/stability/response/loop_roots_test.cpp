// All roots of a loop at once, against the eigenvalues of its map; and what bundled modes say of
// the lowest stable gain, against the closed limit of an infinite string.

#include "holdfast/stability/response/modal_response.hpp"

#include <Eigen/Eigenvalues>

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/control/loop_map.hpp"
#include "support/string_case.hpp"

namespace holdfast::test {
namespace {

using Complex = std::complex<double>;

/// The largest distance of an element of either from the nearest of the other.
double distance(const std::vector<Complex>& one, const std::vector<Complex>& other) {
  const auto one_way = [](const std::vector<Complex>& from, const std::vector<Complex>& to) {
    double largest = 0.0;
    for (const Complex& a : from) {
      double least = std::numeric_limits<double>::infinity();
      for (const Complex& b : to) least = std::min(least, std::abs(a - b));
      largest = std::max(largest, least / std::max(1.0, std::abs(a)));
    }
    return largest;
  };
  return std::max(one_way(one, other), one_way(other, one));
}

/// Of the map, whose eigenvalue 0 of a command without delay is no root.
std::vector<Complex> eigenvalues_of(const std::vector<PlaceMode<double>>& modes,
                                    const Absorber<double>& absorber,
                                    const Sampling<double>& sampling,
                                    const PdGains<double>& gains) {
  const Eigen::VectorXcd values =
      loop_map(modal_plant(modes, absorber), sampling).closed_map(gains).eigenvalues();
  return {values.begin(), values.end()};
}

/// Of a string, and of one with few modes and bundles behind.
TEST(LoopRoots, AreTheEigenvaluesOfTheMap) {
  const TautString<double> string = taut_string(kollar2022_conductor());
  const auto largest = [](const std::vector<Complex>& roots) {
    double modulus = 0.0;
    for (const Complex& root : roots) modulus = std::max(modulus, std::abs(root));
    return modulus;
  };
  for (const double period : {1e-4, 0.01})
    for (const double late : {0.0, 0.3, 2.5})
      for (const bool bundled : {false, true})
        for (const PdGains<double> gains :
             {PdGains<double>{-557.0, -13.0}, PdGains<double>{0.0, 0.0},
              PdGains<double>{2000.0, -40.0}}) {
          const auto modes = bundled ? bundled_string_modes(string, 0.64, 6, 500.0)
                                     : string_modes(string, 0.64, 20);
          const Sampling<double> sampling{period, late * period};
          const auto absorber = papers_absorber(bundled ? 0.01 : 0.0);
          auto found = loop_roots(modal_response(modes, absorber, sampling), gains);
          ASSERT_FALSE(found.empty()) << period << ' ' << late << ' ' << gains.proportional;
          if (late == 0.0) found.emplace_back(0.0);
          const auto expected = eigenvalues_of(modes, absorber, sampling, gains);
          EXPECT_EQ(found.size(), expected.size());
          // Near 0, where the dead ones crowd, the matrix has few digits.
          EXPECT_LT(distance(found, expected), bundled ? 1e-3 : 1e-9)
              << period << ' ' << late << ' ' << gains.proportional;
          EXPECT_NEAR(largest(found) / largest(expected), 1.0, 1e-10);
        }
}

/// Random plants with nodes, light and heavy absorbers: what is found is right, and most is found.
TEST(LoopRoots, OfRandomPlantsAreRightOrNotFound) {
  Random random(20251126);
  int found = 0;
  constexpr int plants = 300;
  for (int k = 0; k < plants; ++k) {
    const std::vector<PlaceMode<double>> modes = random_modes(random, 0.3);
    const double mass = random.log_uniform(0.01, 1.0), own = modes.front().angular_frequency;
    const Absorber<double> absorber{mass, mass * own * own,
                                    random.log_uniform(0.01, 1.0) * mass * own,
                                    k % 2 == 0 ? 0.0 : 0.05};
    const double period = random.log_uniform(0.01, 2.0) / own;
    const Sampling<double> sampling{period, k % 3 == 0 ? 0.0 : random.uniform(0.0, 3.0) * period};
    const PdGains<double> gains{mass * own * own * random.uniform(-1.0, 1.0),
                                mass * own * random.uniform(-1.0, 1.0)};
    auto roots = loop_roots(modal_response(modes, absorber, sampling), gains);
    if (roots.empty()) continue;
    ++found;
    if (sampling.processing_delay == 0.0) roots.emplace_back(0.0);
    EXPECT_LT(distance(roots, eigenvalues_of(modes, absorber, sampling, gains)), 1e-6) << k;
  }
  EXPECT_GT(found, plants * 9 / 10);
}

/// What has died out leaves roots near 0 where a command comes between two samples.
TEST(LoopRoots, AreFoundForEveryDelay) {
  const auto modes =
      bundled_string_modes(taut_string(kollar2022_conductor()), 0.64, 30, 30.0 / 1e-3);
  const auto poles = plant_poles(modes, papers_absorber(0.0));
  for (int k = 0; k <= 50; ++k) {
    const auto response = modal_response(poles, {1e-3, 1e-3 * k / 16.0});
    EXPECT_FALSE(loop_roots(response, PdGains<double>{-557.0, -4.0}).empty()) << k;
  }
}

TEST(LoopRoots, AreNotFoundWhereTheResponseHasNoPoles) {
  // Critically damped absorber on a conductor that it does not reach.
  const std::vector<PlaceMode<double>> modes{{6.0, 0.02, 0.0, 1.0}};
  const ModalResponse<double> response = modal_response(modes, {1.0, 4.0, 4.0}, {0.01});
  EXPECT_TRUE(loop_roots(response, PdGains<double>{1.0, 1.0}).empty());
  const auto longest = modal_response(string_modes(taut_string(kollar2022_conductor()), 0.64, 3),
                                      papers_absorber(0.0), {1e-3, 0.03});
  EXPECT_TRUE(loop_roots(longest, PdGains<double>{1.0, 1.0}).empty());
}

/// D at which λ = −1 is a root, P = 0: on an infinite string with a clamp −C coth(Cτ/(2 M_c)),
/// C = c₂ + 2 Z_c; without a clamp −C.
TEST(BundledModes, HaveTheLimitOfTheInfiniteString) {
  const TautString<double> string = taut_string(kollar2022_conductor());
  const double dashpots = kollar2022_plant().absorber_damping + 2.0 * string.wave_impedance();
  for (const double period : {1e-5, 1e-4}) {
    for (const double clamp_mass : {0.0, 0.001, 0.01}) {
      const double limit = clamp_mass == 0.0
                               ? -dashpots
                               : -dashpots / std::tanh(dashpots * period / (2.0 * clamp_mass));
      for (const int apart : {60, 125}) {
        const auto modes = bundled_string_modes(string, 0.64, apart, 100.0 / period);
        const auto response = modal_response(modes, papers_absorber(clamp_mass), {period});
        const double found = (1.0 / response.at_angle(pi<double>).velocity).real();
        EXPECT_NEAR(found / limit, 1.0, 0.03) << period << ' ' << clamp_mass << ' ' << apart;
        // What is cut off instead acts as a clamp.
        const auto cut = modal_response(string_modes(string, 0.64, apart),
                                        papers_absorber(clamp_mass), {period});
        EXPECT_LT((1.0 / cut.at_angle(pi<double>).velocity).real(), found);
      }
    }
  }
}

}  // namespace
}  // namespace holdfast::test
