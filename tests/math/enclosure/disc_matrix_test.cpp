// Products of matrices of discs against long doubles taken from all of the discs.

#include "holdfast/math/enclosure/disc_matrix.hpp"

#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast::test {
namespace {

using LongMatrix = Eigen::Matrix<std::complex<long double>, Eigen::Dynamic, Eigen::Dynamic>;

Eigen::MatrixXcd random_entries(Eigen::Index rows, Eigen::Index columns, Random& random) {
  return Eigen::MatrixXcd::NullaryExpr(rows, columns, [&] {
    return std::polar(random.log_uniform(1e-6, 1e6), random.uniform(0.0, 6.2831853));
  });
}

/// The product of the centres in extended precision.
LongMatrix exact_product(const Eigen::MatrixXcd& left, const Eigen::MatrixXcd& right) {
  return left.cast<std::complex<long double>>() * right.cast<std::complex<long double>>();
}

void expect_inside(const LongMatrix& exact, const DiscMatrix& discs) {
  for (Eigen::Index j = 0; j < exact.cols(); ++j)
    for (Eigen::Index i = 0; i < exact.rows(); ++i) {
      const std::complex<long double> centre(discs.centre(i, j));
      EXPECT_LE(std::abs(exact(i, j) - centre), static_cast<long double>(discs.radius(i, j)));
    }
}

TEST(DiscMatrix, ProductsHoldTheirRounding) {
  Random random(11);
  for (const Eigen::Index n : {1, 3, 20, 90}) {
    const Eigen::MatrixXcd left = random_entries(4, n, random),
                           right = random_entries(n, 5, random);
    const DiscMatrix discs = product(left, DiscMatrix(right));
    expect_inside(exact_product(left, right), discs);
    const Eigen::MatrixXd size = left.cwiseAbs() * right.cwiseAbs();
    EXPECT_LT((discs.radius.array() / size.array()).maxCoeff(), 1e-14 * static_cast<double>(n + 4));
  }
}

/// With each entry moved to the rim of its disc in the direction that moves the sum the farthest.
TEST(DiscMatrix, ProductsHoldWhatTheRimsMakeOfThem) {
  Random random(12);
  const Eigen::Index n = 12;
  const Eigen::MatrixXcd left = random_entries(3, n, random);
  DiscMatrix right(random_entries(n, 4, random));
  right.radius = 0.1 * right.centre.cwiseAbs();
  const DiscMatrix discs = product(left, right);
  for (Eigen::Index row = 0; row < 3; ++row) {
    Eigen::MatrixXcd moved = right.centre;
    for (Eigen::Index j = 0; j < 4; ++j)
      for (Eigen::Index k = 0; k < n; ++k)
        moved(k, j) +=
            (1.0 - 1e-12) * right.radius(k, j) * std::conj(left(row, k)) / std::abs(left(row, k));
    const LongMatrix farthest = exact_product(left, moved);
    expect_inside(farthest, discs);
    for (Eigen::Index j = 0; j < 4; ++j)
      EXPECT_GT(std::abs(farthest(row, j) - std::complex<long double>(discs.centre(row, j))),
                0.999L * static_cast<long double>(discs.radius(row, j)));
  }
}

TEST(DiscMatrix, TakesEntriesAsDiscs) {
  DiscMatrix matrix(2, 2);
  matrix.set(1, 0, ComplexEnclosure({1.0, -2.0}, 0.5));
  EXPECT_EQ(matrix.at(1, 0).middle(), std::complex<double>(1.0, -2.0));
  EXPECT_EQ(matrix.at(1, 0).radius(), 0.5);
  EXPECT_EQ(matrix.at(0, 1).magnitude(), ComplexEnclosure().magnitude());
}

}  // namespace
}  // namespace holdfast::test
