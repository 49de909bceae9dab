#include "holdfast/control/loop_input.hpp"

#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

TEST(HeldHarmonic, IsTheForceOfTheSampleHeld) {
  const auto loop = sampled_loop(kollar2022_plant(), Sampling<double>{0.01});
  const auto input = held_harmonic(loop);
  EXPECT_EQ(input.cosine, loop.held_excitation);
  EXPECT_TRUE(input.sine.isZero(0.0));
}

TEST(ExactHarmonic, TwoStepsAreOneLongerStep) {
  test::Random random(81);
  const auto plant = kollar2022_plant();
  for (int draw = 0; draw < 100; ++draw) {
    const double period = random.log_uniform(1e-4, 0.05), w = random.log_uniform(1, 500);
    const auto once = exact_harmonic(plant, period, w);
    const auto twice = exact_harmonic(plant, 2 * period, w);
    const Matrix<double, 4> step = sampled_loop(plant, Sampling<double>{period}).transition;
    const double c = std::cos(w * period), s = std::sin(w * period);
    const Vector<double, 4> cosine = step * once.cosine + c * once.cosine + s * once.sine;
    const Vector<double, 4> sine = step * once.sine - s * once.cosine + c * once.sine;
    const double scale = std::max(once.cosine.norm(), twice.cosine.norm());
    EXPECT_LE((twice.cosine - cosine).cwiseAbs().maxCoeff(), 1e-12 * scale);
    EXPECT_LE((twice.sine - sine).cwiseAbs().maxCoeff(), 1e-12 * scale);
  }
}

TEST(ExactHarmonic, AForceThatDoesNotChangeIsTheHeldForce) {
  const auto plant = kollar2022_plant();
  const auto loop = sampled_loop(plant, Sampling<double>{0.01});
  const auto input = exact_harmonic(plant, 0.01, 0.0);
  EXPECT_LE((input.cosine - loop.held_excitation).cwiseAbs().maxCoeff(),
            1e-12 * loop.held_excitation.norm());
  EXPECT_LE(input.sine.cwiseAbs().maxCoeff(), 1e-15);
}

TEST(AheadBy, AddsItsAngleToThePhase) {
  test::Random random(82);
  for (int draw = 0; draw < 200; ++draw) {
    const HarmonicInput<double> input{random.matrix<Vector<double, 4>>(),
                                      random.matrix<Vector<double, 4>>()};
    const double angle = random.uniform(-10, 10), other = random.uniform(-10, 10);
    const double theta = random.uniform(-10, 10);
    const auto ahead = ahead_by(angle, input);
    const Vector<double, 4> expected =
        input.cosine * std::cos(theta + angle) + input.sine * std::sin(theta + angle);
    const Vector<double, 4> found = ahead.cosine * std::cos(theta) + ahead.sine * std::sin(theta);
    EXPECT_LE((found - expected).norm(), 1e-14);
    const auto twice = ahead_by(other, ahead), together = ahead_by(angle + other, input);
    EXPECT_LE((twice.cosine - together.cosine).norm(), 1e-14);
    EXPECT_LE((twice.sine - together.sine).norm(), 1e-14);
  }
  const HarmonicInput<double> input{random.matrix<Vector<double, 4>>(),
                                    random.matrix<Vector<double, 4>>()};
  EXPECT_EQ(ahead_by(0.0, input).cosine, input.cosine);
  EXPECT_EQ(ahead_by(0.0, input).sine, input.sine);
}

}  // namespace
}  // namespace holdfast
