#include "holdfast/math/enclosure/positive_definite.hpp"

#include <Eigen/Eigenvalues>

#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

Matrix<double, 4> symmetric(const Vector<double, 4>& eigenvalues, test::Random& random) {
  Matrix<double, 4> any;
  for (double& entry : any.reshaped()) entry = random.normal();
  const Matrix<double, 4> basis = Eigen::HouseholderQR<Matrix<double, 4>>(any).householderQ();
  return basis * eigenvalues.asDiagonal() * basis.transpose();
}

/// Eigenvalues tell the same, where they are not within rounding of zero.
TEST(PositiveDefinite, AgreesWithEigenvalues) {
  test::Random random(11);
  for (int trial = 0; trial < 500; ++trial) {
    Vector<double, 4> eigenvalues;
    for (double& value : eigenvalues) value = random.log_uniform(1e-6, 1e3);
    if (trial % 2 == 0) eigenvalues[static_cast<Eigen::Index>(random.index(4))] *= -1.0;
    const Matrix<double, 4> form = symmetric(eigenvalues, random);
    EXPECT_EQ(is_positive_definite<4>(form.cast<Enclosure>()), eigenvalues.minCoeff() > 0.0);
  }
}

TEST(PositiveDefinite, IsOfEveryMatrixInside) {
  test::Random random(12);
  for (int trial = 0; trial < 200; ++trial) {
    const Matrix<double, 4> form = symmetric(Vector<double, 4>(1.0, 2.0, 5.0, 0.1), random);
    const auto widened = [&](double by) {
      const Matrix<Enclosure, 4> all = Matrix<Enclosure, 4>::Constant(Enclosure(-by, by));
      return Matrix<Enclosure, 4>(form.cast<Enclosure>() + all);
    };
    EXPECT_TRUE(is_positive_definite<4>(widened(1e-4)));
    // −0.1 in the direction of the smallest eigenvalue is among these.
    EXPECT_FALSE(is_positive_definite<4>(widened(0.1)));
  }
}

TEST(PositiveDefinite, IsNotClaimedOfASingularMatrix) {
  Matrix<Enclosure, 2> ones = Matrix<Enclosure, 2>::Constant(Enclosure(1.0));
  EXPECT_FALSE(is_positive_definite<2>(ones));
  ones(0, 0) = Enclosure(1.0 + 1e-12);
  EXPECT_TRUE(is_positive_definite<2>(ones));
  EXPECT_FALSE(is_positive_definite<2>(Matrix<Enclosure, 2>::Constant(Enclosure::unknown())));
}

}  // namespace
}  // namespace holdfast
