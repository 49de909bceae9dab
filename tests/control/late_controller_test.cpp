// Whole samples of delay as a controller's memory, against the loop map with all commands.

#include "holdfast/control/late_controller.hpp"

#include <Eigen/Eigenvalues>

#include "holdfast/control/loop_map.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "support/lagging_plant.hpp"
#include "support/message_of.hpp"
#include "support/testing.hpp"

namespace holdfast::test {
namespace {

using Column = Vector<double, Eigen::Dynamic>;

const PdGains<double> gains{-100.0, -3.0};

ImplementedLoopOf<ControlledPlant> late_loop(const Sampling<double>& sampling,
                                             const ControllerLimits& limits = {}) {
  const LateController law = late_controller(gains, limits, sampling);
  ImplementedLoopOf<ControlledPlant> loop{with_controller(through_ports(kollar2022_plant()), law),
                                          {},
                                          {ContactLaw::none},
                                          Switching::sampled};
  loop.digital.sampling = within_sample(sampling);
  return loop;
}

/// States are [x; the commands on their way]: x is what the map with all commands makes of it.
TEST(LateController, MovesAsTheMapWithAllItsCommands) {
  for (const double delay : {0.0, 0.0007, 0.001, 0.0013, 0.003, 0.0046}) {
    const Sampling<double> sampling{0.001, delay};
    const auto map = loop_map(through_ports(kollar2022_plant()), sampling).closed_map(gains);
    const auto loop = late_loop(sampling);
    Column state = Column::Zero(loop.plant.order()), mapped = Column::Zero(map.rows());
    state.head(4) << 0.001, -0.02, 0.003, 0.01;
    mapped.head(4) = state.head(4);
    auto motion = event_motion(loop, state);
    for (int j = 0; j < 400; ++j) {
      motion.sense();
      motion.advance();
      mapped = (map * mapped).eval();
      ASSERT_LT((motion.state().head(4) - mapped.head(4)).norm(), 1e-11) << delay << ' ' << j;
    }
  }
}

/// With limits and no whole sample of delay it is the built-in controller.
TEST(LateController, KeepsTheLimitsOfTheBuiltInController) {
  const ControllerLimits limits{1e-5, 1e-3, VelocitySensing::difference, 0.2};
  const Sampling<double> sampling{0.001, 0.0004};
  const auto loop = late_loop(sampling, limits);
  ImplementedLoopOf<LinearPlant<double>> built{
      through_ports(kollar2022_plant()), {}, {ContactLaw::none}, Switching::sampled};
  built.digital.sampling = sampling;
  built.digital.gains = gains;
  built.digital.limits = limits;
  Column state = Column::Zero(loop.plant.order());
  state.head(4) << 0.001, -0.02, 0.003, 0.01;
  auto motion = event_motion(loop, state);
  auto expected = event_motion(built, Column(state.head(4)));
  for (int j = 0; j < 300; ++j) {
    ASSERT_EQ(motion.sense().control_force, expected.sense().control_force) << j;
    motion.advance();
    expected.advance();
  }
}

/// Its own derivative against central differences.
TEST(LateController, DerivativeIsItsSlope) {
  for (const auto velocity : {VelocitySensing::measured, VelocitySensing::difference}) {
    const LateController law{gains, {0.0, 0.0, velocity, 5.0}, 3};
    Column at = Column::Zero(law.order());
    at.head(3) << 0.1, -0.3, 0.2;
    if (law.order() > 3) at.tail(2) << 0.0007, 1.0;
    const auto value = [&](double z, double v, const Column& before) {
      Column state = before, all(1 + before.size());
      all[0] = law.command({z, v, 0.001}, state);
      all.tail(before.size()) = state;
      return all;
    };
    const auto slope = law.derivative({0.0008, 0.01, 0.001}, at);
    const double step = 1e-6;
    for (Eigen::Index i = 0; i < slope.cols(); ++i) {
      // Whether there was a sample is no number to be moved.
      if (law.order() > 3 && i == slope.cols() - 1) continue;
      Column above = at, below = at;
      if (i > 1) above[i - 2] += step, below[i - 2] -= step;
      const double dz = i == 0 ? step : 0.0, dv = i == 1 ? step : 0.0;
      const Column expected =
          (value(0.0008 + dz, 0.01 + dv, above) - value(0.0008 - dz, 0.01 - dv, below)) /
          (2 * step);
      EXPECT_LT((slope.col(i) - expected).norm(), 1e-6 * (1.0 + expected.norm())) << i;
    }
  }
}

/// A delay of whole samples is one, whatever rounding makes of it.
TEST(LateController, WholeSamplesLeaveAWholeOne) {
  for (const double period : {1e-3, 5e-3, 1.1e-2, 7e-5, 0.003, 1.0 / 3.0})
    for (int k = 1; k <= 100; ++k) {
      const Sampling<double> sampling{period, k * period}, within = within_sample(sampling);
      EXPECT_NO_THROW(validate(within)) << period << ' ' << k;
      EXPECT_NEAR(within.processing_delay, period, 1e-11 * k * period) << period << ' ' << k;
      EXPECT_EQ(late_controller(gains, {}, sampling).samples, k - 1) << period << ' ' << k;
    }
}

TEST(LateController, RefusesAnotherSampling) {
  EXPECT_NE(
      tests::message_of<InvalidParameter>([] { late_controller(gains, {}, {0.0}); }).find("tau"),
      std::string::npos);
  EXPECT_NE(tests::message_of<InvalidParameter>([] {
              within_sample({0.001, -1.0});
            }).find("delay"),
            std::string::npos);
}

}  // namespace
}  // namespace holdfast::test
