// Kollár 2022, Fig. 9: the steady motions in the phase plane, and how often they repeat.

#include "support/kollar_case.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

using test::kollar_case;
using test::KollarCase;

/// Largest |z(t + lag) − z(t)| over the last `lag` samples of a long motion, relative to the
/// motion's size.
double closure(const KollarCase& which, double duration, std::size_t lag) {
  const auto samples = test::record(which, duration);
  double gap = 0, size = 0;
  for (std::size_t j = samples.size() - lag; j < samples.size(); ++j) {
    gap = std::max(gap, (samples[j].state - samples[j - lag].state).norm());
    size = std::max(size, samples[j].state.norm());
  }
  return gap / size;
}

TEST(Figure9, TheMotionOfHalfAMillimetreRepeatsWithTheForcing) {
  EXPECT_LT(closure(kollar_case(0.001, 0.0005), 60.0, 100), 1e-9);
}

TEST(Figure9, TheMotionOfTwoMillimetresRepeatsEveryFiveForcingPeriods) {
  EXPECT_LT(closure(kollar_case(0.001, 0.002), 60.0, 500), 1e-9);
  for (const std::size_t forcing_periods : {1U, 2U, 3U, 4U}) {
    EXPECT_GT(closure(kollar_case(0.001, 0.002), 60.0, 100 * forcing_periods), 1e-3)
        << forcing_periods;
  }
}

TEST(Figure9, TheIrregularMotionOfElevenMillisecondsIsBounded) {
  for (const auto& sample : test::record(kollar_case(0.011, 0.002), 1000.0)) {
    ASSERT_LT(sample.state.cwiseAbs().maxCoeff(), 1.0);
  }
}

TEST(Figure9, TheIrregularMotionRepeatsAfterTwentyThreeSeconds) {
  EXPECT_LT(closure(kollar_case(0.011, 0.002), 1000.0, 2100), 1e-9);
  EXPECT_GT(closure(kollar_case(0.011, 0.002), 1000.0, 100), 1e-3);
}

TEST(Figure9, AForceAWholePeriodLateWouldMakeThatMotionDiverge) {
  KollarCase late = kollar_case(0.011, 0.0);
  late.processing_delay = 0.011;
  auto motion = late.motion();
  EXPECT_EQ(run_trajectory(motion, 100'000, std::nullopt), TrajectoryOutcome::diverged);
}

}  // namespace
}  // namespace holdfast
