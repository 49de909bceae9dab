#include "holdfast/phase_space/deviation.hpp"

#include "holdfast/motion/implemented_loop.hpp"
#include "support/kollar_case.hpp"
#include "support/lagging_plant.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

using test::KollarCase;

TEST(Deviation, OfAMotionFromItselfIsExactlyZero) {
  auto first = KollarCase{}.motion(), second = KollarCase{}.motion();
  std::int64_t seen = 0;
  run_deviation(first, second, 5000, [&](const Deviation& deviation) {
    ++seen;
    ASSERT_EQ(deviation.displacement, 0.0);
    ASSERT_EQ(deviation.state, 0.0);
  });
  EXPECT_EQ(seen, 5000);
}

TEST(Deviation, WithoutBacklashIsThePowerOfTheMapTimesTheOffset) {
  KollarCase here, there;
  here.width = there.width = 0.0;
  there.initial_state[0] = 1e-5;
  auto first = here.motion(), second = there.motion();
  const Matrix<double, 5> step = here.loop().engaged_map(here.gains);
  Vector<double, 5> offset = Vector<double, 5>::Unit(0) * 1e-5;
  run_deviation(first, second, 2000, [&](const Deviation& deviation) {
    ASSERT_NEAR(deviation.displacement, offset[0], 1e-16);
    ASSERT_NEAR(deviation.state, offset.head<4>().norm(), 1e-14);
    offset = step * offset;
  });
  EXPECT_LT(offset.head<4>().norm(), 1e-5) << "a stable loop forgets where it began";
}

TEST(Deviation, StopsWhereAMotionDiverges) {
  KollarCase wild;
  wild.gains = {0.0, 5000.0};
  wild.width = 0.0;
  KollarCase other = wild;
  other.initial_state[0] = 1e-5;
  auto first = wild.motion(), second = other.motion();
  bool all_finite = true;
  const auto outcome = run_deviation(first, second, 1'000'000, [&](const Deviation& deviation) {
    all_finite = all_finite && std::isfinite(deviation.displacement);
  });
  EXPECT_EQ(outcome, TrajectoryOutcome::diverged);
  EXPECT_TRUE(all_finite);
}

TEST(Deviation, OfADriveWithStatesOfItsOwnIsThatOfTheConductor) {
  const ImplementedLoop ideal = implemented_loop(KollarCase{}.ideal_loop());
  const auto plant = with_drive_lag(test::through_ports(ideal.plant), 20.0);
  const ImplementedLoopOf<LinearPlant<double>> loop{plant, ideal.digital, ideal.backlash,
                                                    Switching::exact};
  auto first = event_motion(loop, Eigen::VectorXd::Zero(5).eval()), second = first;
  second.displace_conductor(1e-5);
  std::int64_t seen = 0;
  run_deviation(first, second, 1000, [&](const Deviation& deviation) {
    if (seen++ == 0) {
      EXPECT_NEAR(deviation.displacement, 1e-5, 1e-20);
    }
    EXPECT_EQ(deviation.displacement, second.state()[0] - first.state()[0]);
    EXPECT_EQ(deviation.state, (second.state() - first.state()).norm());
  });
  EXPECT_EQ(seen, 1000);
}

}  // namespace
}  // namespace holdfast
