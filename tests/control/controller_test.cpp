#include "holdfast/control/controller.hpp"

#include "support/message_of.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

/// By how much two compilations of P z₁ + D ż₁ may differ: not at all, unless the processor has a
/// fused multiply-add, which a compiler may give to either product.
double fusion_slack(const PdGains<double>& gains, double displacement, double velocity) {
#ifdef FP_FAST_FMA
  return std::numeric_limits<double>::epsilon() *
         (std::abs(gains.proportional * displacement) + std::abs(gains.differential * velocity));
#else
  static_cast<void>(gains), static_cast<void>(displacement), static_cast<void>(velocity);
  return 0;
#endif
}

PdGains<double> drawn_gains(test::Random& random) {
  return {random.sign() * random.log_uniform(1, 1e4),
          random.sign() * random.log_uniform(1e-2, 1e3)};
}

/// What a controller reads at a sample.
struct Reading {
  double displacement, velocity, elapsed;
};

Reading drawn_reading(test::Random& random) {
  return {random.uniform(-0.01, 0.01), random.uniform(-0.5, 0.5), random.log_uniform(1e-4, 1e-1)};
}

double command_of(Controller& controller, const Reading& reading) {
  return controller.command(reading.displacement, reading.velocity, reading.elapsed);
}

ControllerLimits velocity_by_difference(double displacement_quantum = 0) {
  ControllerLimits limits;
  limits.displacement_quantum = displacement_quantum;
  limits.velocity = VelocitySensing::difference;
  return limits;
}

TEST(Controller, WithoutLimitsIsThePlainLawToTheLastBit) {
  test::Random random(711);
  for (int draw = 0; draw < 1000; ++draw) {
    const auto gains = drawn_gains(random);
    Controller controller(gains, {});
    for (int sample = 0; sample < 100; ++sample) {
      const auto reading = drawn_reading(random);
      const double plain =
          gains.proportional * reading.displacement + gains.differential * reading.velocity;
      ASSERT_NEAR(command_of(controller, reading), plain,
                  fusion_slack(gains, reading.displacement, reading.velocity));
    }
  }
}

TEST(Controller, AMeasuredVelocityNeedsNoElapsedTime) {
  Controller controller({-557.0, -13.0}, {});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  controller.command(0.25, 0.5, nan);
  EXPECT_EQ(controller.command(0.25, 0.5, nan), -557.0 * 0.25 - 13.0 * 0.5);
}

TEST(Controller, ReadsMultiplesOfItsQuanta) {
  ControllerLimits limits;
  limits.displacement_quantum = 0.25;
  limits.velocity_quantum = 0.5;
  Controller controller({3.0, 10.0}, limits);
  EXPECT_EQ(controller.command(0.9, 1.7, 1.0), 3.0 * 1.0 + 10.0 * 1.5);
  EXPECT_EQ(controller.command(-0.1, 0.2, 1.0), 0.0);
}

TEST(Controller, TheDifferenceIsThatOfTheDisplacementsAsRead) {
  Controller controller({0.0, 1.0}, velocity_by_difference(0.25));
  // Read as 0, 0.25, 0.25 and −0.25.
  controller.command(0.1, 0, 0.5);
  EXPECT_EQ(controller.command(0.2, 0, 0.5), 0.5);
  EXPECT_EQ(controller.command(0.3, 0, 0.5), 0.0);
  EXPECT_EQ(controller.command(-0.3, 0, 0.25), -2.0);
}

TEST(Controller, AVelocityQuantumDoesNothingToADifference) {
  test::Random random(714);
  const auto gains = drawn_gains(random);
  auto with = velocity_by_difference(1e-4);
  with.velocity_quantum = 0.1;
  Controller first(gains, with), second(gains, velocity_by_difference(1e-4));
  for (int sample = 0; sample < 1000; ++sample) {
    const auto reading = drawn_reading(random);
    ASSERT_EQ(command_of(first, reading), command_of(second, reading));
  }
}

