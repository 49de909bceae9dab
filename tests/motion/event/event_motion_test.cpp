#include "holdfast/motion/event_motion.hpp"

#include "motion/event/kollar_event.hpp"

namespace holdfast {
namespace {

using test::BacklashMotion;
using test::kollar_digital;
using test::kollar_motion;
using test::move_samples;
using test::pushed_state;
using test::SwitchNotes;
using test::zero_record;

TEST(EventMotion, WithoutBacklashItIsTheSampledMotion) {
  for (const ForceHold hold : {ForceHold::sampled, ForceHold::exact}) {
    for (const double share : {0.0, 1.0 / 3.0, 1.0}) {
      for (const double period : {0.001, 0.004}) {
        DigitalLoop loop = kollar_digital(period, share * period, hold);
        loop.gains = {-200.0, -5.0};
        const IdealLoop<double> sampled{kollar2022_plant(), loop.sampling, loop.gains,
                                        {0.5, 10.0},        0.0,           hold};
        auto expected = harmonically_forced_motion(sampled, pushed_state());
        BacklashMotion motion = kollar_motion(loop, 0.0, pushed_state());
        double largest = 0.0;
        for (int j = 0; j < 2000; ++j) {
          largest = std::max(largest, expected.state().norm());
          ASSERT_LE((motion.state() - expected.state()).norm(), 1e-12 * largest)
              << "sample " << j << ", delay " << share << " periods of " << period;
          const auto sample = motion.sense();
          const auto other = expected.sense();
          ASSERT_EQ(sample.time, other.time);
          ASSERT_NEAR(sample.control_force, other.control_force, 1e-9 * largest);
          ASSERT_EQ(sample.mode, ContactMode::engaged);
          motion.advance();
          expected.advance();
        }
      }
    }
  }
}

/// Both motions, sample by sample, with their changes of contact.
void expect_the_same_motion(const DigitalLoop& first, const DigitalLoop& second, double width,
                            double tolerance) {
  BacklashMotion one = kollar_motion(first, width), two = kollar_motion(second, width);
  SwitchNotes notes(one), others(two);
  const int samples = static_cast<int>(1.0 / first.sampling.period);
  for (int j = 0; j < samples; ++j) {
    notes.move(1);
    others.move(1);
    ASSERT_LE((one.state() - two.state()).norm(), tolerance) << "sample " << j;
    ASSERT_EQ(notes.switches.size(), others.switches.size()) << "sample " << j;
  }
  for (std::size_t k = 0; k < notes.switches.size(); ++k) {
    ASSERT_EQ(notes.switches[k].to, others.switches[k].to) << k;
    ASSERT_NEAR(notes.switches[k].time(), others.switches[k].time(), 1e-9) << k;
  }
  EXPECT_GT(width > 0.0 ? notes.switches.size() : 10U, 9U);
}

// A record of zeros makes the force irregular, a jitter of 10⁻³⁰⁰ s the clock: whole periods are
// then followed by their series.
TEST(EventMotion, TheMatricesOfAPeriodAndItsSeriesGiveTheSameMotion) {
  for (const double width : {0.0, 0.0005, 0.002}) {
    for (const double period : {0.001, 0.005, 0.011}) {
      for (const double share : {0.0, 0.4}) {
        DigitalLoop plain = kollar_digital(period, share * period);
        if (share > 0.0) plain.gains = {-200.0, -3.0};
        DigitalLoop recorded = plain;
        recorded.force.record = zero_record({-1.0, 100.0});
        expect_the_same_motion(plain, recorded, width, 1e-12);
        plain.hold = ForceHold::sampled;
        DigitalLoop jittering = plain;
        jittering.jitter.half_width = 1e-300;
        expect_the_same_motion(plain, jittering, width, 1e-12);
      }
    }
  }
}

TEST(EventMotion, GoesOnFromWhatItRestores) {
  const DigitalLoop loop = kollar_digital(0.001, 0.0002);
  BacklashMotion motion = kollar_motion(loop, 0.0005);
  std::array<int, 3> stored{};
  for (int start = 0; start < 60; ++start) {
    move_samples(motion, 17);
    ++stored[static_cast<std::size_t>(motion.contact().mode())];
    BacklashMotion other = kollar_motion(loop, 0.0005, pushed_state());
    other.restore(motion.index(), motion.state(), motion.previous_command(), motion.contact());
    BacklashMotion here = motion;
    for (int j = 0; j < 100; ++j) {
      const auto sample = here.sense(), restored = other.sense();
      ASSERT_EQ(sample.mode, restored.mode);
      ASSERT_EQ(sample.control_force, restored.control_force);
      ASSERT_EQ(sample.state, restored.state) << "start " << start << ", sample " << j;
      here.advance();
      other.advance();
    }
  }
  for (const int count : stored) EXPECT_GT(count, 2) << "in every mode";
}

}  // namespace
}  // namespace holdfast
