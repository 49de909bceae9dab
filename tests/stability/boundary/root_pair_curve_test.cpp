#include "holdfast/stability/boundary/root_pair_curve.hpp"

#include "support/polynomial/pair_gains.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(RootPairCurve, PutsThePairOnTheUnitCircle) {
  const auto polynomial =
      characteristic_polynomial(sampled_loop(kollar2022_plant(), Sampling<double>{0.01, 0.004}));
  const RootPairCurve<double> curve(in_half_plane(polynomial));
  for (const double angle : {0.1, 0.5, 1.0, 2.0, 3.0}) {
    const double y = std::tan(angle / 2.0) / curve.unit();
    const auto gains = curve.gains(y * y);
    const auto expected = test::complex_pair_gains(polynomial, angle);
    ASSERT_TRUE(expected);
    EXPECT_NEAR(gains.proportional, expected->proportional, 1e-9 * std::abs(gains.proportional));
    EXPECT_NEAR(gains.differential, expected->differential, 1e-9 * std::abs(gains.differential));
    EXPECT_NEAR(2.0 * std::atan(curve.root(y * y)), angle, 1e-14);
  }
}

}  // namespace
}  // namespace holdfast
