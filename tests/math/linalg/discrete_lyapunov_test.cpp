#include "holdfast/math/linalg/discrete_lyapunov.hpp"

#include <Eigen/LU>

#include "holdfast/math/linalg/spectral_radius.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

/// V of V − MᵀV M = I as one linear system for all its entries.
Eigen::MatrixXd measure_by_entries(const Eigen::MatrixXd& map) {
  const Eigen::Index n = map.rows();
  Eigen::MatrixXd system = Eigen::MatrixXd::Identity(n * n, n * n);
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index l = 0; l < n; ++l)
        for (Eigen::Index k = 0; k < n; ++k) system(i + n * j, k + n * l) -= map(k, i) * map(l, j);
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(n, n);
  const Eigen::VectorXd entries =
      system.fullPivLu().solve(Eigen::Map<const Eigen::VectorXd>(identity.data(), n * n));
  return Eigen::Map<const Eigen::MatrixXd>(entries.data(), n, n);
}

Eigen::MatrixXd map_of_radius(test::Random& random, Eigen::Index size, double radius) {
  Eigen::MatrixXd map(size, size);
  for (double& entry : map.reshaped()) entry = random.uniform(-1.0, 1.0);
  return map * (radius / spectral_radius<double, Eigen::Dynamic>(map));
}

TEST(DiscreteLyapunov, SolvesItsEquation) {
  test::Random random(4201);
  for (const double radius : {0.0, 0.3, 0.9, 0.999}) {
    const Eigen::MatrixXd map = map_of_radius(random, 5, radius);
    const auto measure = discrete_lyapunov(map);
    ASSERT_TRUE(measure.has_value()) << radius;
    const Eigen::MatrixXd expected = measure_by_entries(map);
    EXPECT_LE((*measure - expected).norm(), 1e-10 / (1.0 - radius) * expected.norm()) << radius;
    EXPECT_EQ(*measure, measure->transpose()) << radius;
  }
}

TEST(DiscreteLyapunov, EveryStepFallsByTheSquareOfTheVector) {
  test::Random random(4202);
  const Eigen::MatrixXd map = map_of_radius(random, 40, 0.97);
  const auto measure = discrete_lyapunov(map);
  ASSERT_TRUE(measure.has_value());
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::VectorXd x(40);
    for (double& entry : x) entry = random.uniform(-1.0, 1.0);
    const Eigen::VectorXd next = map * x;
    const double before = x.dot(*measure * x), after = next.dot(*measure * next);
    EXPECT_NEAR(before - after, x.squaredNorm(), 1e-9 * before);
  }
}

TEST(DiscreteLyapunov, RefusesMapsThatDoNotContract) {
  test::Random random(4203);
  for (const double radius : {1.0, 1.0 + 1e-9, 1.5})
    EXPECT_FALSE(discrete_lyapunov(map_of_radius(random, 6, radius)).has_value()) << radius;
  // Rounding could hide that this one does.
  Eigen::MatrixXd slow = Eigen::MatrixXd::Identity(2, 2) * (1.0 - 1e-16);
  EXPECT_FALSE(discrete_lyapunov(slow).has_value());
}

}  // namespace
}  // namespace holdfast
