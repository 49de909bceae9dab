#include "holdfast/contact/contact.hpp"

#include "support/contacts.hpp"
#include "support/random_loop.hpp"

namespace holdfast {
namespace {

/// Δz̈ by Newton's law of each mass, a force s being transmitted.
double relative_acceleration_by_newton(const TwoMass<double>& plant, const ContactInstant& now,
                                       double transmitted) {
  const Vector<double, 4>& z = now.state;
  const double between = plant.absorber_stiffness * (z[2] - z[0]) +
                         plant.absorber_damping * (z[3] - z[1]) + transmitted;
  const double conductor =
      (-plant.conductor_stiffness * z[0] - plant.conductor_damping * z[1] + between + now.force) /
      plant.conductor_mass;
  return -between / plant.absorber_mass - conductor;
}

/// An instant at which Δż = 0, with forces of the size of those of the springs.
ContactInstant reversal_instant(const TwoMass<double>& plant, test::Random& random) {
  ContactInstant now{random.matrix<Vector<double, 4>>(), 0.0, 0.0};
  now.state[3] = now.state[1];
  now.command = plant.absorber_stiffness * random.uniform(-2.0, 2.0);
  now.force = plant.conductor_stiffness * random.uniform(-2.0, 2.0);
  return now;
}

/// A drive that has moved in one direction.
DriveContact<> moved_drive(const TwoMass<double>& plant, double width, double sign) {
  DriveContact<> drive = test::exact_backlash(plant, width);
  drive.learn_sign(0, sign);
  return drive;
}

/// g at an instant.
double value_of_guard(const Guard& guard, const ContactInstant& now) {
  return guard.state.dot(now.state) + guard.command * now.command + guard.force * now.force +
         guard.constant;
}

TEST(ExactBacklash, ItSticksWhereTheSpringPushesOnAndTheCommandTurnsBack) {
  test::Random random(1322);
  int sticks = 0;
  for (int draw = 0; draw < 4000; ++draw) {
    const auto plant = test::random_plant(random);
    const double sign = random.sign();
    DriveContact<> drive = moved_drive(plant, 0.1, sign);
    ContactInstant now = reversal_instant(plant, random);
    const double free = sign * relative_acceleration_by_newton(plant, now, 0.0);
    const double driven = sign * relative_acceleration_by_newton(plant, now, now.command);
    drive.reached(0, now);
    const bool expected = free > 0.0 && driven < 0.0;
    ASSERT_EQ(drive.word(), expected ? ContactMode::stick : ContactMode::gap) << draw;
    sticks += expected ? 1 : 0;
    if (!expected) continue;
    const double transmitted = drive.transmitted(now);
    ASSERT_NEAR(relative_acceleration_by_newton(plant, now, transmitted), 0.0,
                1e-12 * std::abs(free - driven));
    ASSERT_GE(transmitted, std::min(0.0, now.command));
    ASSERT_LE(transmitted, std::max(0.0, now.command));
    const Guards guards = drive.guards();
    ASSERT_EQ(guards.count, 2);
    ASSERT_NEAR(value_of_guard(guards.guard[0], now), free, 1e-12 * std::abs(free - driven));
    ASSERT_NEAR(value_of_guard(guards.guard[1], now), -driven, 1e-12 * std::abs(free - driven));
  }
  EXPECT_GT(sticks, 300);
  EXPECT_LT(sticks, 3700);
}

TEST(ExactBacklash, WhatIsTransmittedIsWhatItsDynamicsHave) {
  test::Random random(1323);
  for (int draw = 0; draw < 300; ++draw) {
    const auto plant = test::random_plant(random);
    ContactInstant now = reversal_instant(plant, random);
    const DriveContact<> drive = test::exact_backlash(plant, 0.1);
    const auto rate = [&](ContactMode mode, double command) -> Vector<double, 4> {
      const AffineDynamics moving = drive.dynamics(static_cast<int>(mode));
      return moving.state * now.state + moving.drift + moving.command * command +
             moving.force * now.force;
    };
    const auto by_plant = [&](double transmitted) -> Vector<double, 4> {
      return plant.state_matrix() * now.state + plant.control_input() * transmitted +
             plant.excitation_input() * now.force;
    };
    const double size = by_plant(0.0).norm() + by_plant(now.command).norm();
    ASSERT_LE((rate(ContactMode::engaged, now.command) - by_plant(now.command)).norm(),
              1e-14 * size);
    ASSERT_LE((rate(ContactMode::gap, now.command) - by_plant(0.0)).norm(), 1e-14 * size);
    // a(s) = a(0) − s (1/m₁ + 1/m₂)
    const double holding = relative_acceleration_by_newton(plant, now, 0.0) /
                           (1.0 / plant.conductor_mass + 1.0 / plant.absorber_mass);
    const Vector<double, 4> held = rate(ContactMode::stick, now.command);
    ASSERT_LE((held - by_plant(holding)).norm(), 1e-11 * (size + by_plant(holding).norm()));
    ASSERT_EQ(held[1], held[3]) << "to the last bit: the sides stay together";
    ASSERT_EQ(held[0], held[2]);
  }
}

/// A drive that sticks; the instant is changed until it does.
DriveContact<> sticking_drive(const TwoMass<double>& plant, test::Random& random,
                              ContactInstant& now) {
  while (true) {
    DriveContact<> drive = moved_drive(plant, 0.1, random.sign());
    now = reversal_instant(plant, random);
    drive.reached(0, now);
    if (drive.word() == ContactMode::stick) return drive;
  }
}

TEST(ExactBacklash, ADisplacedDriveDoesNotStick) {
  test::Random random(1327);
  const auto plant = kollar2022_plant();
  ContactInstant now;
  DriveContact<> drive = sticking_drive(plant, random, now);
  drive.displaced();
  EXPECT_EQ(drive.word(), ContactMode::gap);
  for (int g = 0; g < 2; ++g) EXPECT_EQ(drive.guards().guard[static_cast<std::size_t>(g)].zeros, 0);
}

TEST(ExactBacklash, AShiftedGapIsAsWide) {
  test::Random random(1328);
  const auto plant = kollar2022_plant();
  ContactInstant now;
  DriveContact<> drive = sticking_drive(plant, random, now);
  const double lower = drive.lower(), upper = drive.upper();
  drive.shift_gap(0.25);
  EXPECT_DOUBLE_EQ(drive.lower(), lower + 0.25);
  EXPECT_DOUBLE_EQ(drive.upper(), upper + 0.25);
}

TEST(ExactBacklash, WithoutWidthNothingEndsTheContact) {
  const DriveContact<> drive = test::exact_backlash(kollar2022_plant(), 0.0);
  EXPECT_EQ(drive.guards().count, 0);
  EXPECT_EQ(drive.word(), ContactMode::engaged);
  EXPECT_EQ(drive.sign(), 0.0);
  EXPECT_EQ(drive.commanded(-3.0), -3.0);
}

TEST(ExactBacklash, TheSignOfADriveAtRestIsNotKnown) {
  DriveContact<> drive = test::exact_backlash(kollar2022_plant(), 0.1);
  ASSERT_EQ(drive.guards().count, 1);
  EXPECT_TRUE(drive.guards().guard[0].unsigned_yet);
  drive.learn_sign(0, -1.0);
  EXPECT_FALSE(drive.guards().guard[0].unsigned_yet);
  EXPECT_EQ(drive.guards().guard[0].state, -velocity_row());
}

TEST(ExactBacklash, AWidthOutOfRangeIsRefused) {
  for (const double width :
       {-1e-9, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(test::exact_backlash(kollar2022_plant(), width), InvalidParameter) << width;
}

TEST(ContactMode, HasAWord) {
  EXPECT_EQ(std::string(word_for(ContactMode::engaged)), "engaged");
  EXPECT_EQ(std::string(word_for(ContactMode::gap)), "gap");
  EXPECT_EQ(std::string(word_for(ContactMode::stick)), "stick");
}

}  // namespace
}  // namespace holdfast
