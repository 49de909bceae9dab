#include "holdfast/motion/batch/lane_modes.hpp"

#include "holdfast/plant/energy.hpp"
#include "motion/batch/event_pack_setting.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

class LaneModesOfOne : public testing::Test {
 protected:
  static LaneExcitation<double> excitation_of(const DigitalLoop& loop) {
    return LaneExcitation<double>([&](std::size_t) -> const DigitalLoop& { return loop; });
  }

  test::ExactMotion motion_ = test::kollar_exact(0.005, 0.001, 0.002);
  EventTable table_{motion_.loop};
  LaneExcitation<double> excitation_ = excitation_of(motion_.loop.digital);
  LaneModes<double> modes_{{EventStart{&motion_.loop, &table_, motion_.state}}, excitation_};
  const std::array<double, 4> z_{0.001, -0.02, 0.0015, 0.03};
};

TEST_F(LaneModesOfOne, BeginsWithoutASign) {
  EXPECT_TRUE(modes_.engaged());
  EXPECT_FALSE(modes_.sticks());
  EXPECT_TRUE(modes_.fresh());
  EXPECT_TRUE(modes_.without_sign()[0]);
  EXPECT_FALSE(modes_.with_two_guards()[0]);
  EXPECT_EQ(modes_.guard(0).at(z_, 0.0), z_[3] - z_[1]);
}

TEST_F(LaneModesOfOne, TheStepIsThatOfItsMode) {
  excitation_.begin_sample(0);
  for (const std::size_t part : {0U, 1U}) {
    const auto after = modes_.step(part).state(z_, 0.3, excitation_);
    const auto& step = table_.motion(0).step(part);
    const Vector<double, 4> expected =
        step.state({z_[0], z_[1], z_[2], z_[3]}, 0.3, 0.0, {{0.5, 0.0}});
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(after[i], expected[static_cast<Eigen::Index>(i)], 1e-15);
  }
  EXPECT_NEAR(modes_.norm(z_), EnergyNorm(motion_.loop.plant)({z_[0], z_[1], z_[2], z_[3]}), 1e-15);
}

TEST_F(LaneModesOfOne, FollowsItsContactIntoTheGap) {
  DriveContact<>& contact = modes_.contact(0);
  contact.learn_sign(0, 1.0);
  ContactInstant now{{0.0, 0.0, 0.0, 0.0}, 0.0, 0.0};
  contact.reached(0, now);
  modes_.enter(0);
  EXPECT_EQ(contact.word(), ContactMode::gap);
  EXPECT_FALSE(modes_.engaged());
  EXPECT_TRUE(modes_.with_two_guards()[0]);
  EXPECT_TRUE(modes_.freshly_changed()[0]);
  // No force of the drive in the gap.
  EXPECT_EQ(modes_.accelerations(5.0)[0].constant, 0.0);
  modes_.flowed(0);
  EXPECT_FALSE(modes_.fresh());
  modes_.ignore_guards(0);
  EXPECT_FALSE(modes_.guarded());
  modes_.restart(0, motion_.state);
  EXPECT_TRUE(modes_.guarded());
  EXPECT_TRUE(modes_.engaged());
}

}  // namespace
}  // namespace holdfast
