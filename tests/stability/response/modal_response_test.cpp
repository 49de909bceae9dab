// Transfer functions as sums over eigenvalues, against the elimination of LoopResponse.

#include <Eigen/Eigenvalues>

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/control/loop_map.hpp"
#include "holdfast/stability/boundary/unit_circle_crossings.hpp"
#include "holdfast/stability/margins/loop_form.hpp"
#include "holdfast/stability/response/modal_damping.hpp"
#include "holdfast/stability/response/modal_response.hpp"
#include "holdfast/stability/response/modal_steady_response.hpp"

#include "support/lagging_plant.hpp"
#include "support/string_case.hpp"
#include "support/string_loop.hpp"

namespace holdfast::test {
namespace {

template <class Plant>
void expect_same(const Plant& plant, const Sampling<double>& sampling, double tolerance) {
  EXPECT_LT(off_elimination(ModalResponse<double>(plant, sampling), loop_map(plant, sampling)),
            tolerance);
}

TEST(ModalResponse, IsThatOfTheEliminationForAnyDelay) {
  for (const double delay : {0.0, 0.0004, 0.001, 0.0027, 0.01}) {
    expect_same(through_ports(kollar2022_plant()), {0.001, delay}, 1e-9);
    expect_same(lagging_plant(), {0.001, delay}, 1e-9);
    const auto modes = papers_modes(20);
    expect_same(modal_plant<double>(modes, {0.16, 74.4, 4.0, 0.01}), {0.001, delay}, 1e-9);
  }
}

/// A critically damped drive has a double eigenvalue, which no sum over eigenvalues can bear.
TEST(ModalResponse, HoldsWhereEigenvaluesCoincide) {
  const auto plant = lagging_plant(80.0, 60.0, kollar2022_plant(), 1.0);
  expect_same(plant, {0.001, 0.0004}, 1e-13);
}

/// Its poles and the force's, against the map of its plant.
TEST(ModalResponse, OfTheSteadyLoopIsThatOfTheMap) {
  const Absorber<double> absorber{0.16, 74.4, 4.0, 0.01};
  for (const int count : {1, 9}) {
    const auto modes = papers_modes(count);
    const ConductorWithAbsorber conductor{modes, absorber, plant_poles(modes, absorber)};
    const auto plant = modal_plant(modes, absorber);
    for (const double omega : {3.0, 21.0, 62.8, 700.0}) {
      EXPECT_NEAR(true_amplitude_per_force({modes, absorber, {}}, omega),
                  true_amplitude_per_force(plant, omega),
                  1e-9 * true_amplitude_per_force(plant, omega));
      for (const double delay : {0.0, 0.001, 0.01}) {
        for (const ForceHold hold : {ForceHold::sampled, ForceHold::exact}) {
          const Sampling<double> sampling{0.006, delay};
          const auto found = steady_response(conductor, sampling, hold, omega);
          const auto expected = steady_response(plant, sampling, hold, omega);
          for (const PdGains<double> gains :
               {PdGains<double>{0.0, 0.0}, PdGains<double>{-557.0, -4.0},
                PdGains<double>{90.0, 2.0}}) {
            const double amplitude = expected.amplitude_per_force(gains);
            EXPECT_NEAR(found.amplitude_per_force(gains), amplitude, 1e-9 * amplitude)
                << count << ' ' << omega << ' ' << delay;
          }
        }
      }
    }
  }
}

TEST(ModalResponse, CountsWhatGrowsByItself) {
  TwoMass<double> masses = kollar2022_plant();
  EXPECT_EQ(ModalResponse<double>(through_ports(masses), {0.001}).unstable_poles(), 0);
  LinearPlant<double> plant = through_ports(masses);
  plant.released_matrix += 5.0 * Eigen::MatrixXd::Identity(4, 4);
  EXPECT_EQ(ModalResponse<double>(plant, {0.001}).unstable_poles(), 2);
}

TEST(ModalResponse, RefusesWhatIsNotAdmissible) {
  LinearPlant<double> plant = through_ports(kollar2022_plant());
  EXPECT_THROW(ModalResponse<double>(plant, {0.0}), InvalidParameter);
  EXPECT_THROW((ModalResponse<double>(plant, {0.001, -0.001})), InvalidParameter);
  EXPECT_THROW((ModalResponse<double>(plant, {0.001, 2.0})), InvalidParameter);
  plant.released_matrix(0, 0) = NAN;
  EXPECT_THROW(ModalResponse<double>(plant, {0.001}), InvalidParameter);
}

/// A computer that has the velocity from its readings, against the map that remembers the reading
/// before: transfer functions, roots on circles of two radii, steady amplitudes.
TEST(VelocityByDifference, IsTheMapWithAReadingMore) {
  const auto plant = through_ports(kollar2022_plant());
  for (const Sampling<double> sampling :
       {Sampling<double>{0.001}, Sampling<double>{0.01}, Sampling<double>{0.001, 0.0004},
        Sampling<double>{0.002, 0.002}, Sampling<double>{0.004, 0.0097}}) {
    const auto response = ModalResponse<double>(plant, sampling).with_sensor(false);
    const auto map = with_velocity_by_difference(loop_map(plant, sampling));
    EXPECT_LT(off_elimination(response, map), 1e-8);
    for (const PdGains<double> gains : {PdGains<double>{-557.0, -4.0}, PdGains<double>{-900.0, 3.0},
                                        PdGains<double>{50.0, 0.0}}) {
      const auto radius = [&](const Matrix<double, Eigen::Dynamic>& closed) {
        return closed.eigenvalues().cwiseAbs().maxCoeff();
      };
      const double expected = radius(map.closed_map(gains));
      EXPECT_NEAR(std::abs(largest_loop_root(response, gains)), expected, 1e-9);
      EXPECT_NEAR(1.25 * std::abs(largest_loop_root(*response.at_radius(0.25), gains)), expected,
                  1e-9);
      const auto roots = loop_roots(response, gains);
      const auto values = map.closed_map(gains).eigenvalues().eval();
      double least = 0.0;
      for (const auto& root : roots)
        least = std::max(least, (values.array() - root).abs().minCoeff());
      EXPECT_LT(least, 1e-6);  // roots next to 0 are not told better by eigenvalues
      const int outside = static_cast<int>((values.cwiseAbs().array() > 1.0).count());
      EXPECT_EQ(UnitCircleCrossings<double>(response).roots_outside(gains), outside);
    }
    for (const double omega : {21.0, 62.8}) {
      const auto input = harmonic_input(plant, loop_map(plant, sampling), ForceHold::exact, omega);
      HarmonicInput<double, Eigen::Dynamic> wider{Vector<double, Eigen::Dynamic>::Zero(map.size()),
                                                  Vector<double, Eigen::Dynamic>::Zero(map.size())};
      wider.cosine.head(map.size() - 1) = input.cosine;
      wider.sine.head(map.size() - 1) = input.sine;
      const SteadyResponse<double> expected(map, wider, omega);
      const auto found = steady_response(plant, sampling, ForceHold::exact, omega)
                             .with_velocity_by_difference(omega * sampling.period, sampling.period);
      for (const PdGains<double> gains :
           {PdGains<double>{-557.0, -4.0}, PdGains<double>{90.0, 2.0}})
        EXPECT_NEAR(found.amplitude_per_force(gains), expected.amplitude_per_force(gains),
                    1e-9 * expected.amplitude_per_force(gains));
    }
  }
}

// Damping of the conductor's modes, against eigenvalues of the loop's map and the law of a light
// device.

using Complex = std::complex<double>;

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
