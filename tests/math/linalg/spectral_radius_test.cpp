#include "holdfast/math/linalg/spectral_radius.hpp"

#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(SpectralRadius, IsThatOfAScaledRotation) {
  Matrix<double, 2> m;
  m << 0.6, -0.8, 0.8, 0.6;
  EXPECT_NEAR((spectral_radius<double, 2>(1.5 * m)), 1.5, 1e-15);
  EXPECT_NEAR((spectral_abscissa<double, 2>(1.5 * m)), 0.9, 1e-15);
}

TEST(SpectralRadius, OfATriangularMatrixIsItsLargestDiagonalEntry) {
  Matrix<double, 3> m;
  m << -2, 5, 1, 0, 0.5, 7, 0, 0, 1;
  EXPECT_NEAR((spectral_radius<double, 3>(m)), 2.0, 1e-14);
  EXPECT_NEAR((spectral_abscissa<double, 3>(m)), 1.0, 1e-14);
}

TEST(SpectralRadius, IsTheGrowthOfHighPowers) {
  test::Random random(171);
  for (int draw = 0; draw < 100; ++draw) {
    const Matrix<double, 5> m = random.matrix<Matrix<double, 5>>();
    Matrix<double, 5> power = m;
    double logarithm = 0;
    for (int doubling = 0; doubling < 12; ++doubling) {
      const double size = power.norm();
      logarithm = 2 * (logarithm + std::log(size));
      power = (power / size) * (power / size);
    }
    // ‖M^4096‖^{1/4096} exceeds ρ by a factor that falls as 4096^{4/4096} at worst.
    EXPECT_NEAR((logarithm + std::log(power.norm())) / 4096,
                std::log(spectral_radius<double, 5>(m)), 0.01);
  }
}

}  // namespace
}  // namespace holdfast
