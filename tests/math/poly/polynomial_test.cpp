#include "holdfast/math/poly/polynomial.hpp"

#include "support/random.hpp"

namespace holdfast {
namespace {

using Complex = std::complex<double>;

TEST(Polynomial, HornerAgreesWithTheSumOfPowers) {
  test::Random random(21);
  for (int draw = 0; draw < 1000; ++draw) {
    const auto p = random.matrix<Polynomial<double, 5>>();
    const Complex x(random.uniform(-2, 2), random.uniform(-2, 2));
    Complex sum(0), power(1);
    double scale = 0;
    for (int k = 0; k <= 5; ++k, power *= x) {
      sum += p[k] * power;
      scale += std::abs(power);
    }
    EXPECT_LE(std::abs(evaluate(p, x) - sum), 1e-14 * scale);
  }
}

TEST(Polynomial, TheValueOfAProductIsTheProductOfTheValues) {
  test::Random random(22);
  for (int draw = 0; draw < 1000; ++draw) {
    const auto a = random.matrix<Polynomial<double, 2>>();
    const auto b = random.matrix<Polynomial<double, 3>>();
    const double x = random.uniform(-1, 1);
    EXPECT_NEAR(evaluate(multiply<double, 3, 4>(a, b), x), evaluate(a, x) * evaluate(b, x), 1e-14);
  }
}

TEST(Polynomial, RootsOfAProductOfKnownFactorsAreFound) {
  Polynomial<double, 4> p;  // (x − 1)(x + 2)(x² + 2x + 5), roots 1, −2, −1 ± 2i
  p << -10, 1, 5, 3, 1;
  auto found = roots(p);
  ASSERT_EQ(found.size(), 4U);
  for (const Complex& expected : {Complex(1, 0), Complex(-2, 0), Complex(-1, 2), Complex(-1, -2)}) {
    double nearest = 1.0;
    for (const Complex& root : found) nearest = std::min(nearest, std::abs(root - expected));
    EXPECT_LE(nearest, 1e-14) << expected;
  }
}

TEST(Polynomial, EveryRootLeavesAResidualOfRoundOffSize) {
  test::Random random(23);
  for (int draw = 0; draw < 2000; ++draw) {
    auto p = random.matrix<Polynomial<double, 5>>();
    for (int k = 0; k <= 5; ++k) p[k] *= random.log_uniform(1e-4, 1e4);
    const auto found = roots(p);
    ASSERT_EQ(found.size(), 5U);
    for (const Complex& root : found) {
      double scale = 0;
      for (int k = 0; k <= 5; ++k) scale += std::abs(p[k]) * std::pow(std::abs(root), k);
      EXPECT_LE(std::abs(evaluate(p, root)), 1e-13 * scale);
    }
  }
}

TEST(Polynomial, RootsAtInfinityAreLeftOut) {
  Polynomial<double, 4> p;
  p << -6, 5, 1, 0, 0;  // (x + 6)(x − 1)
  ASSERT_EQ(roots(p).size(), 2U);
  p[4] = 1e-20;
  EXPECT_EQ(roots(p).size(), 4U);
  EXPECT_EQ(roots(p, 1e-15).size(), 2U);
}

TEST(Polynomial, ConstantsAndTheZeroPolynomialHaveNoRoots) {
  EXPECT_TRUE(roots(Polynomial<double, 3>(Polynomial<double, 3>::Unit(0))).empty());
  EXPECT_TRUE(roots(Polynomial<double, 3>(Polynomial<double, 3>::Zero())).empty());
}

TEST(Polynomial, ARootAtZeroStaysExactlyThere) {
  Polynomial<double, 3> p;
  p << 0, 2, -3, 1;  // x (x − 1)(x − 2)
  const auto found = roots(p);
  EXPECT_EQ(std::count_if(found.begin(), found.end(),
                          [](const Complex& x) { return std::abs(x) < 1e-300; }),
            1);
}

TEST(Derivative, IsThatOfEachPower) {
  const Polynomial<double, 3> p{5.0, -1.0, 2.0, 4.0};
  EXPECT_EQ((derivative<double, 4>(p)), (Polynomial<double, 2>{-1.0, 4.0, 12.0}));
}

TEST(MobiusZhukovsky, IsTheSubstitutionThatItStates) {
  test::Random random(161);
  for (int draw = 0; draw < 1000; ++draw) {
    const Vector<double, 6> p = random.matrix<Vector<double, 6>>();
    const Complex w(random.uniform(-0.8, 0.8), random.uniform(-2, 2));
    const Complex expected = std::pow(1.0 - w, 5) * evaluate(p, 2.0 * w / (1.0 - w));
    EXPECT_LE(std::abs(evaluate(in_half_plane<double, 6>(p), w) - expected), 1e-11);
  }
}

}  // namespace
}  // namespace holdfast
