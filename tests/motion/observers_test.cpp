#include "holdfast/motion/observers.hpp"
#include "holdfast/motion/instant.hpp"

#include "support/testing.hpp"

namespace holdfast {
namespace {

MotionSample<double> sample_of(std::int64_t index, double displacement, bool engaged = true) {
  return {index, 0.1 * static_cast<double>(index), {displacement, 0.0, 0.0, 0.0}, 0.0, engaged};
}

template <class Observer>
void show(Observer& observer, std::initializer_list<double> displacements) {
  std::int64_t index = 0;
  for (const double displacement : displacements) observer(sample_of(index++, displacement));
}

TEST(PhaseExtent, IsTheLargestModulusOfDisplacementAndOfVelocity) {
  PhaseExtent extent(0.0);
  extent({0, 0.0, {2.0, -5.0, 99.0, 99.0}, 0.0, true});
  extent({1, 0.1, {-3.0, 4.0, 99.0, 99.0}, 0.0, true});
  EXPECT_EQ(extent.displacement(), 3.0);
  EXPECT_EQ(extent.velocity(), 5.0);
}

TEST(PhaseExtent, LeavesOutWhatCameBefore) {
  PhaseExtent extent(0.2);
  show(extent, {9.0, 8.0, 1.0, -2.0});
  EXPECT_EQ(extent.displacement(), 2.0);
}

TEST(SwitchLog, NotesEachChangeOfContactAtItsSample) {
  SwitchLog log;
  std::int64_t index = 0;
  for (const bool engaged : {true, true, false, false, true, false})
    log(sample_of(index++, 0.0, engaged));
  ASSERT_EQ(log.switches().size(), 3U);
  EXPECT_EQ(log.switches()[0].index, 2);
  EXPECT_TRUE(log.switches()[0].entered);
  EXPECT_EQ(log.switches()[1].index, 4);
  EXPECT_FALSE(log.switches()[1].entered);
  EXPECT_EQ(log.switches()[2].index, 5);
  EXPECT_DOUBLE_EQ(log.switches()[2].time, 0.5);
}

TEST(SwitchLog, FollowsTheContactBeforeItLogs) {
  SwitchLog log(0.25);
  std::int64_t index = 0;
  for (const bool engaged : {true, false, false, false, true})
    log(sample_of(index++, 0.0, engaged));
  ASSERT_EQ(log.switches().size(), 1U)
      << "the entry at 0.1 s came before, and is not logged at 0.3 s";
  EXPECT_FALSE(log.switches()[0].entered);
}

TEST(Recorder, KeepsEverySampleInOrder) {
  Recorder recorder(3);
  show(recorder, {1.0, 2.0, 3.0});
  ASSERT_EQ(recorder.samples().size(), 3U);
  EXPECT_EQ(recorder.samples()[2].index, 2);
  EXPECT_EQ(recorder.samples()[2].state[0], 3.0);
}

TEST(Instant, MeantAsASampleIsOne) {
  ASSERT_LT(5 * 0.011, 0.055) << "the example must be one where round-off comes early";
  EXPECT_TRUE(not_before(5 * 0.011, 0.055));
  EXPECT_FALSE(not_before(4 * 0.011, 0.055));
  EXPECT_TRUE(not_before(6 * 0.011, 0.055));
}

TEST(Instant, KeepsItsSideOfZero) {
  EXPECT_TRUE(not_before(0.0, 0.0));
  EXPECT_FALSE(not_before(-1e-3, 0.0));
  EXPECT_TRUE(not_before(-0.055, -0.055));
}

TEST(Instant, AnObserverTakesTheSampleThatItWasGiven) {
  PhaseExtent extent(0.055);
  MotionSample<double> sample{};
  sample.index = 5;
  sample.time = 5 * 0.011;
  sample.state[0] = 0.25;
  extent(sample);
  EXPECT_EQ(extent.displacement(), 0.25);
}

}  // namespace
}  // namespace holdfast
