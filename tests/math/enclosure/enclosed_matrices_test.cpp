#include <Eigen/Eigenvalues>

#include "holdfast/math/enclosure/enclosed_exponential.hpp"
#include "holdfast/math/enclosure/enclosed_norm.hpp"
#include "holdfast/math/enclosure/positive_definite.hpp"

#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(EnclosedExponential, OfARotationHoldsSineAndCosine) {
  for (const double angle : {0.0, 0.3, 1.0, 7.0, 40.0}) {
    Matrix<Enclosure, 2> generator;
    generator << 0.0, -angle, angle, 0.0;
    const Matrix<Enclosure, 2> turn = exponential(generator);
    EXPECT_TRUE(turn(0, 0).contains(std::cos(angle))) << angle;
    EXPECT_TRUE(turn(1, 0).contains(std::sin(angle))) << angle;
    EXPECT_LT(turn(0, 0).radius(), 1e-10) << angle;
  }
}

TEST(EnclosedExponential, OfAnyOrderAndOfWhatIsNotFinite) {
  Matrix<Enclosure, Eigen::Dynamic> nilpotent = Matrix<Enclosure, Eigen::Dynamic>::Zero(3, 3);
  nilpotent(0, 1) = nilpotent(1, 2) = 1.0;
  const Matrix<Enclosure, Eigen::Dynamic> power = exponential(nilpotent);
  EXPECT_TRUE(power(0, 2).contains(0.5));
  EXPECT_TRUE(power(0, 0).contains(1.0));
  EXPECT_TRUE(power(2, 0).contains(0.0));
  nilpotent(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(exponential(nilpotent)(1, 1) == Enclosure::unknown());
}

TEST(SpectralNormBound, IsThatOfAKnownMatrix) {
  // Two rotations and what they stretch by.
  for (const double largest : {1e-9, 0.5, 3.0, 1e7}) {
    const double angle = 0.3, other = 1.1;
    Matrix<double, 2> turn, turn_back;
    turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    turn_back << std::cos(other), -std::sin(other), std::sin(other), std::cos(other);
    for (const double ratio : {0.0, 0.1, 0.999999, 1.0}) {
      const Matrix<double, 2> matrix =
          turn * Vector<double, 2>(largest, ratio * largest).asDiagonal() * turn_back;
      const double bound = spectral_norm_bound<2>(matrix.cast<Enclosure>().eval());
      EXPECT_GE(bound, largest * (1.0 - 1e-15)) << ratio;
      EXPECT_LE(bound, largest * (1.0 + 1e-9)) << ratio;
    }
  }
}

/// No matrix inside stretches any vector by more.
TEST(SpectralNormBound, HoldsOfAllMatricesInside) {
  test::Random random(71);
  for (int trial = 0; trial < 300; ++trial) {
    const Matrix<double, 6> middle = random.matrix<Matrix<double, 6>>();
    Matrix<double, 6> inside = middle;
    const double width = random.log_uniform(1e-12, 1.0);
    Matrix<Enclosure, 6> enclosed;
    for (Eigen::Index i = 0; i < 36; ++i) {
      const double reach = width * random.unit();
      enclosed(i) = Enclosure(middle(i) - reach, middle(i) + reach);
      inside(i) += random.sign() * reach * (1.0 - 1e-12);
    }
    const double bound = spectral_norm_bound<6>(enclosed);
    Vector<double, 6> vector = Vector<double, 6>::Ones();
    for (int turn = 0; turn < 200; ++turn)
      vector = (inside.transpose() * (inside * vector)).normalized();
    EXPECT_GE(bound, (inside * vector).norm() * (1.0 - 1e-12));
    EXPECT_LE(bound, (middle.norm() + 6.0 * width) * (1.0 + 1e-9));
  }
}

TEST(SpectralNormBound, OfNothingAndOfWhatIsNotKnown) {
  Matrix<Enclosure, 3> matrix = Matrix<Enclosure, 3>::Zero();
  EXPECT_LE(spectral_norm_bound<3>(matrix), 1e-134);
  matrix(1, 2) = Enclosure(-0.5, 0.5);
  EXPECT_GE(spectral_norm_bound<3>(matrix), 0.5);
  matrix(1, 2) = Enclosure::unknown();
  EXPECT_EQ(spectral_norm_bound<3>(matrix), HUGE_VAL);
}

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
