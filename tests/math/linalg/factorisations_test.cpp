#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <vector>

#include "holdfast/math/linalg/elimination.hpp"
#include "holdfast/math/linalg/reflections.hpp"

#include "support/random.hpp"

namespace holdfast {
namespace {

// A pivot of zero and one of the wrong size ask for exchanges; a residual is small for any matrix.
TEST(Elimination, SolvesWithExchangesOfRows) {
  test::Random random(2317);
  for (int draw = 0; draw < 50; ++draw) {
    Matrix<double, 4> matrix = random.matrix<Matrix<double, 4>>();
    matrix(0, 0) = draw % 2 == 0 ? 0.0 : 1e-18;
    const Vector<double, 4> right = random.matrix<Vector<double, 4>>();
    const Vector<double, 4> solution = eliminated(matrix, right);
    EXPECT_LE((matrix * solution - right).norm(), 1e-14 * (1.0 + solution.norm()));
  }
}

TEST(Elimination, OfComplexNumbersLeavesNoResidual) {
  test::Random random(2318);
  using Complex = std::complex<double>;
  const Matrix<Complex, 4> matrix =
      random.matrix<Matrix<double, 4>>() + Complex(0, 1) * random.matrix<Matrix<double, 4>>();
  const Matrix<Complex, 4> solution =
      eliminated(matrix, Matrix<Complex, 4>(Matrix<Complex, 4>::Identity()));
  EXPECT_LE((matrix * solution - Matrix<Complex, 4>::Identity()).norm(), 1e-14 * solution.norm());
}

/// A regular one, one of rank 2, one with a column of zeros, one that is a triangle already.
template <class Square>
std::vector<Square> matrices(int order) {
  std::srand(7);
  const Square one = Square::Random(order, order), other = Square::Random(order, order);
  std::vector<Square> all{one, one.col(0) * other.row(1) + one.col(2) * other.row(3), one,
                          other.template triangularView<Eigen::Upper>()};
  all[2].col(1).setZero();
  return all;
}

/// A = Q R or Q R Qᵀ of orthogonal Q, with nothing below a diagonal of R.
template <class Square>
void expect_form(const Square& matrix, const Square& q, const Square& r, const Square& right,
                 int below) {
  EXPECT_LT((q.transpose() * q - Square::Identity(q.rows(), q.rows())).norm(), 1e-13);
  EXPECT_LT((q * r * right - matrix).norm(), 1e-13 * matrix.norm());
  for (Eigen::Index j = 0; j < r.cols(); ++j)
    for (Eigen::Index i = j + 1 + below; i < r.rows(); ++i) EXPECT_EQ(r(i, j), 0.0);
}

template <class Square>
void expect_factors(int order) {
  for (const Square& matrix : matrices<Square>(order)) {
    Square upper = matrix;
    const Square q = orthogonal_factor(upper);
    expect_form<Square>(matrix, q, upper, Square::Identity(order, order), 0);
    const HessenbergForm<Square> hessenberg(matrix);
    expect_form<Square>(matrix, hessenberg.basis, hessenberg.form, hessenberg.basis.transpose(), 1);
    EXPECT_EQ(HessenbergForm<Square>(matrix, false).form, hessenberg.form);
    // Eigen's, by blocks, begins with the same column.
    const Square theirs = Eigen::HessenbergDecomposition<Square>(matrix).matrixH();
    EXPECT_NEAR(Eigen::HouseholderQR<Square>(matrix).matrixQR()(0, 0), upper(0, 0), 1e-14);
    EXPECT_NEAR(theirs(1, 0), hessenberg.form(1, 0), 1e-14);
  }
}

TEST(Reflections, FactoriseAndReduceMatricesOfAnyRank) {
  expect_factors<Matrix<double, 5>>(5);
  expect_factors<Eigen::MatrixXd>(4);
  expect_factors<Eigen::MatrixXd>(33);
}

TEST(Reflections, OfATallMatrixGiveItsLeastSquares) {
  const Eigen::MatrixXd tall = Eigen::MatrixXd::Random(10, 5),
                        right = Eigen::MatrixXd::Random(10, 3);
  Eigen::MatrixXd upper = tall, turned = right;
  reflect_to_triangle(upper, turned);
  const Eigen::MatrixXd by_triangle =
      upper.topRows(5).triangularView<Eigen::Upper>().solve(turned.topRows(5));
  EXPECT_LT((tall.transpose() * (tall * by_triangle - right)).norm(), 1e-13);
}

}  // namespace
}  // namespace holdfast
