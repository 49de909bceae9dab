#include "holdfast/math/linalg/exponential.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <unsupported/Eigen/MatrixFunctions>

namespace holdfast {
namespace {

TEST(Exponential, OfARotationIsTheRotation) {
  Matrix<double, 2> spin;
  spin << 0.0, -1.0, 1.0, 0.0;
  for (const double angle : {1e-9, 0.3, 2.0, 40.0}) {
    const Matrix<double, 2> turned = exponential<double, 2>(spin * angle);
    EXPECT_NEAR(turned(0, 0), std::cos(angle), 1e-14 * (1.0 + angle));
    EXPECT_NEAR(turned(1, 0), std::sin(angle), 1e-14 * (1.0 + angle));
  }
}

TEST(Exponential, OfANilpotentMatrixIsItsShortSeries) {
  Matrix<double, 3> shift = Matrix<double, 3>::Zero();
  shift(0, 1) = shift(1, 2) = 7.0;
  const Matrix<double, 3> power = exponential(shift);
  EXPECT_NEAR(power(0, 2), 24.5, 1e-13);
  EXPECT_NEAR(power(0, 1), 7.0, 1e-14);
  EXPECT_EQ(power(2, 0), 0.0);
}

TEST(Exponential, AgreesWithPadeApproximants) {
  std::srand(7);
  for (int draw = 0; draw < 50; ++draw) {
    const Matrix<double, 4> matrix = Matrix<double, 4>::Random() * 5.0;
    const Matrix<double, 4> pade = matrix.exp();
    EXPECT_LE((exponential(matrix) - pade).norm(), 1e-13 * pade.norm());
  }
}

TEST(Exponential, ItsInverseIsThatOfTheOppositeMatrix) {
  std::srand(8);
  const Matrix<double, 4> matrix = Matrix<double, 4>::Random() * 2.0;
  const Matrix<double, 4> opposite = -matrix;
  const Matrix<double, 4> product = exponential(matrix) * exponential(opposite);
  EXPECT_LE((product - Matrix<double, 4>::Identity()).norm(), 1e-12);
}

TEST(Exponential, OfAnInfiniteEntryIsNotFinite) {
  Matrix<double, 2> matrix = Matrix<double, 2>::Identity();
  matrix(0, 1) = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(exponential(matrix).allFinite());
}

}  // namespace
}  // namespace holdfast
