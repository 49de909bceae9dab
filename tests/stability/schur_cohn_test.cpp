#include "holdfast/stability/schur_cohn.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "support/random.hpp"

namespace holdfast {
namespace {

using Complex = std::complex<double>;

TEST(SchurCohn, DecidesQuinticsByTheirRoots) {
  test::Random random(151);
  int stable = 0;
  for (int draw = 0; draw < 10000; ++draw) {
    Vector<Complex, 6> product = Vector<Complex, 6>::Unit(0);
    double radius = 0;
    const auto multiply_by = [&](const Complex& root) {
      for (int k = 5; k > 0; --k) product[k] = product[k - 1] - root * product[k];
      product[0] *= -root;
      radius = std::max(radius, std::abs(root));
    };
    for (int pair = 0; pair < 2; ++pair) {
      const Complex root = std::polar(random.uniform(0, 1.1), random.uniform(0, pi<double>));
      multiply_by(root);
      multiply_by(std::conj(root));
    }
    multiply_by(random.uniform(-1.1, 1.1));
    if (std::abs(radius - 1) < 1e-6) continue;
    const Vector<double, 6> p = product.real() * random.sign() * random.log_uniform(1e-3, 1e3);
    ASSERT_EQ((schur_cohn_stable<double, 6>(p)), radius < 1) << radius;
    stable += radius < 1 ? 1 : 0;
  }
  EXPECT_GT(stable, 1000);
  EXPECT_LT(stable, 9000);
}

TEST(SchurCohn, ALineIsStableWhereItsRootIsInside) {
  for (const double root : {-1.5, -1.0, -0.999, 0.0, 0.5, 1.0, 2.0}) {
    EXPECT_EQ((schur_cohn_stable<double, 2>(Vector<double, 2>(-root, 1.0))), std::abs(root) < 1)
        << root;
  }
}

TEST(SchurCohn, RootsOnTheCircleAreNotStable) {
  EXPECT_FALSE((schur_cohn_stable<double, 3>(Vector<double, 3>(1, 0, 1))));   // ± i
  EXPECT_FALSE((schur_cohn_stable<double, 3>(Vector<double, 3>(-1, 0, 1))));  // ± 1
}

TEST(SchurCohn, AVanishingLeadingCoefficientOrANanIsNotStable) {
  EXPECT_FALSE((schur_cohn_stable<double, 3>(Vector<double, 3>(0.1, 0.2, 0.0))));
  for (int k = 0; k < 3; ++k) {
    Vector<double, 3> p(0.1, 0.2, 1.0);
    ASSERT_TRUE((schur_cohn_stable<double, 3>(p)));
    p[k] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE((schur_cohn_stable<double, 3>(p)));
  }
}

}  // namespace
}  // namespace holdfast
