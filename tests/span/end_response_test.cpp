#include "holdfast/span/end_response.hpp"

#include <cmath>
#include <complex>
#include <random>
#include <vector>

#include "holdfast/span/perfect_absorption.hpp"
#include "span/drake_span.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

using Complex = std::complex<double>;

EndResponse one_end(const TautString<double>& string, std::vector<SpanDevice> devices,
                    double frequency) {
  const auto ordered = in_order(std::move(devices), string.span);
  return end_response(string, span_ends(ordered, string.span)[0], turn_of(frequency));
}

/// One of every kind, near a support.
std::vector<SpanDevice> every_device(double place) {
  const LumpedDevice tuned{{tuned_branch(5.0, 20.0, 0.1)}, 0.2};
  const LumpedDevice inerter{{{20.0, -300.0, 4.0}}, 0.0};
  const LumpedDevice stock = stockbridge({4.0, {9.0, 24.0}, {0.15, 0.2}, 0.55, 0.4});
  const MeasuredImpedance measured({{10.0, {3.0, 40.0}}, {900.0, {250.0, -120.0}}});
  const ActiveAbsorber active{{5.0, 78956.8, 125.0, 0.01}, {1e-3, 4e-4}, {300.0, -40.0}, {}};
  return {{place, dashpot_of(180.0)}, {place, tuned}, {place, inerter}, {place, stock},
          {place, measured},          {place, active}};
}

TEST(EndResponse, OfOneDeviceIsTheFormula) {
  const auto string = drake_string();
  for (const double frequency : {4.0, 11.0, 21.3, 60.0, 120.0}) {
    for (const SpanDevice& device : every_device(1.37)) {
      const double ka = turn_of(frequency) * device.position / string.wave_speed();
      const Complex z = device.impedance(Complex(0.0, turn_of(frequency)));
      const Complex zeta = z / string.wave_impedance() - Complex(0.0, 1.0 / std::tan(ka));
      const Complex r = (1.0 - zeta) / (1.0 + zeta);
      const EndResponse end = one_end(string, {device}, frequency);
      EXPECT_NEAR(std::abs(end.reflection - r), 0.0, 1e-12);
      EXPECT_NEAR(std::abs(end.impedance / string.wave_impedance() - zeta), 0.0,
                  1e-12 * (1.0 + std::abs(zeta)));
    }
  }
}

TEST(EndResponse, IncidentPowerIsReflectedOrAbsorbed) {
  const auto string = drake_string();
  std::mt19937 random(26);
  std::uniform_real_distribution<double> frequencies(3.0, 140.0), places(0.3, 6.0);
  for (int k = 0; k < 300; ++k) {
    const double frequency = frequencies(random), omega = turn_of(frequency);
    std::vector<SpanDevice> devices;
    for (const SpanDevice& device : every_device(places(random))) {
      const EndResponse alone = one_end(string, {device}, frequency);
      // ½ Re Z |v|² at the device against ½ Z_c ω² |A|² (1 − |r|²), A of the wave that runs in:
      // the antinode is |A| (1 + |r|).
      const double taken =
          device.impedance(Complex(0.0, omega)).real() * std::pow(alone.motions[0], 2);
      const double incident =
          string.wave_impedance() / std::pow(1.0 + std::abs(alone.reflection), 2);
      EXPECT_NEAR(taken, incident * alone.absorbed_fraction(), 1e-12 * incident);
      devices.push_back(device);
      devices.back().position += 0.7 * static_cast<double>(devices.size());
    }
    const auto ordered = in_order(devices, string.span);
    const EndResponse all = end_response(string, span_ends(ordered, string.span)[0], omega);
    double taken = 0.0;
    for (std::size_t j = 0; j < ordered.size(); ++j)
      taken += ordered[j].impedance(Complex(0.0, omega)).real() * std::pow(all.motions[j], 2);
    const double incident = string.wave_impedance() / std::pow(1.0 + std::abs(all.reflection), 2);
    EXPECT_NEAR(taken, incident * all.absorbed_fraction(), 1e-12 * (incident + taken));
    EXPECT_NEAR(all.absorbed_power(string.wave_impedance(), omega), 0.5 * omega * omega * taken,
                1e-9 * omega * omega * (incident + taken));
  }
}

