#include "holdfast/control/zero_order_hold.hpp"

#include "support/random.hpp"

namespace holdfast {
namespace {

using Matrix2 = Matrix<double, 2>;
using Vector2 = Vector<double, 2>;

/// A stable random generator with frequencies around 2π rad/s.
Matrix<double, 4> random_generator(test::Random& random) {
  Matrix<double, 4> a = 10.0 * random.matrix<Matrix<double, 4>>();
  a.diagonal().array() -= 10.0;
  return a;
}

TEST(ZeroOrderHold, DoubleIntegratorIsTheParabolaOfHandCalculation) {
  Matrix2 a;
  a << 0, 1, 0, 0;
  const Vector2 b(0, 1);
  for (const double h : {1e-6, 0.001, 0.3, 7.0}) {
    const auto step = zero_order_hold<double, 2, 1>(a, b, h);
    EXPECT_NEAR(step.transition(0, 0), 1.0, 1e-15);
    EXPECT_NEAR(step.transition(0, 1), h, 1e-15 * h);
    EXPECT_NEAR(step.transition(1, 0), 0.0, 1e-15);
    EXPECT_NEAR(step.input[0], h * h / 2, 2e-15 * h * h);
    EXPECT_NEAR(step.input[1], h, 1e-15 * h);
  }
}

TEST(ZeroOrderHold, OscillatorTurnsByItsAngle) {
  Matrix2 a;
  a << 0, 5, -5, 0;
  const auto step = zero_order_hold<double, 2, 1>(a, Vector2(0, 1), 0.9);
  Matrix2 rotation;
  rotation << std::cos(4.5), std::sin(4.5), -std::sin(4.5), std::cos(4.5);
  EXPECT_LE((step.transition - rotation).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_NEAR(step.input[0], (1 - std::cos(4.5)) / 5, 1e-14);
  EXPECT_NEAR(step.input[1], std::sin(4.5) / 5, 1e-14);
}

TEST(ZeroOrderHold, InputIsTheIntegralThatTheGeneratorUndoes) {
  // A ∫₀ʰ e^{As} ds B = (e^{Ah} − I) B
  test::Random random(62);
  for (int draw = 0; draw < 300; ++draw) {
    const auto a = random_generator(random);
    const auto b = random.matrix<Matrix<double, 4, 1>>();
    const double h = random.log_uniform(1e-4, 0.3);
    const auto step = zero_order_hold<double, 4, 1>(a, b, h);
    const Vector<double, 4> left = a * step.input;
    const Vector<double, 4> right = step.transition * b - b;
    EXPECT_LE((left - right).cwiseAbs().maxCoeff(), 1e-12 * (1 + step.transition.norm()));
  }
}

TEST(ZeroOrderHold, NoTimeChangesNothing) {
  test::Random random(63);
  const auto step = zero_order_hold<double, 4, 1>(random_generator(random),
                                                  random.matrix<Vector<double, 4>>(), 0.0);
  EXPECT_EQ(step.transition, (Matrix<double, 4>::Identity()));
  EXPECT_TRUE(step.input.isZero(0.0));
}

}  // namespace
}  // namespace holdfast
