#include "holdfast/math/enclosure/enclosed_norm.hpp"

#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

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
  EXPECT_LE(spectral_norm_bound<3>(matrix), 1e-150);
  matrix(1, 2) = Enclosure(-0.5, 0.5);
  EXPECT_GE(spectral_norm_bound<3>(matrix), 0.5);
  matrix(1, 2) = Enclosure::unknown();
  EXPECT_EQ(spectral_norm_bound<3>(matrix), HUGE_VAL);
}

}  // namespace
}  // namespace holdfast
