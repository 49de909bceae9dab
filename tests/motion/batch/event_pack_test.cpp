#include "holdfast/motion/batch/event_pack.hpp"

#include "motion/batch/event_pack_cases.hpp"

namespace holdfast {
namespace {

TEST(EventPack, RegularMotionsAreThoseOfEventMotion) {
  test::expect_regular_motions_are_those_alone<double>();
}
TEST(EventPack, RandomMotionsAreThoseOfEventMotion) {
  test::expect_random_motions_are_those_alone<double>();
}
TEST(EventPack, AMotionMayDiverge) { test::expect_a_diverging_lane_disturbs_no_other<double>(); }
TEST(EventPack, GrazingIsSurvived) { test::expect_grazing_is_survived<double>(); }
TEST(EventPack, EventsAtTheBorderOfAStep) { test::expect_events_at_the_border_of_a_step<double>(); }

TEST(EventPack, ALaneBeginsAgain) {
  const test::ExactMotion motion = test::kollar_exact(0.005, 0.001);
  EventTable table(motion.loop);
  EventPack<double> pack({EventStart{&motion.loop, &table, motion.state}});
  for (int j = 0; j < 100; ++j) {
    pack.sense();
    pack.advance();
  }
  const Vector<double, 4> after = pack.state(0);
  pack.restart(0, motion.state);
  pack.restart_index(0);
  for (int j = 0; j < 100; ++j) {
    pack.sense();
    pack.advance();
  }
  EXPECT_EQ(pack.state(0), after);
  EXPECT_EQ(pack.index(), 100);
  pack.sleep(0);
  pack.sense();
  pack.advance();
  EXPECT_TRUE(pack.state(0).isZero());
}

}  // namespace
}  // namespace holdfast
