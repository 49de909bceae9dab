#include "holdfast/math/linalg/resolvent.hpp"

#include "holdfast/math/linalg/balancing.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

using Precise = long double;

/// Largest entry of any coefficient of (xI − M) · adjugate(x) − determinant(x) I, in units of what
/// the recurrence's products can reach on the way to that coefficient.
template <int Size>
double identity_residual(const Matrix<double, Size>& m, const Resolvent<double, Size>& r) {
  double worst = 0.0;
  for (std::size_t k = 0; k <= Size; ++k) {
    Matrix<double, Size> rest = Matrix<double, Size>::Zero();
    if (k > 0) rest += r.adjugate[k - 1];
    if (k < Size) rest -= m * r.adjugate[k];
    rest.diagonal().array() -= r.determinant[static_cast<int>(k)];
    const double scale = std::pow(m.norm(), static_cast<double>(Size) - static_cast<double>(k));
    worst = std::max(worst, rest.cwiseAbs().maxCoeff() / scale);
  }
  return worst;
}

TEST(Resolvent, TimesTheMatrixIsTheDeterminant) {
  test::Random random(31);
  for (int draw = 0; draw < 2000; ++draw) {
    const Matrix<double, 4> m = random.matrix<Matrix<double, 4>>();
    EXPECT_LE((identity_residual<4>(m, resolvent<double, 4>(m))), 1e-15);
    const Matrix<double, 5> large = random.matrix<Matrix<double, 5>>();
    EXPECT_LE((identity_residual<5>(large, resolvent<double, 5>(large))), 1e-15);
  }
}

TEST(Resolvent, UnitsDoNotCostDigits) {
  // diag(t)⁻¹ M diag(t) is M in other units; its determinant is the same polynomial, and its
  // adjugate the same in those units.
  test::Random random(32);
  for (int draw = 0; draw < 2000; ++draw) {
    const auto m = random.matrix<Matrix<double, 4>>();
    Vector<double, 4> units;
    for (double& unit : units) unit = std::exp2(std::floor(random.uniform(-30, 30)));
    const Matrix<double, 4> scaled = units.cwiseInverse().asDiagonal() * m * units.asDiagonal();
    const auto plain = resolvent<double, 4>(m);
    const auto other = resolvent<double, 4>(scaled);
    for (int k = 0; k <= 4; ++k) {
      EXPECT_NEAR(other.determinant[k], plain.determinant[k], 1e-14 * 24);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const Matrix<double, 4> back =
          units.asDiagonal() * other.adjugate[k] * units.cwiseInverse().asDiagonal();
      EXPECT_LE((back - plain.adjugate[k]).cwiseAbs().maxCoeff(), 1e-14 * 24);
    }
  }
}

TEST(Resolvent, AgreesWithLongDoubleOnBadlyScaledMatrices) {
  test::Random random(33);
  for (int draw = 0; draw < 2000; ++draw) {
    Matrix<double, 4> m = random.matrix<Matrix<double, 4>>();
    for (double& entry : m.reshaped()) entry *= random.log_uniform(1e-5, 1e5);
    const auto computed = resolvent<double, 4>(m);
    const auto reference = resolvent<Precise, 4>(Matrix<Precise, 4>(m.cast<Precise>()));
    // The recurrence multiplies the matrix 4 − k times to reach coefficient k. It commutes with
    // scaling by powers of two, so the norm that counts is that of the balanced matrix.
    const double norm = BalancedMatrix<double, 4>(m).balanced.norm();
    for (int k = 0; k <= 4; ++k) {
      EXPECT_NEAR(computed.determinant[k], static_cast<double>(reference.determinant[k]),
                  1e-14 * std::pow(norm, 4 - k));
    }
  }
}

TEST(Resolvent, BetweenARowAndAColumnSolvesTheLinearSystem) {
  test::Random random(35);
  for (int draw = 0; draw < 1000; ++draw) {
    const auto m = random.matrix<Matrix<double, 4>>();
    const auto row = random.matrix<RowVector<double, 4>>();
    const auto column = random.matrix<Vector<double, 4>>();
    const double x =
        random.uniform(5.0, 6.0);  // beyond every eigenvalue, where (xI − M) is well conditioned
    const auto r = resolvent<double, 4>(m);
    const double quotient = evaluate(r.between(row, column), x) / evaluate(r.determinant, x);
    const double solved = row * (x * Matrix<double, 4>::Identity() - m).inverse() * column;
    EXPECT_NEAR(quotient, solved, 1e-12);
  }
}

TEST(Resolvent, TheZeroMatrixHasOnlyTheLeadingTerms) {
  const auto r = resolvent<double, 4>(Matrix<double, 4>(Matrix<double, 4>::Zero()));
  EXPECT_EQ(r.determinant, (Polynomial<double, 4>::Unit(4)));
  EXPECT_EQ(r.adjugate[3], (Matrix<double, 4>::Identity()));
  EXPECT_TRUE(r.adjugate[0].isZero(0.0));
}

}  // namespace
}  // namespace holdfast
