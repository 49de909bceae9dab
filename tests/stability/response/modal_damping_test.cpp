// Damping of the conductor's modes, against eigenvalues of the loop's map and the law of a light
// device.

#include "holdfast/stability/response/modal_damping.hpp"

#include <Eigen/Eigenvalues>

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/control/loop_map.hpp"
#include "support/string_case.hpp"
#include "support/testing.hpp"

namespace holdfast::test {
namespace {

using Complex = std::complex<double>;

std::vector<PlaceMode<double>> papers_modes(int count) {
  return string_modes(taut_string(kollar2022_conductor()), 0.64, count);
}

/// How far λ is from the nearest of the eigenvalues, which is taken out.
double distance_taken(std::vector<Complex>& eigenvalues, const Complex& lambda) {
  const auto nearest = std::min_element(eigenvalues.begin(), eigenvalues.end(),
                                        [&](const Complex& a, const Complex& b) {
                                          return std::abs(a - lambda) < std::abs(b - lambda);
                                        });
  const double distance = std::abs(*nearest - lambda);
  eigenvalues.erase(nearest);
  return distance;
}

TEST(ModalDamping, EachModeIsAnEigenvalueOfTheMapOfItsOwn) {
  for (const Sampling<double> sampling :
       {Sampling<double>{0.001, 0.0}, Sampling<double>{0.003, 0.003},
        Sampling<double>{0.01, 0.002}}) {
    for (const double clamp_mass : {0.0, 0.01}) {
      for (const PdGains<double> gains :
           {PdGains<double>{0.0, 0.0}, PdGains<double>{-557.0, -4.0},
            PdGains<double>{-557.0, -13.0}, PdGains<double>{300.0, 20.0}}) {
        const auto modes = papers_modes(37);
        const auto absorber = papers_absorber(clamp_mass);
        const Eigen::VectorXcd roots =
            loop_map(modal_plant(modes, absorber), sampling).closed_map(gains).eigenvalues();
        std::vector<Complex> eigenvalues(roots.begin(), roots.end());
        const auto found = modal_damping(modes, absorber, sampling, gains);
        ASSERT_EQ(found.size(), modes.size());
        for (const ModeDamping& mode : found) {
          const Complex lambda = std::exp(mode.root * sampling.period);
          EXPECT_LT(distance_taken(eigenvalues, lambda), 1e-8)
              << mode.angular_frequency << " rad/s, tau " << sampling.period << ", D "
              << gains.differential;
        }
      }
    }
  }
}

/// A device a millionth as heavy on a conductor that hardly damps: what it adds is what the law of
/// first order says, above half the sampling rate too.
TEST(ModalDamping, IsThatOfTheFirstOrderLawForALightDevice) {
  constexpr double light = 1e-6;
  auto modes = papers_modes(60);
  for (PlaceMode<double>& mode : modes) mode.damping_ratio = 1e-5;
  Absorber<double> absorber = papers_absorber(0.01);
  for (double* part :
       {&absorber.mass, &absorber.stiffness, &absorber.damping, &absorber.clamp_mass})
    *part *= light;
  const Sampling<double> sampling{0.01, 0.003};
  const PdGains<double> gains{-557.0 * light, -9.0 * light};
  int compared = 0;
  for (const ModeDamping& mode : modal_damping(modes, absorber, sampling, gains)) {
    const double exact = mode.damping() - mode.bare, law = mode.first_order - mode.bare;
    if (std::abs(law) < 1e-9) continue;  // a node, or what the device leaves alone
    EXPECT_NEAR(exact / law, 1.0, 2e-3) << mode.angular_frequency;
    ++compared;
  }
  EXPECT_GT(compared, 40);
}

/// s = −ω e^{±iφ} of the one mode that a place sees: the two masses' own eigenvalues.
TEST(ModalDamping, OfOneModeIsThatOfTwoMasses) {
  const PlaceMode<double> mode{12.0, 0.03, 0.5, 0.4};
  const Absorber<double> absorber{0.05, 6.0, 0.02};
  const Eigen::VectorXcd expected = two_masses_of(mode, absorber).state_matrix().eigenvalues();
  std::vector<Complex> eigenvalues(expected.begin(), expected.end());
  const auto found = modal_damping({mode}, absorber, {0.001, 0.0}, {0.0, 0.0});
  EXPECT_LT(distance_taken(eigenvalues, found.front().root), 1e-10);
}

TEST(ModalDamping, AModeWithANodeAtTheAbsorberIsLeftAlone) {
  const auto modes = string_modes(taut_string(kollar2022_conductor()), 3.2, 4);  // mid-span
  const auto found = modal_damping(modes, papers_absorber(0.01), {0.001, 0.0}, {-557.0, -4.0});
  for (const std::size_t even : {1U, 3U}) {
    EXPECT_NEAR(found[even].damping(), found[even].bare, 1e-12);
    EXPECT_NEAR(found[even].first_order, found[even].bare, 1e-12);
  }
  EXPECT_GT(std::abs(found[0].damping() - found[0].bare), 1e-3);
}

TEST(ModalDamping, RefusesWhatIsNotAdmissible) {
  EXPECT_THROW(modal_damping({}, papers_absorber(0.0), {0.001}, {0.0, 0.0}), InvalidParameter);
  EXPECT_THROW(modal_damping(papers_modes(3), papers_absorber(-0.1), {0.001}, {0.0, 0.0}),
               InvalidParameter);
  EXPECT_THROW(modal_damping(papers_modes(3), papers_absorber(0.0), {0.0}, {0.0, 0.0}),
               InvalidParameter);
}

}  // namespace
}  // namespace holdfast::test
