// Measurement filter and drive as poles behind those of the plant, against the plant's own matrix.

#include "holdfast/plant/loop_hardware.hpp"

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/plant/conductor_with_absorber.hpp"
#include "holdfast/stability/boundary/unit_circle_crossings.hpp"
#include "holdfast/stability/response/modal_damping.hpp"
#include "holdfast/stability/response/modal_response.hpp"
#include "holdfast/stability/response/modal_steady_response.hpp"
#include "support/message_of.hpp"
#include "support/string_loop.hpp"

namespace holdfast::test {
namespace {

constexpr double ideal = LoopHardware::ideal;

ConductorWithAbsorber conductor(int modes, const LoopHardware& hardware) {
  return string_with_absorber(modes, 0.02, hardware);
}

const std::vector<LoopHardware> kinds = {{80.0, ideal, ideal}, {ideal, 60.0, ideal},
                                         {ideal, 60.0, 0.7},   {ideal, 60.0, 3.0},
                                         {80.0, 60.0, ideal},  {300.0, 40.0, 0.5}};

double difference(const ConductorWithAbsorber& of, const Sampling<double>& sampling) {
  const StringLoop loop{of, sampling};
  return off_elimination(loop.doubles(), loop.map());
}

TEST(LoopHardware, ItsPolesAreThoseOfThePlantBehindIt) {
  for (const LoopHardware& hardware : kinds)
    for (const double delay : {0.0, 0.0004, 0.0033}) {
      EXPECT_LT(difference(conductor(1, hardware), {0.001, delay}), 1e-8);
      EXPECT_LT(difference(conductor(20, hardware), {0.001, delay}), 1e-8);
    }
}

/// A critically damped drive, and a filter as slow as the drive, have no partial fractions.
TEST(LoopHardware, EqualPolesAreTakenApart) {
  EXPECT_LT(difference(conductor(9, {ideal, 60.0, 1.0}), {0.001}), 1e-6);
  EXPECT_LT(difference(conductor(9, {60.0, 60.0, ideal}), {0.001}), 1e-6);
  EXPECT_LT(difference(conductor(9, {60.0, 60.0, 1.0}), {0.001}), 1e-4);
}

TEST(LoopHardware, NoPolesWhereOneIsThePlants) {
  const std::vector<PlantPole> poles = {{-377.0, 0.5}, {-20.0, -0.5}};
  EXPECT_TRUE(with_hardware(poles, {377.0 / (2.0 * pi<double>), ideal, ideal}).empty());
  EXPECT_EQ(with_hardware(poles, {}).size(), 2U);
}

TEST(LoopHardware, RefusesWhatIsNoHardware) {
  const auto message = [](const LoopHardware& hardware) {
    return tests::message_of<InvalidParameter>([&] { validate(hardware); });
  };
  EXPECT_NE(message({0.0}).find("measurement filter"), std::string::npos);
  EXPECT_NE(message({1.0, -1.0}).find("drive bandwidth"), std::string::npos);
  EXPECT_NE(message({1.0, 1.0, 0.0}).find("drive damping"), std::string::npos);
}

/// Roots and stable gains by winding are those of the eigenvalues of the map.
TEST(LoopHardware, StabilityIsThatOfTheEigenvalues) {
  Random random(20264);
  int stable = 0, compared = 0;
  for (const LoopHardware& hardware : kinds) {
    const ConductorWithAbsorber of = conductor(9, hardware);
    const Sampling<double> sampling{0.002, 0.0011};
    const ModalResponse<double> response = modal_response(of, sampling);
    const UnitCircleCrossings<double> circle(response);
    const LoopMap<double> map = loop_map(linear_plant(of), sampling);
    for (int draw = 0; draw < 20; ++draw) {
      const PdGains<double> gains{random.uniform(-900.0, 300.0), random.uniform(-15.0, 8.0)};
      const double radius = spectral_radius(map.closed_map(gains));
      EXPECT_NEAR(std::abs(largest_loop_root(response, gains)), radius, 1e-8);
      if (std::abs(radius - 1.0) < 1e-9) continue;
      EXPECT_EQ(circle.roots_outside(gains) == 0, radius < 1.0) << draw;
      stable += radius < 1.0 ? 1 : 0;
      ++compared;
    }
  }
  EXPECT_GT(stable, 10);
  EXPECT_LT(stable, compared - 10);
}

/// Poles known or not.
TEST(LoopHardware, SteadyResponseIsThatOfThePlant) {
  const std::vector<PdGains<double>> every = {{0.0, 0.0}, {-557.0, -4.0}, {90.0, 2.0}};
  for (std::size_t k = 0; k < 2 * kinds.size(); ++k) {
    ConductorWithAbsorber of = conductor(9, kinds[k / 2]);
    const LinearPlant<double> plant = linear_plant(of);
    if (k % 2 == 1) of.poles.clear();
    for (const ForceHold hold : {ForceHold::sampled, ForceHold::exact})
      for (const double omega : {21.0, 62.8, 400.0}) {
        const Sampling<double> sampling{0.002, 0.0031};
        const auto found = steady_response(of, sampling, hold, omega);
        const auto expected = steady_response(plant, sampling, hold, omega);
        for (const PdGains<double>& gains : every) {
          const double amplitude = expected.amplitude_per_force(gains);
          EXPECT_NEAR(found.amplitude_per_force(gains), amplitude, 1e-9 * amplitude);
        }
        EXPECT_NEAR(found.squared_ratio(-557.0).at(-4.0), expected.squared_ratio(-557.0).at(-4.0),
                    1e-8 * expected.squared_ratio(-557.0).at(-4.0));
      }
  }
}

/// The first-order law knows filter and drive: of a light device it is the exact damping.
TEST(LoopHardware, ModalDampingOfALightDeviceIsItsFirstOrder) {
  auto modes = papers_modes(6);
  for (auto& mode : modes) {
    mode.mass *= 1e6;
    mode.damping_ratio = 1e-5;
  }
  const auto found = modal_damping(modes, papers_absorber(0.0), {0.002, 0.0011}, {-300.0, -5.0},
                                   {80.0, 60.0, 0.7});
  const auto ideal_loop =
      modal_damping(modes, papers_absorber(0.0), {0.002, 0.0011}, {-300.0, -5.0});
  double largest = 0.0;
  for (std::size_t n = 0; n < modes.size(); ++n) {
    const double added = found[n].damping() - found[n].bare;
    EXPECT_NEAR(found[n].first_order - found[n].bare, added, 1e-3 * std::abs(added)) << n;
    largest =
        std::max(largest, std::abs(ideal_loop[n].damping() - found[n].damping()) / std::abs(added));
  }
  EXPECT_GT(largest, 0.05);
}

}  // namespace
}  // namespace holdfast::test