TEST(EndResponse, BestDashpotLeavesTheTangentOfHalfThePhase) {
  const auto string = drake_string();
  for (const double place : {0.4, 1.2, 1.5, 2.2}) {
    const double ka = turn_of(21.3) * place / string.wave_speed();
    const double best = string.wave_impedance() / std::abs(std::sin(ka));
    const double expected = std::tan(ka <= pi<double> / 2.0 ? ka / 2.0 : (pi<double> - ka) / 2.0);
    const auto ratio = [&](double damping) {
      return one_end(string, {{place, dashpot_of(damping)}}, 21.3).inverse_standing_wave_ratio();
    };
    EXPECT_NEAR(ratio(best), expected, 1e-12);
    EXPECT_LT(ratio(0.9 * best), expected);
    EXPECT_LT(ratio(1.1 * best), expected);
  }
}

TEST(EndResponse, BareEndSendsAllBack) {
  const auto string = drake_string();
  const EndResponse end = end_response(string, {}, turn_of(20.0));
  EXPECT_NEAR(std::abs(end.reflection), 1.0, 1e-15);
  EXPECT_NEAR(end.support_angle, turn_of(20.0) / string.wave_speed(), 1e-12);
}

TEST(EndResponse, EndsAreToldApart) {
  const auto devices =
      in_order({{299.0, dashpot_of(1.0)}, {1.0, dashpot_of(2.0)}, {298.0, dashpot_of(3.0)}}, 300.0);
  const auto ends = span_ends(devices, 300.0);
  EXPECT_EQ(ends[0].distances, std::vector<double>({1.0}));
  EXPECT_EQ(ends[1].distances, std::vector<double>({1.0, 2.0}));
  EXPECT_THROW(in_order({{300.0, dashpot_of(1.0)}}, 300.0), InvalidParameter);
}

TEST(PerfectAbsorption, LetsNoWaveComeBack) {
  const auto string = drake_string();
  for (const double frequency : {8.0, 21.3, 47.0}) {
    for (const double delay : {0.0, 1e-3, 4.2e-3}) {
      ActiveAbsorber active{{5.0, 78956.8, 125.0, 0.05}, {1e-3, delay}, {0.0, 0.0}, {}};
      active.hardware.drive_bandwidth = 80.0;
      active.gains = perfect_absorption(string, 1.5, active, turn_of(frequency));
      const EndResponse end = one_end(string, {{1.5, active}}, frequency);
      EXPECT_LT(std::abs(end.reflection), 1e-12);
      EXPECT_NEAR(end.inverse_standing_wave_ratio(), 1.0, 1e-12);
    }
  }
}

// The force straight on the conductor: D* = −Z_c sin(ka − ψ)/(s sin ka), P* = ω Z_c cos(ka − ψ)/(s
// sin ka).
TEST(PerfectAbsorption, OfAHeavyAbsorberIsThatOfTheForceAlone) {
  const auto string = drake_string();
  const double omega = turn_of(21.3), period = 1e-3, psi = omega * period / 2.0;
  const double ka = omega * 1.5 / string.wave_speed(), sinc = std::sin(psi) / psi;
  const ActiveAbsorber active{{1e12, 0.0, 0.0, 0.0}, {period, 0.0}, {0.0, 0.0}, {}};
  const PdGains<double> gains = perfect_absorption(string, 1.5, active, omega);
  EXPECT_NEAR(gains.differential,
              -string.wave_impedance() * std::sin(ka - psi) / (sinc * std::sin(ka)), 1e-8);
  EXPECT_NEAR(gains.proportional,
              omega * string.wave_impedance() * std::cos(ka - psi) / (sinc * std::sin(ka)), 1e-8);
  EXPECT_NEAR(gains.differential, -212.68, 5e-3);
  EXPECT_NEAR(gains.proportional, 3072.5, 5e-2);
  EXPECT_THROW(perfect_absorption(string, string.wave_speed() / 21.3 / 2.0, active, omega),
               InvalidParameter);
  EXPECT_THROW(perfect_absorption(string, 1.5, active, turn_of(1.0 / period)), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
