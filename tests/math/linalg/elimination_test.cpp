#include "holdfast/math/linalg/elimination.hpp"

#include "support/random.hpp"
#include "support/testing.hpp"

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

}  // namespace
}  // namespace holdfast
