#include "holdfast/math/linalg/balancing.hpp"

#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(Balancing, FactorsArePowersOfTwoAndEvenOutRowsAndColumns) {
  test::Random random(36);
  for (int draw = 0; draw < 500; ++draw) {
    auto m = random.matrix<Matrix<double, 4>>();
    for (double& entry : m.reshaped()) entry += entry < 0 ? -0.5 : 0.5;
    Vector<double, 4> units;
    for (double& unit : units) unit = random.log_uniform(1e-6, 1e6);
    const Matrix<double, 4> scaled = units.cwiseInverse().asDiagonal() * m * units.asDiagonal();
    const BalancedMatrix<double, 4> similar(scaled);
    EXPECT_EQ(similar.restored(similar.balanced), scaled);
    const auto& factors = similar.factors;
    Matrix<double, 4> balanced = similar.balanced;
    balanced.diagonal().setZero();
    for (int i = 0; i < 4; ++i) {
      EXPECT_EQ(std::exp2(std::round(std::log2(factors[i]))), factors[i]);
      const double ratio = balanced.row(i).cwiseAbs().sum() / balanced.col(i).cwiseAbs().sum();
      EXPECT_GT(ratio, 0.2);
      EXPECT_LT(ratio, 5.0);
    }
  }
}

TEST(Balancing, AStateThatNothingDependsOnIsScaledToo) {
  Matrix<double, 2> m;
  m << 0.5, 0.0, 1024.0, 0.25;
  const BalancedMatrix<double, 2> similar(m);
  EXPECT_LE(similar.balanced.cwiseAbs().maxCoeff(), 1.0);
}

}  // namespace
}  // namespace holdfast
