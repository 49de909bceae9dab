#include "holdfast/control/loop_input.hpp"

#include "holdfast/motion/sampled_motion.hpp"
#include "support/move_samples.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

constexpr double omega = 2.0 * pi<double> * 10.0;

const std::vector<double> periods = {0.004, 0.002, 0.001, 0.0005, 0.00025};

/// The order of convergence: slope of log(error) over log(period).
double order_of(const std::function<double(double)>& error_at) {
  double mean_x = 0, mean_y = 0, covariance = 0, variance = 0;
  const auto count = static_cast<double>(periods.size());
  std::vector<double> errors;
  for (const double period : periods) {
    errors.push_back(error_at(period));
    mean_x += std::log(period) / count;
    mean_y += std::log(errors.back()) / count;
  }
  for (std::size_t k = 0; k < periods.size(); ++k) {
    covariance += (std::log(periods[k]) - mean_x) * (std::log(errors[k]) - mean_y);
    variance += (std::log(periods[k]) - mean_x) * (std::log(periods[k]) - mean_x);
  }
  return covariance / variance;
}

/// The state at `duration` of the uncontrolled plant from rest under the given input.
Vector<double, 4> state_at(double duration, const SampledLoop<double>& loop,
                           const HarmonicInput<double>& input) {
  SampledMotion<double> motion(loop, {0, 0}, input, {0.5, 10.0}, Backlash<double>(0.0),
                               Vector<double, 4>::Zero());
  const auto steps = static_cast<int>(std::lround(duration / loop.sampling.period));
  test::move_samples(motion, steps);
  return motion.state();
}

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

TEST(ExactHarmonic, TheMotionDoesNotDependOnHowTheTimeIsCut) {
  const auto plant = kollar2022_plant();
  const auto coarse = sampled_loop(plant, Sampling<double>{0.01});
  const auto fine = sampled_loop(plant, Sampling<double>{0.0005});
  const Vector<double, 4> a = state_at(1.0, coarse, exact_harmonic(plant, 0.01, omega));
  const Vector<double, 4> b = state_at(1.0, fine, exact_harmonic(plant, 0.0005, omega));
  EXPECT_LE((a - b).norm(), 1e-12 * a.norm());
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

// A force that begins in the middle of a period: the second half of a step is the first one ahead.
TEST(AheadBy, TheSecondHalfOfAPeriodIsTheFirstOneAhead) {
  const auto plant = kollar2022_plant();
  for (const double period : {0.001, 0.01}) {
    const auto half = exact_harmonic(plant, period / 2, omega);
    const auto later = ahead_by(omega * period / 2, half);
    const auto whole = exact_harmonic(plant, period, omega);
    const Matrix<double, 4> step = sampled_loop(plant, Sampling<double>{period / 2}).transition;
    EXPECT_LE((step * half.cosine + later.cosine - whole.cosine).norm(),
              1e-14 * whole.cosine.norm());
    EXPECT_LE((step * half.sine + later.sine - whole.sine).norm(), 1e-14 * whole.cosine.norm());
  }
}

// What is second order about the held force is one step: it errs by ½ ω τ² c sin(ωt) in velocity.
// Over a fixed time 1/τ such steps add up to a motion that is first order in τ, because a held
// force is, in the mean, the force of τ/2 ago. Take that delay out (sample the force mid-way) and
// the rest is second order.
TEST(HeldHarmonic, OneStepErrsInSecondOrder) {
  const auto plant = kollar2022_plant();
  const auto error_at = [&](double period) {
    const auto held = held_harmonic(sampled_loop(plant, Sampling<double>{period}));
    const auto exact = exact_harmonic(plant, period, omega);
    const double at = 0.03;  // any instant at which the force is changing
    return std::abs((exact.cosine[1] - held.cosine[1]) * std::cos(omega * at) +
                    exact.sine[1] * std::sin(omega * at));
  };
  EXPECT_NEAR(order_of(error_at), 2.0, 0.1);
}

/// The order of the error of z₁ after 2 s with the input of (loop) instead of the exact one.
template <class Input>
double order_of_motion(const Input& input) {
  return order_of([&](double period) {
    const auto loop = sampled_loop(kollar2022_plant(), Sampling<double>{period});
    const auto exact = exact_harmonic(kollar2022_plant(), period, omega);
    return std::abs(state_at(2.0, loop, input(loop))[0] - state_at(2.0, loop, exact)[0]);
  });
}

TEST(HeldHarmonic, TheMotionErrsInFirstOrder) {
  EXPECT_NEAR(order_of_motion([](const auto& loop) { return held_harmonic(loop); }), 1.0, 0.1);
}

TEST(HeldHarmonic, WithoutItsHalfPeriodOfDelayTheMotionErrsInSecondOrder) {
  const auto midway = [](const SampledLoop<double>& loop) -> HarmonicInput<double> {
    const double shift = omega * loop.sampling.period / 2;
    return {loop.held_excitation * std::cos(shift), loop.held_excitation * -std::sin(shift)};
  };
  EXPECT_NEAR(order_of_motion(midway), 2.0, 0.1);
}

}  // namespace
}  // namespace holdfast
