#include "holdfast/phase_space/coverage.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/phase_space/deviation.hpp"
#include "holdfast/plant/linear_plant.hpp"

#include "support/kollar_case.hpp"
#include "support/lagging_plant.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

MotionSample<double> at(double displacement, double velocity) {
  return {0, 0.0, {displacement, velocity, 0.0, 0.0}, 0.0, true};
}

const PhaseWindow frame{-1.0, 1.0, 10.0, 14.0};

TEST(Coverage, CountsACellOnceHoweverOftenItIsVisited) {
  Coverage coverage(frame, 4);
  EXPECT_EQ(coverage.cells(), 16U);
  EXPECT_EQ(coverage.visited(), 0U);
  coverage(at(-0.9, 10.1));
  coverage(at(-0.6, 10.9));
  EXPECT_EQ(coverage.visited(), 1U);
  coverage(at(-0.4, 10.1));
  EXPECT_EQ(coverage.visited(), 2U);
  EXPECT_DOUBLE_EQ(coverage.visited_fraction(), 2.0 / 16.0);
}

TEST(Coverage, TheLowerEdgesBelongToTheWindowAndTheUpperDoNot) {
  Coverage coverage(frame, 4);
  coverage(at(1.0, 12.0));
  coverage(at(0.0, 14.0));
  coverage(at(-1.0001, 12.0));
  coverage(at(0.0, 9.999));
  EXPECT_EQ(coverage.visited(), 0U);
  coverage(at(-1.0, 10.0));
  EXPECT_EQ(coverage.visited(), 1U);
}

TEST(Coverage, SamplesThatAreNoNumbersVisitNothing) {
  Coverage coverage(frame, 4);
  coverage(at(std::numeric_limits<double>::quiet_NaN(), 12.0));
  coverage(at(0.0, std::numeric_limits<double>::infinity()));
  EXPECT_EQ(coverage.visited(), 0U);
}

TEST(Coverage, EveryCellIsReachedThroughItsMiddle) {
  Coverage coverage(frame, 7);
  for (int i = 0; i < 7; ++i) {
    for (int j = 0; j < 7; ++j)
      coverage(at(-1.0 + 2.0 * (i + 0.5) / 7.0, 10.0 + 4.0 * (j + 0.5) / 7.0));
  }
  EXPECT_EQ(coverage.visited(), 49U);
  EXPECT_EQ(coverage.visited_fraction(), 1.0);
}

TEST(Coverage, ATransitiveMotionFillsTheWindowAsChanceWould) {
  // n random throws leave each of N cells empty with probability (1 − 1/N)ⁿ.
  test::Random random(121);
  Coverage coverage(frame, 50);
  for (int draw = 0; draw < 5000; ++draw)
    coverage(at(random.uniform(-1, 1), random.uniform(10, 14)));
  EXPECT_NEAR(coverage.visited_fraction(), 1.0 - std::pow(1.0 - 1.0 / 2500.0, 5000), 0.02);
}

TEST(Coverage, WhatIsOutOfRangeIsRefused) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const PhaseWindow& bad : {PhaseWindow{1, 1, 0, 1},
                                 {1, 0, 0, 1},
                                 {0, 1, 0, 0},
                                 {0, infinity, 0, 1},
                                 {0, 1, std::numeric_limits<double>::quiet_NaN(), 1}}) {
    EXPECT_THROW(Coverage(bad, 4), InvalidParameter);
  }
  EXPECT_THROW(Coverage(frame, 0), InvalidParameter);
  EXPECT_THROW(Coverage(frame, 10'001), InvalidParameter);
}

TEST(Coverage, ReadsAPlantThroughItsPorts) {
  // The ports of the two masses with the conductor's states at the end.
  LinearPlant<double, 4> turned = linear_plant(kollar2022_plant());
  turned.connections.displacement = RowVector<double, 4>::Unit(2);
  turned.connections.velocity = RowVector<double, 4>::Unit(3);
  CoverageOf<LinearPlant<double, 4>> coverage(frame, 4,
                                              PortReadings<LinearPlant<double, 4>>(turned));
  Coverage expected(frame, 4);
  test::Random random(17);
  for (int k = 0; k < 20; ++k) {
    const double z = random.uniform(frame.displacement_min, frame.displacement_max);
    const double v = random.uniform(frame.velocity_min, frame.velocity_max);
    expected(at(z, v));
    coverage(MotionSample<double>{0, 0.0, {0.0, 0.0, z, v}, 0.0, true});
    EXPECT_EQ(coverage.visited(), expected.visited());
  }
  EXPECT_GT(expected.visited(), 5U);
}

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
