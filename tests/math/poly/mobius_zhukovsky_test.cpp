#include "holdfast/math/poly/polynomial.hpp"

#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

using Complex = std::complex<double>;

TEST(MobiusZhukovsky, IsTheSubstitutionThatItStates) {
  test::Random random(161);
  for (int draw = 0; draw < 1000; ++draw) {
    const Vector<double, 6> p = random.matrix<Vector<double, 6>>();
    const Complex w(random.uniform(-0.8, 0.8), random.uniform(-2, 2));
    const Complex expected = std::pow(1.0 - w, 5) * evaluate(p, 2.0 * w / (1.0 - w));
    EXPECT_LE(std::abs(evaluate(in_half_plane<double, 6>(p), w) - expected), 1e-11);
  }
}

TEST(MobiusZhukovsky, TakesTheUnitCircleToTheImaginaryAxis) {
  // λ = e^{iθ} is w = i tan(θ/2).
  for (double angle = 0.1; angle < 3.1; angle += 0.3) {
    Vector<double, 3> p;  // μ² + 2μ(1 − cos θ) + 2 (1 − cos θ), roots e^{±iθ} − 1
    p << 2 * (1 - std::cos(angle)), 2 * (1 - std::cos(angle)), 1;
    const auto q = in_half_plane<double, 3>(p);
    EXPECT_LE(std::abs(evaluate(q, Complex(0, std::tan(angle / 2)))),
              1e-12 * (1 + std::pow(std::tan(angle / 2), 2)));
    EXPECT_NEAR(q[1], 0.0, 1e-15);
  }
}

TEST(MobiusZhukovsky, EndCoefficientsAreTheValuesAtPlusAndMinusOne) {
  test::Random random(162);
  for (int draw = 0; draw < 100; ++draw) {
    const Vector<double, 6> p = random.matrix<Vector<double, 6>>();
    const auto q = in_half_plane<double, 6>(p);
    EXPECT_EQ(q[0], p[0]);
    EXPECT_NEAR(q[5], -evaluate(p, -2.0), 1e-13);  // (1 − w)⁵ → −w⁵ at w = ∞
  }
}

}  // namespace
}  // namespace holdfast
