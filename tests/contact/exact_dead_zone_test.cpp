#include "holdfast/contact/contact.hpp"

#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "motion/event/kollar_event.hpp"
#include "support/random_loop.hpp"

namespace holdfast {
namespace {

using DeadZoneMotion = EventMotion<>;

/// A dead zone of width r₀ whose stops have a stiffness k_c and a damping c_c.
struct Stops {
  double width, stiffness, damping;

  double side(double d) const { return DeadZone<double>(width).side(d); }
  double force(double d, double v) const {
    return side(d) == 0.0 ? 0.0 : stiffness * (d - side(d) * width / 2.0) + damping * v;
  }
};

/// ż by Newton's law of each mass.
Vector<double, 4> rate_between_stops(const TwoMass<double>& plant, const Stops& stops,
                                     const Vector<double, 4>& z, double command, double force) {
  const double d = z[2] - z[0], v = z[3] - z[1];
  const bool transmits = stops.side(d) != 0.0;
  const double between = plant.absorber_stiffness * d + plant.absorber_damping * v +
                         stops.force(d, v) + (transmits ? command : 0.0);
  const double outside = force - plant.conductor_stiffness * z[0] - plant.conductor_damping * z[1];
  return {z[1], (outside + between) / plant.conductor_mass, z[3], -between / plant.absorber_mass};
}

TEST(ExactDeadZone, EveryModeMovesByNewtonsLaw) {
  test::Random random(1371);
  int sides[3] = {0, 0, 0};
  for (int draw = 0; draw < 1000; ++draw) {
    const auto plant = test::random_plant(random);
    const double width = random.uniform(0.0, 2.0), damping = random.uniform(0.0, 3.0);
    const double stiffness = plant.absorber_stiffness * random.log_uniform(0.1, 10.0);
    const Vector<double, 4> z = random.matrix<Vector<double, 4>>();
    const DriveContact<> contact = test::exact_dead_zone(plant, width, stiffness, damping, z);
    const Stops stops{width, stiffness, damping};
    const double command = random.uniform(-5, 5), force = random.uniform(-5, 5);
    const AffineDynamics moving = contact.dynamics(contact.mode());
    const double u = contact.transmitted({z, command, force});
    ASSERT_EQ(u, stops.side(z[2] - z[0]) != 0.0 ? command : 0.0);
    const Vector<double, 4> rate =
        moving.state * z + moving.drift + moving.command * command + moving.force * force;
    const Vector<double, 4> expected = rate_between_stops(plant, stops, z, command, force);
    const double size =
        (moving.state.cwiseAbs() * z.cwiseAbs()).norm() + moving.drift.norm() + expected.norm();
    ASSERT_LE((rate - expected).norm(), 1e-13 * size) << draw;
    ASSERT_EQ(contact.word(),
              stops.side(z[2] - z[0]) == 0.0 ? ContactMode::gap : ContactMode::engaged);
    ++sides[contact.mode()];
  }
  for (const int count : sides) EXPECT_GT(count, 100);
}

TEST(ExactDeadZone, BothEndsOfTheGapBelongToIt) {
  const auto plant = kollar2022_plant();
  const auto mode_at = [&](double d) {
    return test::exact_dead_zone(plant, 0.5, 1.0, 0.0, Vector<double, 4>(0.0, 0.0, d, 0.0)).mode();
  };
  EXPECT_EQ(mode_at(0.25), 1);
  EXPECT_EQ(mode_at(-0.25), 1);
  EXPECT_EQ(mode_at(std::nextafter(0.25, 1.0)), 2);
  EXPECT_EQ(mode_at(std::nextafter(-0.25, -1.0)), 0);
}

// The absorber alone between its stops, the conductor being too heavy to move. From Δz = 0 at the
// speed v it comes to the stop, h = r₀/2, after asin(ω₁ h / v) / ω₁, ω₁² = k₂/m₂, at the speed
// w = √(v² − ω₁² h²); on the stop it swings with ω₂² = (k₂ + k_c)/m₂ about its relaxed place and
// comes back, a = h k₂/(k₂ + k_c) from there, after (2/ω₂) atan(w / (ω₂ a)). A period has four of
// the first and two of the second: the free vibration of S. W. Shaw, P. J. Holmes, A periodically
// forced piecewise linear oscillator, J. Sound Vib. 90 (1983), with a gap.
TEST(ExactDeadZone, SwingsBetweenItsStopsWithTheKnownPeriod) {
  test::Random random(1372);
  for (int draw = 0; draw < 40; ++draw) {
    const double mass = random.log_uniform(0.1, 2.0), spring = random.log_uniform(5.0, 100.0);
    const double stop = spring * random.log_uniform(0.2, 100.0), half = random.uniform(0.5, 2.0);
    const TwoMass<double> plant{1e13, 1e13, 0.0, mass, spring, 0.0};
    const double inner = std::sqrt(spring / mass), outer = std::sqrt((spring + stop) / mass);
    const double speed = inner * half * random.uniform(1.05, 4.0);
    const double at_stop = std::sqrt(speed * speed - inner * inner * half * half);
    const double relaxed = half * spring / (spring + stop);
    const double period = 4.0 * std::asin(inner * half / speed) / inner +
                          4.0 / outer * std::atan(at_stop / (outer * relaxed));
    const Vector<double, 4> state(0.0, 0.0, 0.0, speed);
    const DigitalLoop loop{
        {period * random.log_uniform(0.01, 2.0), 0.0}, {0.0, 0.0}, {}, ForceHold::exact};
    DeadZoneMotion motion(loop, test::exact_dead_zone(plant, 2.0 * half, stop, 0.0, state), state);
    test::SwitchNotes notes(motion);
    notes.move(static_cast<int>(20.0 * period / loop.sampling.period) + 1);
    std::vector<double> times;
    for (const test::MotionSwitch& change : notes.switches)
      if (change.to == 2) times.push_back(change.time());
    ASSERT_GE(times.size(), 15U);
    const double first = std::asin(inner * half / speed) / inner;
    for (std::size_t k = 0; k < times.size(); ++k) {
      const double expected = first + static_cast<double>(k) * period;
      ASSERT_NEAR(times[k], expected, 1e-9 * expected) << "draw " << draw << ", " << k;
    }
    EXPECT_FALSE(motion.counts().accumulates);
  }
}

// Without dampers, control and force the energy of the plant and of the touched stop is constant,
// however often it is met.
TEST(ExactDeadZone, ItsStopsConserveEnergy) {
  test::Random random(1373);
  std::int64_t meetings = 0;
  for (int draw = 0; draw < 100; ++draw) {
    auto plant = test::random_plant(random);
    plant.conductor_damping = plant.absorber_damping = 0.0;
    const double omega = std::sqrt(plant.absorber_stiffness / plant.absorber_mass);
    const double stiffness = plant.absorber_stiffness * random.log_uniform(0.1, 100.0);
    const double half = random.log_uniform(0.01, 0.5);
    const Vector<double, 4> state(0.3, omega, -0.2, -omega);
    const DigitalLoop loop{{random.log_uniform(0.02, 2.0) / omega, 0.0}, {}, {}, ForceHold::exact};
    DeadZoneMotion motion(loop, test::exact_dead_zone(plant, 2.0 * half, stiffness, 0.0, state),
                          state);
    const EnergyNorm norm(plant);
    const auto energy = [&](const Vector<double, 4>& z) {
      const double deep = std::max(0.0, std::abs(relative_displacement(z)) - half);
      return std::pow(norm(z), 2) + stiffness * deep * deep;
    };
    const double expected = energy(state);
    for (int j = 0; j < 400; ++j) {
      motion.sense();
      motion.advance();
      ASSERT_NEAR(energy(motion.state()), expected, 1e-10 * expected) << draw << ", sample " << j;
    }
    meetings += motion.counts().entered[0];
  }
  std::cout << meetings << " times on a stop\n";
  EXPECT_GT(meetings, 2000);
}

// r₀ = 0: the stops are a spring and a damper between the masses, and the force is transmitted at
// all times.
TEST(ExactDeadZone, WithoutWidthItIsAStifferPlant) {
  test::Random random(1374);
  for (const double share : {0.0, 0.4, 1.0}) {
    const auto plant = kollar2022_plant();
    const double stiffness = 300.0, damping = 1.5, period = 0.002;
    const Vector<double, 4> state(0.003, -0.05, 0.001, 0.2);
    const DigitalLoop loop{{period, share * period},
                           {-100.0, -3.0},
                           multi_harmonic_force({0.5, 10.0}),
                           ForceHold::exact};
    DeadZoneMotion motion(loop, test::exact_dead_zone(plant, 0.0, stiffness, damping, state),
                          state);
    const IdealLoop<double> linear{plant_on_stop(plant, stiffness, damping),
                                   loop.sampling,
                                   loop.gains,
                                   {0.5, 10.0},
                                   0.0,
                                   ForceHold::exact};
    auto expected = harmonically_forced_motion(linear, state);
    for (int j = 0; j < 1000; ++j) {
      motion.sense();
      expected.sense();
      motion.advance();
      expected.advance();
      ASSERT_LE((motion.state() - expected.state()).norm(), 1e-13) << j;
    }
    EXPECT_GT(motion.counts().entered[1], 5) << "it passes through Δz = 0";
  }
}

/// A drive in its dead zone, with a force that takes it to both stops.
DeadZoneMotion rattling_motion(double period, double gain) {
  const DigitalLoop loop{
      {period, 0.0}, {gain, 0.0}, multi_harmonic_force({0.5, 3.0}), ForceHold::exact};
  const Vector<double, 4> state = Vector<double, 4>::Zero();
  return {loop, test::exact_dead_zone(kollar2022_plant(), 0.002, 400.0, 1.0, state), state};
}

// Without control the samples mean nothing: the motion is the same however they are set.
TEST(ExactDeadZone, WithoutControlItDoesNotDependOnTheSamples) {
  DeadZoneMotion coarse = rattling_motion(0.08, 0.0), fine = rattling_motion(0.0005, 0.0);
  for (int j = 0; j < 50; ++j) {
    coarse.sense();
    coarse.advance();
    test::move_samples(fine, 160);
    ASSERT_LE((coarse.state() - fine.state()).norm(), 1e-12) << j;
    ASSERT_EQ(coarse.counts().entered, fine.counts().entered) << j;
  }
  EXPECT_GT(fine.counts().entered[0], 10);
}

/// A force that takes the drive past the upper end, back and past the lower one within 0.4 ms.
DeadZoneMotion thrown_motion(double period) {
  DigitalLoop loop{{period, 0.0}, {0.0, 0.0}, {}, ForceHold::exact};
  loop.force.record = std::make_shared<const RecordedForce>(
      std::vector<double>{-1.0, 10.0}, std::vector<double>{50.0, 50.0}, RecordInterpolation::held);
  const Vector<double, 4> state(0.0, 0.0, 0.0, 0.1);
  return {loop, test::exact_dead_zone(kollar2022_plant(), 1e-5, 400.0, 0.0, state), state};
}

// Where both ends of the gap are passed within one series, the one that comes first is met first.
TEST(ExactDeadZone, TheFirstOfTwoEndsIsMetFirst) {
  DeadZoneMotion coarse = thrown_motion(0.0004), fine = thrown_motion(0.00001);
  coarse.sense();
  coarse.advance();
  test::move_samples(fine, 40);
  EXPECT_EQ(coarse.contact().mode(), 0) << "on the lower stop";
  EXPECT_EQ(coarse.counts().entered, fine.counts().entered);
  EXPECT_EQ(coarse.counts().entered[0], 2) << "first the upper one, then the lower one";
  EXPECT_LE((coarse.state() - fine.state()).norm(), 1e-14);
}

TEST(ExactDeadZone, ItsModeIsThatOfItsDisplacement) {
  DeadZoneMotion motion = rattling_motion(0.0005, -100.0);
  const Stops stops{0.002, 400.0, 1.0};
  int seen[3] = {0, 0, 0};
  for (int j = 0; j < 20000; ++j) {
    const auto sample = motion.sense();
    const double d = relative_displacement(sample.state);
    if (std::abs(std::abs(d) - 0.001) > 1e-12) {
      ASSERT_EQ(motion.contact().mode() - 1, static_cast<int>(stops.side(d))) << j;
      ASSERT_EQ(sample.control_force, stops.side(d) == 0.0 ? 0.0 : motion.command()) << j;
    }
    ++seen[motion.contact().mode()];
    motion.advance();
  }
  for (const int count : seen) EXPECT_GT(count, 1000);
}

// Displaced past a stop, or past both, it is where it was put.
TEST(ExactDeadZone, ADisplacedDriveTouchesTheStopWhereItIs) {
  for (const double kick : {-0.01, -0.0005, 0.0005, 0.01}) {
    for (int later = 0; later < 200; later += 7) {
      DeadZoneMotion motion = rattling_motion(1e-6, 0.0);
      DeadZoneMotion before = rattling_motion(0.005, 0.0);
      test::move_samples(before, later);
      motion.restore(0, before.state(), 0.0, before.contact());
      motion.displace_conductor(kick);
      const Vector<double, 4> put = motion.state();
      const double d = relative_displacement(put);
      motion.sense();
      motion.advance();
      ASSERT_LE((motion.state() - put).norm(), 1e-4) << "nothing jumps";
      if (std::abs(std::abs(d) - 0.001) > 1e-5) {
        ASSERT_EQ(motion.contact().mode(), d > 0.001 ? 2 : d < -0.001 ? 0 : 1) << kick;
      }
    }
  }
}

// Where the spring pushes out of the gap and the command back into it, the drive rattles at the end
// of the gap ever faster: the work is bounded, and what it came to is named.
TEST(ExactDeadZone, RattlingWithoutEndIsBoundedAndNamed) {
  const TwoMass<double> plant{1.0, 1.0, 0.0, 1.0, 1.0, 300.0};
  const Vector<double, 4> state(-1.0, 0.0, -0.99, 0.001);
  DigitalLoop loop{{0.5, 0.0}, {-10.0, 0.0}, {}, ForceHold::exact};
  loop.force.record = std::make_shared<const RecordedForce>(std::vector<double>{-1.0, 10.0},
                                                            std::vector<double>{-10.0, -10.0},
                                                            RecordInterpolation::held);
  DeadZoneMotion motion(loop, test::exact_dead_zone(plant, 0.02, 0.0, 0.0, state), state);
  motion.sense();
  motion.advance();
  const auto& entered = motion.counts().entered;
  const std::int64_t changes = entered[0] + entered[1] + entered[2];
  std::cout << changes << " changes of contact in one period\n";
  EXPECT_LE(changes, DeadZoneMotion::most_switches + 2);
  EXPECT_EQ(motion.counts().accumulates, changes > DeadZoneMotion::most_switches);
  EXPECT_TRUE(std::isfinite(motion.state().sum()));
}

TEST(ExactDeadZone, WhatIsOutOfRangeIsRefused) {
  const auto plant = kollar2022_plant();
  const Vector<double, 4> rest = Vector<double, 4>::Zero();
  for (const double wrong :
       {-1e-9, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(test::exact_dead_zone(plant, wrong, 1.0, 1.0, rest), InvalidParameter) << wrong;
    EXPECT_THROW(test::exact_dead_zone(plant, 1.0, wrong, 1.0, rest), InvalidParameter) << wrong;
    EXPECT_THROW(test::exact_dead_zone(plant, 1.0, 1.0, wrong, rest), InvalidParameter) << wrong;
  }
  EXPECT_NO_THROW(test::exact_dead_zone(plant, 0.0, 0.0, 0.0, rest));
}

}  // namespace
}  // namespace holdfast
