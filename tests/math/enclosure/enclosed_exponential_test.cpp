#include "holdfast/math/enclosure/enclosed_exponential.hpp"

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

}  // namespace
}  // namespace holdfast