TEST(Controller, TheForceNeverExceedsTheLargestAndIsElseThatOfTheLaw) {
  test::Random random(715);
  ControllerLimits limits;
  limits.largest_force = 2.5;
  int saturated = 0;
  for (int draw = 0; draw < 20000; ++draw) {
    const PdGains<double> gains{-557.0, -13.0};
    const auto reading = drawn_reading(random);
    Controller limited(gains, limits), ideal(gains, {});
    const double demand = command_of(ideal, reading), force = command_of(limited, reading);
    const bool free = std::abs(demand) <= 2.5;
    ASSERT_EQ(force, free ? demand : std::copysign(2.5, demand));
    ASSERT_EQ(limited.slope().displacement, free ? -557.0 : 0.0);
    ASSERT_EQ(limited.slope().velocity, free ? -13.0 : 0.0);
    saturated += free ? 0 : 1;
  }
  EXPECT_GT(saturated, 1000);
  EXPECT_LT(saturated, 19000);
}

constexpr double slope_step = 1e-7;

/// The slope of the command after `before`, by central differences of each of its arguments.
ControllerSlope differenced_slope(const PdGains<double>& gains, const ControllerLimits& limits,
                                  const Reading& before, const Reading& now) {
  const auto command = [&](double displacement, double velocity, double previous) {
    Controller controller(gains, limits);
    controller.command(before.displacement + previous, before.velocity, before.elapsed);
    return controller.command(now.displacement + displacement, now.velocity + velocity,
                              now.elapsed);
  };
  const double h = slope_step;
  return {(command(h, 0, 0) - command(-h, 0, 0)) / (2 * h),
          (command(0, h, 0) - command(0, -h, 0)) / (2 * h),
          (command(0, 0, h) - command(0, 0, -h)) / (2 * h)};
}

/// Whether a step of the differences could cross a jump of a quantiser or the kink of saturation.
bool next_to_a_switch(const PdGains<double>& gains, const ControllerLimits& limits,
                      const Reading& before, const Reading& now) {
  const auto near_jump = [](double value, double quantum) {
    if (quantum == 0) return false;
    const double quanta = value / quantum;
    return std::abs(quanta - std::floor(quanta) - 0.5) < 2 * slope_step / quantum;
  };
  ControllerLimits unlimited = limits;
  unlimited.largest_force = no_limit;
  Controller controller(gains, unlimited);
  command_of(controller, before);
  const double demand = command_of(controller, now);
  const double reach =
      2 * slope_step *
      (std::abs(gains.proportional) + std::abs(gains.differential) * (1 + 1 / now.elapsed));
  return near_jump(before.displacement, limits.displacement_quantum) ||
         near_jump(now.displacement, limits.displacement_quantum) ||
         near_jump(now.velocity, limits.velocity_quantum) ||
         std::abs(std::abs(demand) - limits.largest_force) < reach;
}

/// Compares the slope with differences at random readings. @return how many were compared
int slopes_agree(const ControllerLimits& limits, std::uint64_t seed) {
  test::Random random(seed);
  int compared = 0;
  for (int draw = 0; draw < 5000; ++draw) {
    const auto gains = drawn_gains(random);
    const auto before = drawn_reading(random), now = drawn_reading(random);
    if (next_to_a_switch(gains, limits, before, now)) continue;
    Controller controller(gains, limits);
    command_of(controller, before);
    command_of(controller, now);
    const auto slope = controller.slope();
    const auto differenced = differenced_slope(gains, limits, before, now);
    // Round-off of the two commands over the step between them.
    const double size = std::abs(gains.proportional) * 0.01 +
                        std::abs(gains.differential) * (0.5 + 0.02 / now.elapsed);
    const double tolerance = 1e-15 * size / slope_step;
    EXPECT_NEAR(slope.displacement, differenced.displacement, tolerance);
    EXPECT_NEAR(slope.velocity, differenced.velocity, tolerance);
    EXPECT_NEAR(slope.previous_displacement, differenced.previous_displacement, tolerance);
    ++compared;
  }
  return compared;
}

