#include "holdfast/math/linalg/eigenvalues.hpp"

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

/// To the last bit, since results that are published rest on the one.
template <class Square>
void expect_those_of_eigen(Eigen::Index size) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    const Square matrix = random_matrix<Square>(random, size);
    const Eigen::EigenSolver<Square> solver(matrix, false);
    ASSERT_EQ(solver.info(), Eigen::Success);
    const auto ours = eigenvalues(matrix);
    ASSERT_EQ(ours.size(), size);
    for (Eigen::Index k = 0; k < size; ++k) EXPECT_EQ(ours[k], solver.eigenvalues()[k]);
  }
}

TEST(Eigenvalues, AreThoseOfEigensSolverToTheLastBit) {
  expect_those_of_eigen<Matrix<double, 5>>(5);
  for (const Eigen::Index size : {1, 2, 3, 4, 7, 12})
    expect_those_of_eigen<Matrix<double, Eigen::Dynamic>>(size);
}

TEST(Eigenvalues, OfATurnAndOfADiagonalAreTheirEntries) {
  Matrix<double, 4> matrix = Matrix<double, 4>::Zero();
  matrix(0, 1) = 3.0;
  matrix(1, 0) = -3.0;
  matrix(2, 2) = 5.0;
  matrix(3, 3) = -7.0;
  const auto found = eigenvalues(matrix);
  double below = 0.0, above = 0.0, sum = 0.0;
  for (const std::complex<double>& value : found) {
    below = std::fmin(below, value.imag());
    above = std::fmax(above, value.imag());
    sum += value.real();
  }
  EXPECT_NEAR(above, 3.0, 1e-15);
  EXPECT_NEAR(below, -3.0, 1e-15);
  EXPECT_NEAR(sum, -2.0, 1e-14);
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
