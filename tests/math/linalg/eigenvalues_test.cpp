#include "holdfast/math/linalg/eigenvalues.hpp"

#include <Eigen/SVD>

#include "support/testing.hpp"

namespace holdfast {
namespace {

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

}  // namespace
}  // namespace holdfast
