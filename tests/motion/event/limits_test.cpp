#include "holdfast/contact/contact.hpp"
#include "motion/event/kollar_event.hpp"
#include "motion/event/slow_flow.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

using test::acceleration_between;
using test::BacklashMotion;
using test::kollar_digital;
using test::kollar_motion;
using test::MotionSwitch;
using test::move_samples;
using test::SlowFlow;
using test::SwitchNotes;
using test::zero_record;

TEST(EventMotion, AtRestWithoutForceItStaysThere) {
  for (const double width : {0.0, 0.001}) {
    DigitalLoop loop = kollar_digital(0.001, 0.0003);
    loop.force = {};
    BacklashMotion motion = kollar_motion(loop, width);
    move_samples(motion, 200);
    EXPECT_EQ(motion.state(), (Vector<double, 4>::Zero()));
    EXPECT_EQ(motion.counts().entered, (std::array<std::int64_t, 3>{}));
    EXPECT_EQ(motion.contact().sign(), 0.0);
  }
}

// The gap reaches to where the drive reversed last. Once the transient is over Δz does not come
// back there, and the plant moves as it does alone.
TEST(EventMotion, AGapWiderThanTheMotionIsNotLeft) {
  const DigitalLoop loop = kollar_digital(0.001);
  BacklashMotion motion = kollar_motion(loop, 1e3);
  move_samples(motion, 30000);
  ASSERT_EQ(motion.contact().word(), ContactMode::gap);
  EXPECT_GT(motion.counts().entered[1], 1);
  SlowFlow free(kollar2022_plant(), loop.force.harmonics);
  for (int j = 0; j < 2000; ++j) {
    const Vector<double, 4> expected = free.moved(1, motion.state(), 0.0, motion.time(), 0.001);
    move_samples(motion, 1);
    ASSERT_LE((motion.state() - expected).norm(), 1e-14) << j;
    ASSERT_EQ(motion.contact().word(), ContactMode::gap);
  }
}

/// A drive that moved at Δż > 0, sticks at this state while u = `command`, and was then left to the
/// end of its stick by a command that just lets it go on.
DriveContact<> released_drive(const TwoMass<double>& plant, const Vector<double, 4>& state) {
  DriveContact<> drive = test::exact_backlash(plant, 0.001);
  drive.learn_sign(0, 1.0);
  ContactInstant now{state, 0.0, 0.0};
  const double free = acceleration_between(plant, state, 0.0, 0.0).value;
  const double holding = free / (1.0 / plant.conductor_mass + 1.0 / plant.absorber_mass);
  now.command = 2.0 * holding;
  drive.reached(0, now);
  now.command = holding * (1.0 - 1e-15);
  drive.reached(1, now);
  return drive;
}

// A stick may end exactly at a sample, which brings a new command: what is zero at the end of a
// stick under the old one is not zero under the new one.
TEST(EventMotion, AStickThatEndsAtASampleHeedsTheNewCommand) {
  const auto plant = kollar2022_plant();
  const Vector<double, 4> state(0.001, 0.02, -0.003, 0.02);
  const double free = acceleration_between(plant, state, 0.0, 0.0).value;
  ASSERT_GT(free, 0.0) << "the spring pushes on";
  for (const double gain : {-2000.0, 2000.0}) {
    for (const double slope : {-300.0, 0.0, 300.0}) {
      const DriveContact<> drive = released_drive(plant, state);
      ASSERT_EQ(drive.word(), ContactMode::engaged);
      DigitalLoop loop = kollar_digital(0.0002);
      loop.force = {};
      loop.gains = {gain, slope};
      const double command = gain * state[0] + slope * state[1];
      const double driven = acceleration_between(plant, state, command, 0.0).value;
      BacklashMotion motion = kollar_motion(loop, 0.001);
      motion.restore(5, state, 0.0, drive);
      move_samples(motion, 1);
      const double velocity = relative_velocity(motion.state());
      if (driven < 0.0) {
        EXPECT_EQ(motion.contact().word(), ContactMode::stick) << gain << ", " << slope;
        EXPECT_EQ(velocity, 0.0);
      } else {
        EXPECT_EQ(motion.contact().word(), ContactMode::engaged) << gain << ", " << slope;
        EXPECT_NEAR(velocity, driven * 0.0002, 0.1 * driven * 0.0002);
        EXPECT_EQ(motion.counts().entered, (std::array<std::int64_t, 3>{})) << "nothing happened";
      }
    }
  }
}

