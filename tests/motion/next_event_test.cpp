#include "holdfast/motion/next_event.hpp"

#include "support/testing.hpp"

namespace holdfast {
namespace {

/// z₁ grows at 1 m/s from 0, z₂ falls from 0 at 1 m/s, both for one second.
const AffineDynamics drifting{Matrix<double, 4>::Zero(), Vector<double, 4>::Zero(),
                              Vector<double, 4>::Zero(), Vector<double, 4>(1.0, 0.0, -1.0, 0.0)};
const ModeStretch<4> one_second{Vector<double, 4>::Zero(), 0.0, Series::Zero(3), 1.0};

Guard coordinate(int index, bool unsigned_yet) {
  return {Vector<double, 4>::Unit(index), 0.0, 0.0, 0.0, 0, unsigned_yet};
}

TEST(NextEvent, EachGuardLearnsItsOwnSign) {
  const NextEvent<4> event =
      next_event(drifting, {{coordinate(0, true), coordinate(2, true)}, 2}, one_second);
  EXPECT_EQ(event.guard, -1);
  EXPECT_EQ(event.signs[0], 1.0);
  EXPECT_EQ(event.signs[1], -1.0);
}

TEST(NextEvent, AGuardOfKnownSignLearnsNone) {
  const NextEvent<4> event =
      next_event(drifting, {{coordinate(2, true), coordinate(0, false)}, 2}, one_second);
  EXPECT_EQ(event.signs[0], -1.0);
  EXPECT_EQ(event.signs[1], 0.0);
}

}  // namespace
}  // namespace holdfast
