#include "holdfast/contact/dead_zone.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "holdfast/core/types.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

TEST(DeadZone, TransmitsBeyondItsEndsWhichBelongToTheGap) {
  DeadZone<double> zone(0.5);
  for (const double inside : {0.0, 0.25, -0.25, 0.1}) {
    EXPECT_FALSE(zone.step(inside, 1.0)) << inside;
    EXPECT_TRUE(zone.inside());
    EXPECT_EQ(zone.touched_side(), 0.0);
  }
  for (const double sign : {1.0, -1.0}) {
    EXPECT_TRUE(zone.step(sign * std::nextafter(0.25, 1.0), -sign));
    EXPECT_FALSE(zone.inside());
    EXPECT_EQ(zone.touched_side(), sign);
  }
}

TEST(DeadZone, DecidesEverySampleAlone) {
  test::Random random(721);
  DeadZone<double> zone(0.5);
  for (int sample = 0; sample < 5000; ++sample) {
    const double displacement = random.uniform(-1, 1), velocity = random.uniform(-1, 1);
    DeadZone<double> fresh(0.5);
    const bool transmits = zone.step(displacement, velocity);
    ASSERT_EQ(transmits, fresh.step(displacement, -velocity));
    ASSERT_EQ(transmits, std::abs(displacement) > 0.25);
    ASSERT_EQ(transmits, zone.side(displacement) != 0.0);
  }
}

TEST(DeadZone, MirroredMotionIsMirroredExactly) {
  test::Random random(722);
  for (const double width : {0.0, 0.3}) {
    DeadZone<double> zone(width, {700.0, 3.0});
    for (int sample = 0; sample < 2000; ++sample) {
      const double displacement = random.uniform(-1, 1), velocity = random.uniform(-1, 1);
      ASSERT_EQ(zone.side(-displacement), -zone.side(displacement));
      ASSERT_EQ(zone.stop_force(-displacement, -velocity),
                -zone.stop_force(displacement, velocity));
    }
  }
}

TEST(DeadZone, WithoutDampingTheForceOfTheStopsIsContinuousAndPiecewiseLinear) {
  test::Random random(723);
  const double width = 0.5, stiffness = 900.0;
  const DeadZone<double> zone(width, {stiffness, 0.0});
  for (const double end : {0.25, -0.25}) {
    EXPECT_EQ(zone.stop_force(end, 1.0), 0.0);
    EXPECT_NEAR(zone.stop_force(std::nextafter(end, 4.0 * end), 1.0), 0.0, 1e-12);
  }
  for (int trial = 0; trial < 5000; ++trial) {
    const double one = random.uniform(-1, 1), other = random.uniform(-1, 1);
    const double difference = zone.stop_force(one, 0.0) - zone.stop_force(other, 0.0);
    ASSERT_LE(std::abs(difference), stiffness * std::abs(one - other) + 1e-12);
    if (one > 0.25 && other > 0.25) {
      ASSERT_NEAR(difference, stiffness * (one - other), 1e-12);
    }
    if (zone.side(one) == 0.0) {
      ASSERT_EQ(zone.stop_force(one, 1.0), 0.0);
    }
  }
}

TEST(DeadZone, TheDamperJumpsAtTheEndAndMayPullWhileTheSidesSeparate) {
  const DeadZone<double> zone(0.5, {100.0, 2.0});
  const double touched = std::nextafter(0.25, 1.0);
  EXPECT_EQ(zone.stop_force(0.25, 3.0), 0.0);
  EXPECT_NEAR(zone.stop_force(touched, 3.0), 6.0, 1e-12);
  EXPECT_LT(zone.stop_force(touched, -3.0), 0.0);
  EXPECT_NEAR(zone.stop_force(0.75, -25.0), 0.0, 1e-12) << "k_c penetration = c_c |velocity|";
}

TEST(DeadZone, TheElasticStopsStoreWhatTheyTakeUp) {
  // ∫ f dΔz from 0 to x is the energy k_c (|x| − r0/2)²/2 of a spring; midpoints are exact where f
  // is linear, and miss at most k_c Δx²/8 in the step with the kink.
  test::Random random(724);
  for (int trial = 0; trial < 200; ++trial) {
    const double width = random.uniform(0.0, 1.0), stiffness = random.log_uniform(1.0, 1e4);
    const DeadZone<double> zone(width, {stiffness, 0.0});
    const double reach = random.uniform(-2.0, 2.0);
    const int count = 1000;
    double work = 0.0;
    for (int k = 0; k < count; ++k)
      work += zone.stop_force(reach * (k + 0.5) / count, 0.0) * reach / count;
    const double penetration = std::fmax(std::abs(reach) - width / 2.0, 0.0);
    ASSERT_NEAR(work, stiffness * penetration * penetration / 2.0,
                stiffness * (std::pow(reach / count, 2.0) / 8.0 + 1e-12));
  }
}