// The rows of a record part the motion wherever they lie; where they are all zero they change
// nothing, also just after a change of contact, where the guard has not come out of its rounding.
TEST(EventMotion, ABreakJustAfterAChangeOfContactChangesNothing) {
  for (const double period : {0.001, 0.005}) {
    const DigitalLoop plain = kollar_digital(period);
    const int samples = static_cast<int>(std::lround(0.6 / period));
    BacklashMotion motion = kollar_motion(plain, 0.0005);
    SwitchNotes notes(motion);
    notes.move(samples);
    ASSERT_GT(notes.switches.size(), 25U);
    for (const MotionSwitch& change : notes.switches) {
      for (const double later : {0.0, 1e-12, 1e-10, 1e-9, 1e-8, 1e-7, 3e-7, 1e-6}) {
        DigitalLoop parted = plain;
        parted.force.record = zero_record({-1.0, change.time() + later, 2.0});
        BacklashMotion other = kollar_motion(parted, 0.0005);
        SwitchNotes others(other);
        others.move(samples);
        ASSERT_EQ(others.switches.size(), notes.switches.size())
            << later << " s after " << change.from << " → " << change.to;
        ASSERT_LE((other.state() - motion.state()).norm(), 1e-12);
      }
    }
  }
}

/// The changes of contact of a motion on which a constant force acts from `begin` on.
std::vector<MotionSwitch> switches_under_step(double force, double begin, double duration) {
  DigitalLoop loop = kollar_digital(0.001);
  loop.force.record = std::make_shared<const RecordedForce>(std::vector<double>{begin, 10.0},
                                                            std::vector<double>{force, force},
                                                            RecordInterpolation::held);
  BacklashMotion motion = kollar_motion(loop, 0.0005);
  SwitchNotes notes(motion);
  notes.move(static_cast<int>(std::lround(duration / 0.001)));
  return notes.switches;
}

// A recorded force may jump within a period. A stick then ends at once or not at all, as it would
// if the jump came with a sample.
TEST(EventMotion, AForceThatJumpsEndsAStickAsASampleWould) {
  BacklashMotion motion = kollar_motion(kollar_digital(0.001), 0.0005);
  while (!(motion.time() > 0.4 && motion.contact().word() == ContactMode::stick))
    move_samples(motion, 1);
  const double sample = motion.time() + 0.001, duration = sample + 0.02;
  for (const double force : {-3.0, -0.5, -0.05, 0.05, 0.5, 3.0}) {
    const auto at_sample = switches_under_step(force, sample, duration);
    for (const double aside : {-1e-10, 1e-10}) {
      const auto within = switches_under_step(force, sample + aside, duration);
      ASSERT_EQ(within.size(), at_sample.size()) << force << " N";
      for (std::size_t k = 0; k < within.size(); ++k) {
        EXPECT_EQ(within[k].to, at_sample[k].to) << force << " N, switch " << k;
        EXPECT_NEAR(within[k].time(), at_sample[k].time(), 1e-7) << force << " N, switch " << k;
      }
    }
  }
}

// A force that is constant is the same held or not, whichever way it is given.
TEST(EventMotion, AConstantForceIsTheSameHeldAndExact) {
  const auto plant = kollar2022_plant();
  const double half_width = 0.001;
  const Vector<double, 4> state(0.0, -0.5, half_width - 5e-5, 0.0);  // into the stop and out again
  DigitalLoop loop{{0.001, 0.0}, {0.0, 0.0}, {}, ForceHold::sampled};
  loop.force.record = std::make_shared<const RecordedForce>(std::vector<double>{-1.0, 10.0},
                                                            std::vector<double>{100.0, 100.0},
                                                            RecordInterpolation::held);
  const DriveContact<> stops = test::exact_dead_zone(plant, 2.0 * half_width, 1e4, 0.0, state);
  EventMotion<> held(loop, stops, state);
  loop.hold = ForceHold::exact;
  EventMotion<> exact(loop, stops, state);
  for (int j = 0; j < 20; ++j) {
    move_samples(held, 1);
    move_samples(exact, 1);
    ASSERT_EQ(held.counts().entered, exact.counts().entered) << j;
    ASSERT_LE((held.state() - exact.state()).norm(), 1e-12) << j;
  }
  EXPECT_GE(exact.counts().entered[0], 1);
}

