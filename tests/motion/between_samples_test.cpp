#include "holdfast/motion/between_samples.hpp"
#include "holdfast/plant/two_mass.hpp"

#include <gtest/gtest.h>

#include "support/kollar_case.hpp"

namespace holdfast {
namespace {

ForcedLoop<double> delayed_loop(ForceHold hold) {
  return {kollar2022_plant(), {0.01, 0.004}, {-557.0, -13.0}, {0.5, 10.0}, 0.002, hold};
}

TEST(BetweenSamples, TheWholePeriodIsTheNextSample) {
  for (const ForceHold hold : {ForceHold::sampled, ForceHold::exact}) {
    const ForcedLoop<double> loop = delayed_loop(hold);
    const BetweenSamples between(loop);
    auto motion = harmonically_forced_motion(loop, Vector<double, 4>(1e-3, 0, -1e-3, 0.1));
    for (int j = 0; j < 200; ++j) {
      const double before = motion.memory().previous_force;
      const auto sample = motion.sense();
      motion.advance();
      const Vector<double, 4> next = between.state(sample, before, loop.sampling.period);
      EXPECT_LE((next - motion.state()).norm(), 1e-13 * (1.0 + motion.state().norm())) << j;
      EXPECT_EQ(between.state(sample, before, 0.0), sample.state);
    }
  }
}

TEST(BetweenSamples, ItsDerivativeIsThatOfThePlantUnderTheForceThatActs) {
  const ForcedLoop<double> loop = delayed_loop(ForceHold::exact);
  const BetweenSamples between(loop);
  auto motion = harmonically_forced_motion(loop, Vector<double, 4>(1e-3, 0.02, -1e-3, 0.1));
  motion.sense();
  motion.advance();
  const double before = motion.memory().previous_force;
  const auto sample = motion.sense();
  ASSERT_NE(before, sample.control_force);
  for (const double after : {0.002, 0.007}) {
    const double step = 1e-5, acting = after < 0.004 ? before : sample.control_force;
    const Vector<double, 4> slope = (between.state(sample, before, after + step) -
                                     between.state(sample, before, after - step)) /
                                    (2 * step);
    const double omega = loop.excitation.angular_frequency();
    const double force = loop.excitation.amplitude * std::cos(omega * (sample.time + after));
    const Vector<double, 4> expected =
        loop.plant.state_matrix() * between.state(sample, before, after) +
        loop.plant.control_input() * acting + loop.plant.excitation_input() * force;
    EXPECT_LE((slope - expected).norm(), 1e-6 * expected.norm()) << after;
  }
}

}  // namespace
}  // namespace holdfast
