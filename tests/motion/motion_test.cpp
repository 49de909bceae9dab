#include "holdfast/contact/contact.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/motion/observers.hpp"
#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/motion/trajectory.hpp"

#include "support/kollar_case.hpp"
#include "support/random.hpp"
#include "support/reference/sample_excitation.hpp"
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

using test::KollarCase;

TEST(SampledMotion, FollowsTheExtendedMaps) {
  // z̃ = [z; previous force] steps by S outside the backlash and by S* inside, for any delay.
  for (const double fraction : {0.0, 0.4, 1.0}) {
    KollarCase which;
    which.processing_delay = fraction * which.sampling_period;
    const auto samples = test::record(which, 2.0);
    const auto loop = which.loop();
    const Matrix<double, 5> engaged = loop.engaged_map(which.gains), idle = loop.backlash_map();
    double previous_force = 0.0;
    int inside = 0;
    for (std::size_t j = 0; j + 1 < samples.size(); ++j) {
      Vector<double, 5> extended;
      extended << samples[j].state, previous_force;
      Vector<double, 5> next = (samples[j].engaged ? engaged : idle) * extended;
      next.head<4>() +=
          loop.held_excitation *
          sample_excitation(which.excitation, which.sampling_period, samples[j].index).cosine;
      ASSERT_LE((next.head<4>() - samples[j + 1].state).cwiseAbs().maxCoeff(), 1e-14);
      ASSERT_NEAR(next[4], samples[j].control_force, 1e-12);
      previous_force = samples[j].control_force;
      inside += samples[j].engaged ? 0 : 1;
    }
    EXPECT_GT(inside, 100);
    EXPECT_LT(inside, 1900);
  }
}

TEST(SampledMotion, ADelayedForceArrivesLate) {
  // The whole period late: nothing of the first command is felt in the first step, all of it in the
  // second.
  KollarCase which;
  which.width = 0.0;
  which.excitation.amplitude = 0.0;
  which.initial_state << 0.001, 0.0, 0.0, 0.0;
  KollarCase late = which, off = which.without_control();
  late.processing_delay = late.sampling_period;
  const auto prompt = test::record(which, 0.002), delayed = test::record(late, 0.002),
             idle = test::record(off, 0.002);
  EXPECT_EQ(delayed[1].state, idle[1].state);
  EXPECT_NE(prompt[1].state, idle[1].state);
  const Vector<double, 4> felt = delayed[2].state - idle[2].state;
  const Vector<double, 4> expected = which.loop().present_force * delayed[0].control_force;
  EXPECT_LE((felt - expected).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_DOUBLE_EQ(delayed[0].control_force, -0.557);
}

TEST(SampledMotion, ADisplacedConductorIsSeenByTheNextSample) {
  auto motion = KollarCase{}.motion();
  motion.displace_conductor(0.003);
  EXPECT_EQ(motion.sense().state[0], 0.003);
}

}  // namespace
}  // namespace holdfast