// A kick moves the conductor and no more: Δż goes on from where it was, whatever the mode and
// wherever the kick leads.
TEST(EventMotion, AKickChangesNoVelocity) {
  test::Random random(1362);
  const auto plant = kollar2022_plant();
  const double period = 0.0001, width = 0.001;
  BacklashMotion motion = kollar_motion(kollar_digital(period), width);
  std::array<std::array<int, 3>, 3> seen{};  // mode, and where the kick led: below, into, above
  for (int trial = 0; trial < 3000; ++trial) {
    move_samples(motion, 3);
    BacklashMotion kicked = motion;
    const double kick = random.sign() * random.log_uniform(1e-6, 3e-3);
    kicked.displace_conductor(kick);
    const Vector<double, 4> before = kicked.state();
    const double d = relative_displacement(before);
    const double lower = motion.contact().lower(), upper = motion.contact().upper();
    const auto mode = static_cast<std::size_t>(motion.contact().mode());
    ++seen[mode][d < lower ? 0 : d > upper ? 2 : 1];
    const auto sample = kicked.sense();
    ASSERT_EQ(sample.state, before);
    const double command = kicked.command();
    kicked.advance();
    const auto free = acceleration_between(plant, before, 0.0, 0.5);
    const auto driven = acceleration_between(plant, before, command, 0.5);
    const double most = 2.0 * (free.size + driven.size) * period;
    ASSERT_LE(std::abs(relative_velocity(kicked.state()) - relative_velocity(before)), most)
        << "mode " << mode << ", Δz " << d << " m in [" << lower << ", " << upper << "]";
    if (mode == 0) continue;
    const double now = relative_displacement(kicked.state());
    if (kicked.contact().word() == ContactMode::gap) {
      ASSERT_GE(now, kicked.contact().lower() - 1e-15);
      ASSERT_LE(now, kicked.contact().upper() + 1e-15);
      ASSERT_NEAR(kicked.contact().upper() - kicked.contact().lower(), width, 1e-15);
    }
    if (d > lower + 1e-4 && d < upper - 1e-4) {
      ASSERT_EQ(kicked.contact().word(), ContactMode::gap) << "well within the gap";
      ASSERT_EQ(kicked.contact().lower(), lower);
    }
  }
  for (std::size_t mode = 1; mode < 3; ++mode)
    for (const int count : seen[mode]) EXPECT_GT(count, 20) << "mode " << mode;
}

/// Δz of the plant alone after a time, from a state in which it rises.
double free_displacement(const Vector<double, 4>& state, double time) {
  SlowFlow free(kollar2022_plant(), {});
  return relative_displacement(free.moved(1, state, 0.0, 0.0, time));
}

// Stops without stiffness change nothing: the motion is that of the plant alone, and only the
// record of its contacts tells whether Δz came to the end. It touches that end at its largest.
TEST(EventMotion, ATouchIsNamedOrAPairOfChanges) {
  const Vector<double, 4> state(0.0, 0.0, 0.0, 0.1);
  double low = 0.001, high = 0.04;
  while (high - low > 1e-9) {
    const double third = (high - low) / 3.0;
    const bool rises =
        free_displacement(state, low + third) < free_displacement(state, high - third);
    (rises ? low : high) = rises ? low + third : high - third;
  }
  const double top = free_displacement(state, low);
  const Vector<double, 4> at_top = SlowFlow(kollar2022_plant(), {}).moved(1, state, 0.0, 0.0, low);
  const double fall = -acceleration_between(kollar2022_plant(), at_top, 0.0, 0.0).value;
  ASSERT_GT(fall, 0.0);
  DigitalLoop loop = kollar_digital(0.05);
  loop.gains = {0.0, 0.0};
  loop.force = {};
  int named = 0;
  for (const double above :
       {-1e-3, -1e-5, -1e-7, -1e-9, -1e-11, -1e-14, -1e-16, 0.0, 1e-16, 1e-14, 1e-11, 1e-6}) {
    const DriveContact<> stops =
        test::exact_dead_zone(kollar2022_plant(), 2.0 * top * (1.0 + above), 0.0, 0.0, state);
    EventMotion<> motion(loop, stops, state);
    SwitchNotes notes(motion);
    notes.move(1);
    const std::size_t changes = notes.switches.size();
    named += motion.counts().grazing > 0 ? 1 : 0;
    if (above <= -1e-11) {
      ASSERT_EQ(changes, 2U) << above;
      const double contact = 2.0 * std::sqrt(-2.0 * above * top / fall);
      const double found = notes.switches[1].time() - notes.switches[0].time();
      EXPECT_NEAR(found, contact, 0.05 * contact + 1e-9) << above;
    }
    if (above >= 1e-11) {
      EXPECT_EQ(changes, 0U) << above;
    }
    EXPECT_TRUE(changes == 0 || changes == 2) << above;
    const double end = free_displacement(state, 0.05);
    EXPECT_NEAR(relative_displacement(motion.state()), end, 1e-15) << above;
  }
  std::cout << named << " touches named\n";
  EXPECT_GT(named, 0);
}

