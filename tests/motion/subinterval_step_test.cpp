#include "holdfast/motion/subinterval_step.hpp"

#include "holdfast/contact/contact.hpp"
#include "support/random.hpp"
#include "support/random_loop.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

AffineDynamics dynamics_of_plant(const TwoMass<double>& plant) {
  return {plant.state_matrix(), plant.control_input(), plant.excitation_input()};
}

/// F_l cos ω_l t and F_l sin ω_l t.
std::vector<ExcitationSample<double>> phases_at(const std::vector<Harmonic>& lines, double time) {
  std::vector<ExcitationSample<double>> phases;
  for (const Harmonic& line : lines) {
    const double angle = line.angular_frequency() * time;
    phases.push_back({line.amplitude * std::cos(angle), line.amplitude * std::sin(angle)});
  }
  return phases;
}

TEST(SubintervalStep, BothPartsOfAPeriodAreTheSampledLoop) {
  test::Random random(1341);
  for (int draw = 0; draw < 300; ++draw) {
    const auto plant = test::random_plant(random);
    const Sampling<double> sampling = test::random_sampling(plant, random);
    const SampledLoop<double> loop = sampled_loop(plant, sampling);
    const double delay = sampling.processing_delay;
    const SubintervalStep first(dynamics_of_plant(plant), {}, 0.0, delay);
    const SubintervalStep second(dynamics_of_plant(plant), {}, delay, sampling.period - delay);
    const Vector<double, 4> begin = random.matrix<Vector<double, 4>>();
    const double before = random.uniform(-9, 9), now = random.uniform(-9, 9), held = 2.5;
    const Vector<double, 4> found =
        second.state(first.state(begin, before, held, {}), now, held, {});
    const Vector<double, 4> expected = loop.transition * begin + loop.previous_force * before +
                                       loop.present_force * now + loop.held_excitation * held;
    const Vector<double, 4> size = loop.transition.cwiseAbs() * begin.cwiseAbs() +
                                   loop.previous_force.cwiseAbs() * std::abs(before) +
                                   loop.present_force.cwiseAbs() * std::abs(now) +
                                   loop.held_excitation.cwiseAbs() * held;
    ASSERT_LE((found - expected).cwiseQuotient(size).cwiseAbs().maxCoeff(), 1e-10) << draw;
  }
}

// z(t_j + begin + length) does not depend on where the part before it was cut.
TEST(SubintervalStep, TwoPartsAreOneLongerPart) {
  test::Random random(1342);
  const std::vector<Harmonic> lines{{0.5, 10.0}, {0.3, 27.0, 1.1}, {0.2, 1.7, -2.5}};
  for (int draw = 0; draw < 300; ++draw) {
    const auto plant = test::random_plant(random);
    const AffineDynamics dynamics = dynamics_on_stop(plant, plant.absorber_stiffness, 0.0, 0.01);
    const double begin = random.uniform(0.0, 0.01), cut = random.uniform(0.0, 0.01);
    const double length = cut + random.uniform(0.0, 0.01);
    const SubintervalStep whole(dynamics, lines, begin, length);
    const SubintervalStep first(dynamics, lines, begin, cut);
    const SubintervalStep second(dynamics, lines, begin + cut, length - cut);
    const auto phases = phases_at(lines, random.uniform(0.0, 1.0));
    const Vector<double, 4> z = random.matrix<Vector<double, 4>>();
    const double command = random.uniform(-5, 5);
    const Vector<double, 4> once = whole.state(z, command, 0.0, phases);
    const Vector<double, 4> twice =
        second.state(first.state(z, command, 0.0, phases), command, 0.0, phases);
    const double size = once.norm() + (whole.transition.cwiseAbs() * z.cwiseAbs()).norm() +
                        whole.drift.norm() + whole.command.norm() * std::abs(command);
    ASSERT_LE((once - twice).norm(), 1e-11 * size) << draw;
  }
}

// The quotient of differences of a short part is the equation of motion at its beginning.
TEST(SubintervalStep, ItsRateIsTheEquationOfMotionWithItsPhases) {
  test::Random random(1343);
  const auto plant = kollar2022_plant();
  const AffineDynamics dynamics = dynamics_on_stop(plant, 300.0, 2.0, 0.001);
  const std::vector<Harmonic> lines{{0.5, 10.0, 0.3}, {0.3, 27.0, -1.1}};
  for (int draw = 0; draw < 200; ++draw) {
    const double begin = random.uniform(0.0, 0.01), time = random.uniform(0.0, 1.0);
    const double length = 1e-6, command = random.uniform(-5, 5);
    const SubintervalStep step(dynamics, lines, begin, length);
    const Vector<double, 4> z = 0.01 * random.matrix<Vector<double, 4>>();
    const Vector<double, 4> rate =
        (step.state(z, command, 0.0, phases_at(lines, time)) - z) / length;
    double force = 0.0;
    for (const Harmonic& line : lines) force += line.at(time + begin + length / 2);
    const Vector<double, 4> expected =
        dynamics.state * z + dynamics.drift + dynamics.command * command + dynamics.force * force;
    ASSERT_LE((rate - expected).norm(), 1e-3 * expected.norm() + 1e-3) << draw;
    const Vector<double, 4> without = expected - dynamics.force * force;
    ASSERT_GT((rate - without).norm(),
              0.5 * (dynamics.force * force).norm() - 2e-3 - 1e-3 * expected.norm());
  }
}

TEST(SubintervalStep, WithoutLengthNothingMoves) {
  const SubintervalStep step(dynamics_of_plant(kollar2022_plant()), {{0.5, 10.0}}, 0.004, 0.0);
  const Vector<double, 4> z(0.001, -0.02, 0.003, 0.04);
  EXPECT_EQ(step.state(z, 5.0, 0.0, phases_at({{0.5, 10.0}}, 0.3)), z);
  EXPECT_EQ(step.state(z, 5.0, 0.7, {}), z);
}

}  // namespace
}  // namespace holdfast
