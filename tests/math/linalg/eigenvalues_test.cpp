#include <Eigen/SVD>

#include "holdfast/math/linalg/balancing.hpp"
#include "holdfast/math/linalg/eigenvalues.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"

#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(Balancing, FactorsArePowersOfTwoAndEvenOutRowsAndColumns) {
  test::Random random(36);
  for (int draw = 0; draw < 500; ++draw) {
    auto m = random.matrix<Matrix<double, 4>>();
    for (double& entry : m.reshaped()) entry += entry < 0 ? -0.5 : 0.5;
    Vector<double, 4> units;
    for (double& unit : units) unit = random.log_uniform(1e-6, 1e6);
    const Matrix<double, 4> scaled = units.cwiseInverse().asDiagonal() * m * units.asDiagonal();
    const BalancedMatrix<double, 4> similar(scaled);
    EXPECT_EQ(similar.restored(similar.balanced), scaled);
    const auto& factors = similar.factors;
    Matrix<double, 4> balanced = similar.balanced;
    balanced.diagonal().setZero();
    for (int i = 0; i < 4; ++i) {
      EXPECT_EQ(std::exp2(std::round(std::log2(factors[i]))), factors[i]);
      const double ratio = balanced.row(i).cwiseAbs().sum() / balanced.col(i).cwiseAbs().sum();
      EXPECT_GT(ratio, 0.2);
      EXPECT_LT(ratio, 5.0);
    }
  }
}

TEST(Balancing, AStateThatNothingDependsOnIsScaledToo) {
  Matrix<double, 2> m;
  m << 0.5, 0.0, 1024.0, 0.25;
  const BalancedMatrix<double, 2> similar(m);
  EXPECT_LE(similar.balanced.cwiseAbs().maxCoeff(), 1.0);
}

template <class Square>
Square random_matrix(std::mt19937& random, Eigen::Index size) {
  std::uniform_real_distribution<double> mantissa(-1.0, 1.0), exponent(-6.0, 6.0);
  Square matrix(size, size);
  for (double& entry : matrix.reshaped())
    entry = mantissa(random) * std::pow(10.0, exponent(random));
  return matrix;
}

/// Each belongs to a matrix that differs by rounding, by its singular values; and together they
/// have the traces of M and M², so that none stands for another.
template <class Square>
void expect_eigenvalues(Eigen::Index size) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    const Square matrix = random_matrix<Square>(random, size);
    const double scale = matrix.norm();
    const auto found = eigenvalues(matrix);
    ASSERT_EQ(found.size(), size);
    for (const std::complex<double>& value : found) {
      const Eigen::MatrixXcd shifted = matrix.template cast<std::complex<double>>() -
                                       value * Eigen::MatrixXcd::Identity(size, size);
      EXPECT_LT(Eigen::JacobiSVD<Eigen::MatrixXcd>(shifted).singularValues().minCoeff(),
                1e-14 * scale);
    }
    EXPECT_LT(std::abs(found.sum() - matrix.trace()), 1e-14 * scale);
    EXPECT_LT(std::abs(found.array().square().sum() - (matrix * matrix).trace()),
              1e-13 * scale * scale);
  }
}

TEST(Eigenvalues, AreThoseOfTheMatrixButForRounding) {
  expect_eigenvalues<Matrix<double, 5>>(5);
  for (const Eigen::Index size : {1, 2, 3, 4, 7, 12})
    expect_eigenvalues<Matrix<double, Eigen::Dynamic>>(size);
}

TEST(Eigenvalues, OfNothingButZerosAreZeros) {
  const Matrix<double, 4> zeros = Matrix<double, 4>::Zero();
  EXPECT_EQ(eigenvalues(zeros).cwiseAbs().maxCoeff(), 0.0);
  const Matrix<double, 4> tiny =
      Matrix<double, 4>::Constant(0.5 * std::numeric_limits<double>::min());
  EXPECT_EQ(eigenvalues(tiny).cwiseAbs().maxCoeff(), 0.0);
}

TEST(Eigenvalues, OfALongDoubleMatrixHaveItsDigits) {
  Matrix<long double, 2> matrix;
  matrix << 1.0L, 1.0L, 1.0L, -1.0L;  // ±√2
  for (const std::complex<long double>& value : eigenvalues(matrix))
    EXPECT_NEAR(static_cast<double>(std::abs(value) / std::sqrt(2.0L) - 1.0L), 0.0, 3e-19);
}

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
