#include "holdfast/motion/batch/event_pack.hpp"
#include "holdfast/motion/batch/event_table.hpp"

#include "motion/batch/event_pack_cases.hpp"
#include "motion/batch/event_pack_setting.hpp"
#include "support/move_samples.hpp"

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
  test::move_samples(pack, 100);
  const Vector<double, 4> after = pack.state(0);
  pack.restart(0, motion.state);
  pack.restart_index(0);
  test::move_samples(pack, 100);
  EXPECT_EQ(pack.state(0), after);
  EXPECT_EQ(pack.index(), 100);
  pack.sleep(0);
  pack.sense();
  pack.advance();
  EXPECT_TRUE(pack.state(0).isZero());
}

TEST(EventTable, ServesLoopsThatDifferInGainsAndPlay) {
  const ImplementedLoop loop = test::kollar_exact(0.005, 0.001).loop;
  const EventTable table(loop);
  ImplementedLoop other = loop;
  other.digital.gains = {-1.0, -2.0};
  other.backlash.width = 0.0;
  EXPECT_TRUE(table.serves(other));
  for (const auto& change : std::vector<std::function<void(ImplementedLoop&)>>{
           [](auto& of) { of.plant.absorber_mass *= 1.01; },
           [](auto& of) { of.digital.sampling.period *= 1.01; },
           [](auto& of) { of.digital.sampling.processing_delay = 1e-4; },
           [](auto& of) { of.digital.force.harmonics[0].phase = 0.1; },
           [](auto& of) { of.digital.force.harmonics.clear(); },
           [](auto& of) { of.digital.hold = ForceHold::sampled; },
           [](auto& of) { of.backlash.law = ContactLaw::dead_zone; }}) {
    other = loop;
    change(other);
    EXPECT_FALSE(table.serves(other));
  }
}

TEST(EventTable, ADeadZoneIsServedWithItsOwnStopsAlone) {
  ImplementedLoop loop = test::kollar_exact(0.005, 0.001).loop;
  loop.backlash = {ContactLaw::dead_zone, 0.001, 50.0, 1.0};
  const EventTable table(loop);
  EXPECT_TRUE(table.serves(loop));
  loop.backlash.width = 0.002;
  EXPECT_FALSE(table.serves(loop));
}

TEST(EventTable, PlayMovesAlikeInItsGap) {
  const EventTable table(test::kollar_exact(0.005, 0.001).loop);
  EXPECT_TRUE(table.move_alike(0, 1));
  EXPECT_FALSE(table.move_alike(0, 2));
  EXPECT_FALSE(table.move_alike(-1, 0));
}

/// ‖(A/r)ᵏ‖ stays near one.
TEST(RateOfPowers, BoundsThePowersThatEndASeries) {
  test::Random random(4);
  for (int trial = 0; trial < 200; ++trial) {
    const Matrix<double, 4> a = test::random_plant(random).state_matrix();
    const double rate = rate_of_powers(a);
    EXPECT_LE(rate, balanced_norm(a) * (1.0 + 1e-12));
    EXPECT_GE(rate * (1.0 + 1e-9), a.eigenvalues().cwiseAbs().maxCoeff());
    Matrix<double, 4> power = Matrix<double, 4>::Identity();
    for (int k = 1; k <= 30; ++k) {
      power = (power * (a / rate)).eval();
      if (k >= 10 && k <= most_terms) {
        EXPECT_LE(balanced_norm(power), 3.0) << k;
      }
    }
  }
  EXPECT_EQ(rate_of_powers(Matrix<double, 4>(Matrix<double, 4>::Zero())), 0.0);
}

TEST(HasEventPack, TellsWhatItCannotTake) {
  const ImplementedLoop loop = test::kollar_exact(0.005, 0.001).loop;
  EXPECT_TRUE(has_event_pack(loop));
  ImplementedLoop other = loop;
  other.switching = Switching::sampled;
  EXPECT_FALSE(has_event_pack(other));
  other = loop;
  other.digital.limits.largest_force = 1.0;
  EXPECT_FALSE(has_event_pack(other));
  other = loop;
  other.digital.jitter.half_width = 1e-4;
  EXPECT_FALSE(has_event_pack(other));
}

}  // namespace
}  // namespace holdfast