TEST(DeadZone, UnderASineTheStopsTakeTheEnergyOfTheirDampers) {
  // Δz = X sin φ touches from θ = asin(r0/2X) to π − θ and a half turn later. Over a period the
  // elastic part gives back all, the dampers take c_c ω X² (π − 2θ − sin 2θ).
  const double frequency = 20.0, amplitude = 0.8, width = 0.5, damping = 3.0;
  const DeadZone<double> zone(width, {400.0, damping});
  const int count = 200000;
  const double step = 2.0 * pi<double> / count;
  double work = 0.0;
  for (int k = 0; k < count; ++k) {
    const double angle = (k + 0.5) * step, velocity = amplitude * frequency * std::cos(angle);
    work += zone.stop_force(amplitude * std::sin(angle), velocity) * velocity * step / frequency;
  }
  const double touch = std::asin(width / (2.0 * amplitude));
  const double taken = damping * frequency * amplitude * amplitude *
                       (pi<double> - 2.0 * touch - std::sin(2.0 * touch));
  // Four ends, each off by at most a step of the power c_c Δż² there.
  EXPECT_NEAR(work, taken, 4.0 * damping * amplitude * amplitude * frequency * step);
  EXPECT_GT(taken, 10.0);
}

TEST(DeadZone, ATouchedStopIsAStifferMoreDampedPlantUnderAConstantForce) {
  test::Random random(725);
  const double width = 0.002, stiffness = 350.0, damping = 1.5;
  const TwoMass<double> plant = kollar2022_plant();
  TwoMass<double> touched = plant;
  touched.absorber_stiffness += stiffness;
  touched.absorber_damping += damping;
  const DeadZone<double> zone(width, {stiffness, damping});
  int sides[3] = {0, 0, 0};
  for (int trial = 0; trial < 2000; ++trial) {
    const Vector<double, 4> unit = random.matrix<Vector<double, 4>>();
    const Vector<double, 4> state = unit.cwiseProduct(Vector<double, 4>(0.002, 0.1, 0.002, 0.1));
    const double displacement = relative_displacement(state), side = zone.side(displacement);
    const double force = zone.stop_force(displacement, relative_velocity(state));
    const Vector<double, 4> found = plant.state_matrix() * state + plant.control_input() * force;
    const Vector<double, 4> expected = (side == 0.0 ? plant : touched).state_matrix() * state -
                                       plant.control_input() * (stiffness * side * width / 2.0);
    ASSERT_LE((found - expected).cwiseAbs().maxCoeff(), 1e-12);
    ++sides[static_cast<int>(side) + 1];
  }
  for (const int count : sides) EXPECT_GT(count, 200);
}

TEST(DeadZone, WithoutAGapTheForceIsAlwaysTransmittedAndTheStopsAreASpringAndADamper) {
  DeadZone<double> zone(0.0, {50.0, 2.0});
  test::Random random(726);
  for (const double zero : {0.0, -0.0}) {
    EXPECT_TRUE(zone.step(zero, 1.0));
    EXPECT_EQ(zone.stop_force(zero, 3.0), 6.0);
  }
  for (int sample = 0; sample < 1000; ++sample) {
    const double displacement = random.uniform(-1, 1), velocity = random.uniform(-1, 1);
    ASSERT_TRUE(zone.step(displacement, velocity));
    ASSERT_EQ(zone.side(displacement), displacement < 0.0 ? -1.0 : 1.0);
    ASSERT_EQ(zone.stop_force(displacement, velocity), 50.0 * displacement + 2.0 * velocity);
  }
}

TEST(DeadZoneContact, WhatIsOutOfRangeIsRefusedByName) {
  const auto refused = [](const DeadZoneContact& contact) -> std::string {
    try {
      validate(contact);
      return "";
    } catch (const InvalidParameter& error) {
      return error.name() + " " + error.unit();
    }
  };
  for (const double bad :
       {-1e-9, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(refused({bad, 0.0}), "contact stiffness kc N/m");
    EXPECT_EQ(refused({0.0, bad}), "contact damping cc N s/m");
  }
  EXPECT_EQ(refused({0.0, 0.0}), "");
}

}  // namespace
}  // namespace holdfast
