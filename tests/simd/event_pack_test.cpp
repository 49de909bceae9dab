#include "holdfast/motion/batch/event_pack.hpp"

#include "holdfast/simd/pack.hpp"
#include "motion/batch/event_pack_cases.hpp"

namespace holdfast {
namespace {

using EventLanes = simd::Pack<double>;

TEST(EventPacks, RegularMotionsAreThoseOfEventMotion) {
  test::expect_regular_motions_are_those_alone<EventLanes>();
}
TEST(EventPacks, RandomMotionsAreThoseOfEventMotion) {
  test::expect_random_motions_are_those_alone<EventLanes>();
}
TEST(EventPacks, LanesDoNotSeeEachOther) { test::expect_lanes_do_not_see_each_other<EventLanes>(); }
TEST(EventPacks, ADivergingLaneDisturbsNoOther) {
  test::expect_a_diverging_lane_disturbs_no_other<EventLanes>();
}
TEST(EventPacks, GrazingIsSurvived) { test::expect_grazing_is_survived<EventLanes>(); }
TEST(EventPacks, EventsAtTheBorderOfAStep) {
  test::expect_events_at_the_border_of_a_step<EventLanes>();
}

}  // namespace
}  // namespace holdfast
