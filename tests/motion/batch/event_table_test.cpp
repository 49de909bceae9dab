#include "holdfast/motion/batch/event_table.hpp"

#include "motion/batch/event_pack_setting.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

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
