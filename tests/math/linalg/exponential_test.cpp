#include "holdfast/math/linalg/exponential.hpp"

#include <unsupported/Eigen/AutoDiff>

#include "support/random.hpp"

namespace holdfast {
namespace {

using Extended = Matrix<long double, 4>;

/// e^M = (Σ (M/2ˢ)ᵏ/k!)^{2ˢ}, the Taylor series in extended precision.
Extended by_series(const Matrix<double, 4>& matrix) {
  const int squarings = std::max(0, std::ilogb(matrix.norm()) + 2);
  const Extended scaled = matrix.cast<long double>() / std::ldexp(1.0L, squarings);
  Extended sum = Extended::Identity();
  for (int k = 40; k >= 1; --k) sum = (Extended::Identity() + scaled * sum / k).eval();
  for (int k = 0; k < squarings; ++k) sum = (sum * sum).eval();
  return sum;
}

Matrix<double, 4> random_matrix(test::Random& random, double size) {
  return random.matrix<Matrix<double, 4>>() * size;
}

TEST(Exponential, OfZeroIsTheIdentity) {
  EXPECT_EQ((exponential<double, 3>(Matrix<double, 3>::Zero())), (Matrix<double, 3>::Identity()));
}

// The sizes take every degree of the approximant and up to six squarings.
TEST(Exponential, IsTheTaylorSeriesInExtendedPrecision) {
  test::Random random(2311);
  for (const double size : {1e-6, 0.003, 0.03, 0.15, 0.4, 2.0, 20.0, 80.0}) {
    for (int draw = 0; draw < 50; ++draw) {
      const Matrix<double, 4> matrix = random_matrix(random, size);
      const Extended series = by_series(matrix);
      const auto error = static_cast<double>(
          (exponential(matrix).cast<long double>() - series).norm() / series.norm());
      EXPECT_LE(error, 1e-15 * (1.0 + size)) << size;
    }
  }
}

TEST(Exponential, InExtendedPrecisionHasItsDigits) {
  test::Random random(2312);
  for (const double size : {1e-6, 0.001, 0.03, 0.15, 1.0}) {
    const Matrix<double, 4> matrix = random_matrix(random, size);
    const Extended series = by_series(matrix);
    EXPECT_LE((exponential<long double, 4>(matrix.cast<long double>()) - series).norm(),
              2e-18L * series.norm())
        << size;
  }
}

TEST(Exponential, OfAnyOrderIsThatOfTheFixedOrder) {
  test::Random random(2315);
  for (const double size : {0.1, 3.0}) {
    const Matrix<double, 4> matrix = random_matrix(random, size);
    const Matrix<double, Eigen::Dynamic> any = matrix;
    EXPECT_LE((exponential(any) - exponential(matrix)).norm(), 1e-14 * exponential(matrix).norm());
  }
}

// d/dt e^{At} = A e^{At}, the derivatives of a dual number through pivots, scaling and squaring.
TEST(Exponential, OfADualNumberCarriesItsDerivative) {
  using Dual = Eigen::AutoDiffScalar<Vector<double, 1>>;
  test::Random random(2316);
  for (const double size : {0.1, 3.0}) {
    const Matrix<double, 4> matrix = random_matrix(random, size);
    Matrix<Dual, 4> moving;
    for (int k = 0; k < 16; ++k) moving(k) = Dual(matrix(k), Vector<double, 1>(matrix(k)));
    const Matrix<Dual, 4> power = exponential(moving);
    const Matrix<double, 4> rate = matrix * exponential(matrix);
    for (int k = 0; k < 16; ++k) {
      EXPECT_NEAR(power(k).value(), exponential(matrix)(k), 1e-14 * rate.norm());
      EXPECT_NEAR(power(k).derivatives()[0], rate(k), 1e-13 * rate.norm());
    }
  }
}

TEST(Exponential, OfAnInfiniteEntryIsNotFinite) {
  Matrix<double, 2> matrix = Matrix<double, 2>::Identity();
  for (const double entry :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    matrix(0, 1) = entry;
    EXPECT_FALSE(exponential(matrix).allFinite());
  }
}

}  // namespace
}  // namespace holdfast
