#include "holdfast/math/stats/slab_quadrature.hpp"

#include "holdfast/math/poly/polynomial.hpp"
#include "support/polynomial/made_polynomial.hpp"

namespace holdfast {
namespace {

template <class Scalar, class Function>
Scalar integral(const Function& function, const Scalar& lower, const Scalar& upper,
                const Scalar& tolerance) {
  const auto one = [&function](const Scalar& x) { return std::vector<Scalar>{function(x)}; };
  return detail::SlabQuadrature<Scalar, decltype(one)>(one, tolerance).integrate(lower, upper)[0];
}

TEST(SlabQuadrature, TakesBranchPointsAtBothEnds) {
  const auto half_circle = [](double x) { return std::sqrt(std::max(0.0, x * (2 - x))); };
  EXPECT_NEAR(integral(half_circle, 0.0, 2.0, 1e-13), pi<double> / 2, 1e-14);
  const auto cusp = [](double x) { return std::cbrt(x); };
  EXPECT_NEAR(integral(cusp, 0.0, 8.0, 1e-13), 12.0, 1e-12);
}

TEST(SlabQuadrature, TakesABranchPointBesideTheInterval) {
  for (const double beside : {1e-2, 1e-5, 1e-8}) {
    const auto steep = [beside](double x) { return std::sqrt(std::hypot(x, beside) + x); };
    const auto mirrored = [beside](double x) { return std::sqrt(std::hypot(x, beside) - x); };
    // ∫ √(r + x) + √(r − x) over (−1, 1), the two being mirror images.
    const double sum = integral(steep, -1.0, 1.0, 1e-13) - integral(mirrored, -1.0, 1.0, 1e-13);
    EXPECT_NEAR(sum, 0.0, 1e-12) << beside;
    // ∫ √(√(x² + b²) + x) dx = ⅔ √(r + x) (2x − r).
    const auto whole = [beside](double x) {
      const double r = std::hypot(x, beside);
      return 2.0 / 3.0 * std::sqrt(r + x) * (2 * x - r);
    };
    EXPECT_NEAR(integral(steep, 0.0, 1.0, 1e-13), whole(1.0) - whole(0.0), 1e-12) << beside;
  }
}

TEST(SlabQuadrature, ReachesExtendedPrecision) {
  const auto half_circle = [](long double x) { return std::sqrt(std::max(0.0L, x * (2 - x))); };
  const long double error =
      std::abs(integral(half_circle, 0.0L, 2.0L, 1e-17L) - pi<long double> / 2);
  EXPECT_LE(error, 1e-17L);
}

TEST(SlabQuadrature, IntegratesSeveralAtOnce) {
  const auto powers = [](double x) { return std::vector<double>{1.0, x, x * x}; };
  const auto found =
      detail::SlabQuadrature<double, decltype(powers)>(powers, 1e-14).integrate(-1.0, 2.0);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_NEAR(found[0], 3.0, 1e-14);
  EXPECT_NEAR(found[1], 1.5, 1e-14);
  EXPECT_NEAR(found[2], 3.0, 1e-14);
}

TEST(UnstableRoots, AreCountedInTheRightHalfPlane) {
  // (s² − 2s + 5)(s² + s + 1) and times (s − 0.3).
  const Polynomial<double, 2> unstable = test::quadratic(5, -2), stable = test::quadratic(1, 1);
  EXPECT_EQ(unstable_roots(test::product<4>(unstable, stable)), 2);
  EXPECT_EQ(unstable_roots(test::product<5>(unstable, stable, -0.3)), 3);
  EXPECT_EQ(unstable_roots(test::product<5>(stable, stable, 0.3)), 0);
}

}  // namespace
}  // namespace holdfast