TEST(ControllerSlope, IsThatOfFiniteDifferencesWhereThereIsOne) {
  ControllerLimits displacement_only, velocity_only, saturating;
  displacement_only.displacement_quantum = 1e-3;
  velocity_only.velocity_quantum = 1e-2;
  saturating.largest_force = 10;
  auto saturating_difference = velocity_by_difference();
  saturating_difference.largest_force = 10;
  EXPECT_GT(slopes_agree({}, 717), 4000);
  EXPECT_GT(slopes_agree(displacement_only, 718), 4000);
  EXPECT_GT(slopes_agree(velocity_only, 719), 4000);
  EXPECT_GT(slopes_agree(saturating, 720), 4000);
  EXPECT_GT(slopes_agree(velocity_by_difference(), 721), 4000);
  EXPECT_GT(slopes_agree(velocity_by_difference(1e-3), 722), 4000);
  EXPECT_GT(slopes_agree(saturating_difference, 723), 4000);
}

TEST(ControllerSlope, TheFirstSampleOfADifferenceHasNoVelocity) {
  Controller controller({-557.0, -13.0}, velocity_by_difference());
  EXPECT_EQ(controller.slope().displacement, 0.0) << "nothing has been commanded";
  EXPECT_EQ(controller.command(0.002, 5.0, 0.001), -557.0 * 0.002);
  EXPECT_EQ(controller.slope().displacement, -557.0);
  EXPECT_EQ(controller.slope().velocity, 0.0);
  EXPECT_EQ(controller.slope().previous_displacement, 0.0);
}

TEST(ControllerMemory, ARestoredControllerGoesOnAsTheFirstWould) {
  test::Random random(724);
  auto limits = velocity_by_difference(1e-4);
  limits.largest_force = 8;
  const auto gains = drawn_gains(random);
  for (int samples_before = 0; samples_before < 4; ++samples_before) {
    Controller first(gains, limits), second(gains, limits);
    for (int sample = 0; sample < samples_before; ++sample) {
      command_of(first, drawn_reading(random));
    }
    EXPECT_EQ(first.memory().has_sampled, samples_before > 0);
    command_of(second, drawn_reading(random));  // to be forgotten
    second.restore(first.memory());
    for (int sample = 0; sample < 100; ++sample) {
      const auto reading = drawn_reading(random);
      ASSERT_EQ(command_of(first, reading), command_of(second, reading));
    }
  }
}

TEST(Controller, ATimeThatDoesNotPassIsRefusedAndForgotten) {
  Controller controller({0.0, 1.0}, velocity_by_difference());
  controller.command(1.0, 0, 0.0);  // the first sample has no earlier one to be apart from
  for (const double elapsed : {0.0, -0.001, no_limit, std::numeric_limits<double>::quiet_NaN()}) {
    try {
      controller.command(7.0, 0, elapsed);
      ADD_FAILURE() << elapsed;
    } catch (const InvalidParameter& error) {
      EXPECT_EQ(error.name(), "time since the last sample");
      EXPECT_EQ(error.unit(), "s");
    }
  }
  EXPECT_EQ(controller.command(1.5, 0, 0.25), 2.0);
}

TEST(ControllerLimits, AreIdealUnlessOneIsSet) {
  EXPECT_TRUE(is_ideal({}));
  ControllerLimits displacement, velocity, force;
  displacement.displacement_quantum = 1e-300;
  velocity.velocity_quantum = 1e-300;
  force.largest_force = 1e300;
  for (const auto& limits : {displacement, velocity, force, velocity_by_difference()}) {
    EXPECT_FALSE(is_ideal(limits));
    EXPECT_NO_THROW(validate(limits));
  }
}

std::string refused(const PdGains<double>& gains, const ControllerLimits& limits) {
  return tests::refused_name([&] { Controller(gains, limits); });
}

TEST(ControllerLimits, WhatIsOutOfRangeIsRefusedByName) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const PdGains<double> gains{-557.0, -13.0};
  for (const double value : {-1e-9, nan, no_limit}) {
    ControllerLimits displacement, velocity;
    displacement.displacement_quantum = value;
    velocity.velocity_quantum = value;
    EXPECT_EQ(refused(gains, displacement), "displacement quantum");
    EXPECT_EQ(refused(gains, velocity), "velocity quantum");
  }
  for (const double value : {0.0, -1.0, nan, -no_limit}) {
    ControllerLimits force;
    force.largest_force = value;
    EXPECT_EQ(refused(gains, force), "largest force");
  }
  EXPECT_EQ(refused({nan, -13.0}, {}), "proportional gain P");
  EXPECT_EQ(refused(gains, {}), "");
}

}  // namespace
}  // namespace holdfast