// A drive with a gap of next to nothing reverses through it at once; a period has no more changes
// than its reversals ask for.
// F = ± F_m sin ωt written as a cosine begins at zero to rounding only; that must not decide which
// way the drive goes first.
TEST(EventMotion, TheRoundingOfTheFirstForceGivesItNoDirection) {
  const auto motion_of = [](double quarters) {
    DigitalLoop loop = kollar_digital(0.001);
    loop.force.harmonics = {{0.5, 10.0, 0.5 * pi<double> * quarters}};
    BacklashMotion motion = kollar_motion(loop, 0.002);
    move_samples(motion, 100);
    return motion;
  };
  const BacklashMotion first = motion_of(1.0), mirrored = motion_of(-1.0);
  EXPECT_NEAR(std::abs(first.state()[0]), 9.27e-4, 1e-6);
  EXPECT_LE((first.state() + mirrored.state()).norm(), 1e-12);
  for (const double turns : {-3.0, 5.0})
    EXPECT_LE((motion_of(turns).state() - first.state()).norm(), 1e-12) << turns;
  EXPECT_LE((motion_of(3.0).state() - mirrored.state()).norm(), 1e-12);
}

// σ a(u) = 0 at the reversal itself, and falling: the command pushes back from then on, the spring
// pushes on, and the drive sticks.
TEST(EventMotion, AReversalWithoutAccelerationIsDecidedByItsRate) {
  const TwoMass<double> plant{1.0, 1.0, 0.0, 1.0, 1.0, 0.0};
  const Vector<double, 4> state(1.0, -1.0, 1.0, -1.0);
  const DigitalLoop loop{{0.1, 0.1}, {0.0, 0.0}, {}, ForceHold::exact};
  DriveContact<> contact = test::exact_backlash(plant, 1e-3);
  contact.learn_sign(0, 1.0);
  BacklashMotion motion(loop, contact, state);
  motion.restore(0, state, 0.5, contact);
  motion.sense();
  motion.advance();
  EXPECT_EQ(motion.counts().entered[static_cast<std::size_t>(ContactMode::stick)], 1);
  EXPECT_EQ(motion.counts().entered[static_cast<std::size_t>(ContactMode::gap)], 0);
  EXPECT_FALSE(motion.counts().accumulates);
}

TEST(EventMotion, ChangesOfContactDoNotPileUp) {
  for (const double width : {1e-6, 1e-9, 1e-12, 1e-15}) {
    BacklashMotion motion = kollar_motion(kollar_digital(0.001), width);
    std::int64_t before = 0, most = 0;
    for (int j = 0; j < 3000; ++j) {
      move_samples(motion, 1);
      const auto& entered = motion.counts().entered;
      const std::int64_t all = entered[0] + entered[1] + entered[2];
      most = std::max(most, all - before);
      before = all;
    }
    EXPECT_FALSE(motion.counts().accumulates) << width;
    EXPECT_LE(most, 6) << width;
    EXPECT_GE(before, 60 * 2) << width;
  }
}

TEST(EventMotion, WhatIsNotAdmissibleIsRefused) {
  const auto refused = [](auto&& spoil) {
    DigitalLoop loop = kollar_digital(0.001);
    spoil(loop);
    EXPECT_THROW(kollar_motion(loop, 0.001), InvalidParameter);
  };
  refused([](DigitalLoop& bad) { bad.sampling.period = 0.0; });
  refused([](DigitalLoop& bad) { bad.sampling.processing_delay = 0.0011; });
  refused([](DigitalLoop& bad) { bad.gains.proportional = std::nan(""); });
  refused([](DigitalLoop& bad) { bad.force.harmonics[0].frequency = -1.0; });
  refused([](DigitalLoop& bad) { bad.limits.velocity_quantum = -1.0; });
  refused([](DigitalLoop& bad) { bad.jitter.half_width = 0.001; });
  // A rate of the force times the sampling period beyond 10⁶ would be endless work.
  refused([](DigitalLoop& bad) { bad.force.harmonics[0].frequency = 1e9; });
  EXPECT_THROW(kollar_motion(kollar_digital(0.001), -1.0), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
