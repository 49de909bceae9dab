#include "holdfast/contact/contact.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/motion/observers.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

// The two models of a motion, of four states and of seven.
static_assert(is_motion_v<SampledMotion<double>>);
static_assert(is_motion_v<SampledMotion<long double>>);
static_assert(is_motion_v<EventMotion<>>);
static_assert(is_motion_v<EventMotion<>>);
static_assert(is_motion_v<HarmonicallyForcedMotion<double, LinearPlant<double, 7>>>);
static_assert(is_motion_v<EventMotion<DriveContact<LinearPlant<double, 7>>>>);
static_assert(!is_motion_v<Recorder>);

template <class Plant>
void expect_the_same_samples(const IdealLoop<double, Plant>& loop) {
  const StateOf<Plant> rest = StateOf<Plant>::Zero();
  auto sampled = harmonically_forced_motion(loop, rest);
  auto event = event_motion(implemented_loop(loop), rest);
  int changes = 0;
  bool engaged = true;
  for (int j = 0; j < 400; ++j) {
    if (j == 100) {
      sampled.displace_conductor(0.001);
      event.displace_conductor(0.001);
    }
    const auto one = sampled.sense();
    const auto other = event.sense();
    ASSERT_EQ(one.index, other.index);
    ASSERT_EQ(one.time, other.time);
    ASSERT_EQ(one.engaged, other.engaged) << j;
    ASSERT_NEAR(one.control_force, other.control_force, 1e-9) << j;
    ASSERT_LE((one.state - other.state).norm(), 1e-11) << j;
    changes += one.engaged != engaged ? 1 : 0;
    engaged = one.engaged;
    sampled.advance();
    event.advance();
  }
  EXPECT_GT(changes, 10);
}

TEST(Motion, BothModelsShowTheSameSamplesOfOrderSeven) {
  const auto plant =
      with_drive_lag(with_measurement_filter(linear_plant(kollar2022_plant()), 80.0), 60.0, 0.7);
  for (const ForceHold hold : {ForceHold::sampled, ForceHold::exact})
    expect_the_same_samples(IdealLoop<double, LinearPlant<double, 7>>{
        plant, {0.005, 0.001}, {-200.0, -5.0}, {0.5, 10.0}, 0.0005, hold});
}

TEST(Motion, BothModelsShowTheSameSamplesOfTheIdealLoop) {
  for (const ForceHold hold : {ForceHold::sampled, ForceHold::exact}) {
    for (const double fraction : {0.0, 0.4}) {
      IdealLoop<double> loop{kollar2022_plant(),
                             {0.003, fraction * 0.003},
                             {-557.0, -13.0},
                             {0.5, 10.0},
                             0.0005,
                             hold};
      expect_the_same_samples(loop);
      expect_the_same_samples(IdealLoop<double, LinearPlant<double, 4>>{
          linear_plant(loop.plant), loop.sampling, loop.gains, loop.excitation, loop.backlash_width,
          loop.hold});
    }
  }
}

}  // namespace
}  // namespace holdfast
