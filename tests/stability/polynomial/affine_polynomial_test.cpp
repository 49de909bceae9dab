#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"

#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

AffinePolynomial<double, 5> random_polynomial(test::Random& random) {
  using Coefficients = Polynomial<double, 5>;
  return {random.matrix<Coefficients>(), random.matrix<Coefficients>(),
          random.matrix<Coefficients>()};
}

TEST(AffinePolynomial, IsAffineInBothGains) {
  test::Random random(181);
  const auto p = random_polynomial(random);
  EXPECT_EQ(p.at({0, 0}), p.base);
  EXPECT_LE(
      (p.at({2, -3}) - (p.base + 2 * p.proportional - 3 * p.differential)).cwiseAbs().maxCoeff(),
      1e-15);
}

TEST(AffinePolynomial, ALinearMapCommutesWithTheGains) {
  test::Random random(182);
  for (int draw = 0; draw < 100; ++draw) {
    const auto p = random_polynomial(random);
    const PdGains<double> gains{random.uniform(-3, 3), random.uniform(-3, 3)};
    const Polynomial<double, 5> before = in_half_plane<double, 6>(p.at(gains));
    const Polynomial<double, 5> after = in_half_plane(p).at(gains);
    EXPECT_LE((before - after).cwiseAbs().maxCoeff(), 1e-12);
  }
}

}  // namespace
}  // namespace holdfast
