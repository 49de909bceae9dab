#include "support/polynomial/schur_cohn.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
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

// Pairs at a distance of 1e−4 … 1 from λ = 1, about the unit circle: what fast sampling gives.
TEST(SchurCohnInMu, DecidesRootsThatCrowdAtOne) {
  test::Random random(205);
  int stable = 0, lost_in_powers_of_lambda = 0;
  const int draws = 20000;
  for (int draw = 0; draw < draws; ++draw) {
    const double crowding = random.log_uniform(1e-4, 1.0);
    const Vector<double, 2> real_root(random.uniform(0.5, 1.5), 1.0);  // λ = 1 − real_root[0]
    double growth = std::abs(1.0 - real_root[0]) - 1.0;
    Vector<double, 3> factors[2];
    for (auto& factor : factors) {
      const double angle = crowding * random.uniform(0.1, 3.0);
      const double excess = crowding * random.uniform(-0.1, 0.05);
      // μ = (1 + excess) e^{iθ} − 1 without cancellation.
      const double half = std::sin(angle / 2);
      const double real = excess * std::cos(angle) - 2 * half * half;
      const double imaginary = (1 + excess) * std::sin(angle);
      factor << real * real + imaginary * imaginary, -2 * real, 1.0;
      growth = std::max(growth, excess);
    }
    const Vector<double, 6> p =
        multiply<double, 5, 2>(multiply<double, 3, 3>(factors[0], factors[1]), real_root);
    ASSERT_EQ((schur_cohn_stable_in_mu<double, 6>(p)), growth < 0) << crowding << " " << growth;
    stable += growth < 0 ? 1 : 0;
    const bool by_lambda = schur_cohn_stable<double, 6>(in_powers_of_lambda<double, 6>(p));
    lost_in_powers_of_lambda += by_lambda != (growth < 0) ? 1 : 0;
  }
  EXPECT_GE(stable, draws / 10);
  EXPECT_LE(stable, draws * 9 / 10);
  EXPECT_GE(lost_in_powers_of_lambda, draws / 100);  // else this form would not be needed
}

}  // namespace
}  // namespace holdfast
