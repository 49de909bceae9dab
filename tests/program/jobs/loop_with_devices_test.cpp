// Linear answers about a conductor with devices beside the absorber, against sums over the modes of
// the bare conductor with the devices taken into account one by one.

#include <array>
#include <complex>

#include "case/model/linear_loop.hpp"
#include "case/model/modal/conductor_modes.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "program/case/case_text.hpp"

namespace holdfast::program {
namespace {

using Complex = std::complex<double>;

constexpr double damping = 150.0, place = 2.1;  // N s/m, m

Case with_dashpot(const std::string& period) {
  return tests::from_text("",
                          {"plant.model=string", "plant.modes=12", "absorber.clamp_mass=0.02",
                           "device.1.kind=dashpot", "device.1.position=2.1", "device.1.damping=150",
                           "backlash.width=0", "control.sampling_period=" + period});
}

/// z/F at the absorber's place: H_aa − H_ad K H_da/(1 + K H_dd), and the absorber upon it.
Complex receptance_by_modes(const Case& the_case, const Complex& s) {
  const TautString<double> string = string_of(the_case);
  const std::array<double, 2> places = {the_case.absorber.position, place};
  std::array<std::array<Complex, 2>, 2> h{};
  for (int n = 1; n <= 12; ++n) {
    const double omega = string.angular_frequency(n);
    const auto shape = [&](double x) { return std::sin(n * pi<double> * x / string.span); };
    const Complex divisor =
        s * s + 2.0 * bare_damping_of(the_case, omega) * omega * s + omega * omega;
    for (const std::size_t i : {0U, 1U})
      for (const std::size_t k : {0U, 1U})
        h[i][k] += shape(places[i]) * shape(places[k]) /
                   (0.5 * string.mass_per_length * string.span * divisor);
  }
  const Complex stiffness = damping * s;
  const Complex bare = h[0][0] - h[0][1] * stiffness * h[1][0] / (1.0 + stiffness * h[1][1]);
  return place_response(bare, absorber_of(the_case), s).to_force;
}

TEST(LoopWithDevices, WithoutControlIsTheReceptanceOfAllTogether) {
  const Case the_case = with_dashpot("0.001");
  for (const double frequency : {3.0, 9.7, 10.0, 31.0}) {
    const Complex s(0.0, 2.0 * pi<double> * frequency);
    const double expected = std::abs(receptance_by_modes(the_case, s));
    EXPECT_NEAR(true_amplitude_of(the_case, s.imag()), expected, 1e-8 * expected) << frequency;
  }
}

/// A computer without delay to speak of gives z = H F/(1 − (P + sD) T_a H).
TEST(LoopWithDevices, UnderAFastComputerIsThatOfContinuousFeedback) {
  const Case the_case = with_dashpot("0.00001");
  const PdGains<double> gains{-300.0, -6.0};
  for (const double frequency : {3.0, 9.7, 14.0}) {
    const Complex s(0.0, 2.0 * pi<double> * frequency);
    const Complex open = receptance_by_modes(the_case, s);
    const Complex command = gains.proportional + s * gains.differential;
    const Complex share = detail::transmitted_share(absorber_of(the_case), s);
    const double expected = std::abs(1.0 / (1.0 - command * share * open));
    EXPECT_NEAR(LinearLoop(the_case).response(frequency).ratio_to_uncontrolled(gains), expected,
                2e-3 * expected)
        << frequency;
  }
}

/// A device that does next to nothing changes next to nothing, wherever it is asked about.
TEST(LoopWithDevices, GoesOverIntoTheOneWithout) {
  const std::vector<std::string> bare = {"plant.model=string", "plant.modes=12",
                                         "absorber.clamp_mass=0.02", "backlash.width=0"};
  std::vector<std::string> light = bare;
  light.insert(light.end(),
               {"device.1.kind=dashpot", "device.1.position=2.1", "device.1.damping=1e-6"});
  const Case without = tests::from_text("", bare), with = tests::from_text("", light);
  const double p = gains_of(without).proportional;
  const auto one = LinearLoop(without).response(10.0).best_differential_gain(
      p, LinearLoop(without).stable_gains(FreeGain::differential, gains_of(without)));
  const auto other = LinearLoop(with).response(10.0).best_differential_gain(
      p, LinearLoop(with).stable_gains(FreeGain::differential, gains_of(with)));
  EXPECT_NEAR(other.ratio_to_uncontrolled, one.ratio_to_uncontrolled, 1e-6);
  EXPECT_NEAR(other.differential_gain, one.differential_gain,
              1e-4 * std::abs(one.differential_gain));
  MaxDelayOptions question;
  question.frequency = 10.0;
  question.proportional_gain = p;
  const double period = LinearLoop(without).longest_period(question).sampling_period;
  EXPECT_NEAR(LinearLoop(with).longest_period(question).sampling_period, period, 1e-4 * period);
}

}  // namespace
}  // namespace holdfast::program
