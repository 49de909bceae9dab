// A size that no bounded motion reaches, against motions.

#include "holdfast/motion/divergence.hpp"

#include "holdfast/motion/trajectory.hpp"
#include "support/lagging_plant.hpp"
#include "support/testing.hpp"

namespace holdfast::test {
namespace {

IdealLoop<double> loop_of(double differential) {
  return {kollar2022_plant(), {0.001, 0.0}, {-557.0, differential},
          {0.5, 10.0},        0.0005,       ForceHold::sampled};
}

double largest_of(const IdealLoop<double>& loop, const Vector<double, 4>& state) {
  auto motion = harmonically_forced_motion(loop, state);
  double largest = 0.0;
  run_trajectory(motion, 20000, {}, [&](const MotionSample<double>& sample) {
    largest = std::max(largest, sample.state.cwiseAbs().maxCoeff());
  });
  return largest;
}

TEST(DivergenceBound, IsBeyondBoundedMotionsAndBeforeGrowingOnes) {
  const Vector<double, 4> rest = Vector<double, 4>::Zero();
  const auto bound = [&](double differential) {
    return divergence_bound(implemented_loop(loop_of(differential)), rest);
  };
  EXPECT_LT(largest_of(loop_of(-13.0), rest), 1e-9 * bound(-13.0));
  EXPECT_GT(largest_of(loop_of(20.0), rest), bound(20.0));
}

/// Twice the force, the play and the state: twice the bound.
TEST(DivergenceBound, GrowsWithAllThatSetsTheScale) {
  IdealLoop<double> loop = loop_of(-13.0);
  const Vector<double, 4> state(0.001, 0.0, 0.0, 0.02);
  const double once = divergence_bound(implemented_loop(loop), state);
  loop.excitation.amplitude *= 2.0;
  loop.backlash_width *= 2.0;
  const double twice = divergence_bound(implemented_loop(loop), Vector<double, 4>(2.0 * state));
  EXPECT_NEAR(twice, 2.0 * once, 1e-12 * once);
}

/// A plant with ports gives the same as the two masses that it is.
TEST(DivergenceBound, OfAnyOrderIsThatOfTheTwoMasses) {
  const IdealLoop<double> loop = loop_of(-13.0);
  const IdealLoop<double, LinearPlant<double>> through{
      through_ports(loop.plant), loop.sampling,       loop.gains,
      loop.excitation,           loop.backlash_width, loop.hold};
  const Vector<double, 4> state(0.001, 0.0, 0.0, 0.02);
  const double expected = divergence_bound(implemented_loop(loop), state);
  EXPECT_NEAR(divergence_bound(implemented_loop(through), Eigen::VectorXd(state)), expected,
              1e-9 * expected);
}

}  // namespace
}  // namespace holdfast::test
