#include "holdfast/motion/saltation.hpp"

#include "support/dense_routes.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

/// A field without a jump, a reset without a rate: all that a crossing may have is random.
template <int Size>
SurfaceCrossing<Size> random_crossing(test::Random& random) {
  SurfaceCrossing<Size> crossing;
  crossing.before = random.matrix<Vector<double, Size>>();
  crossing.after = random.matrix<Vector<double, Size>>();
  crossing.gradient = random.matrix<RowVector<double, Size>>();
  crossing.gradient_rate = random.uniform(-1.0, 1.0);
  crossing.reset = random.matrix<Matrix<double, Size>>();
  crossing.reset_rate = random.matrix<Vector<double, Size>>();
  return crossing;
}

template <int Size>
bool is_transversal(const SurfaceCrossing<Size>& crossing) {
  return std::abs(crossing.gradient.dot(crossing.before) + crossing.gradient_rate) > 0.05;
}

TEST(Saltation, AFieldThatSlidesLosesTheDirectionAcrossTheSurface) {
  test::Random random(814);
  for (int trial = 0; trial < 200; ++trial) {
    SurfaceCrossing<4> crossing;
    crossing.before = random.matrix<Vector<double, 4>>();
    crossing.gradient = random.matrix<RowVector<double, 4>>();
    if (!is_transversal(crossing)) continue;
    const Vector<double, 4> other = random.matrix<Vector<double, 4>>();
    const double across = crossing.gradient.dot(other) / crossing.gradient.squaredNorm();
    crossing.after = other - crossing.gradient.transpose() * across;
    const Matrix<double, 4> saltation = saltation_matrix(crossing);
    EXPECT_LT((crossing.gradient * saltation).norm(), 1e-12 * saltation.norm());
    const Eigen::VectorXd stretches = test::singular_values_of(saltation);
    EXPECT_GT(stretches[2], 1e-9 * stretches[0]);
    EXPECT_LT(stretches[3], 1e-12 * stretches[0]);
  }
}

/// A motion by constant fields on both sides of a surface that moves, with a reset: where it is
/// after a given time is a function of where it began that is written down in one line.
TEST(Saltation, IsTheDerivativeOfAFlowByConstantFields) {
  test::Random random(815);
  int tried = 0;
  while (tried < 100) {
    const auto crossing = random_crossing<3>(random);
    if (!is_transversal(crossing)) continue;
    const double speed = crossing.gradient.dot(crossing.before) + crossing.gradient_rate;
    // The surface is h = ∂h/∂x x + ∂h/∂t t, met at the time `met` from x.
    const auto flow = [&](const Vector<double, 3>& begin) -> Vector<double, 3> {
      const double met = -crossing.gradient.dot(begin) / speed;
      const Vector<double, 3> there = begin + crossing.before * met;
      return crossing.reset * there + crossing.reset_rate * met - crossing.after * met;
    };
    const Matrix<double, 3> saltation = saltation_matrix(crossing);
    for (int column = 0; column < 3; ++column) {
      const Vector<double, 3> unit = Vector<double, 3>::Unit(column);
      const Vector<double, 3> difference = 0.5 * (flow(unit) - flow(-unit));
      EXPECT_LT((difference - saltation.col(column)).norm(), 1e-12 * (1.0 + saltation.norm()));
    }
    ++tried;
  }
}

}  // namespace
}  // namespace holdfast
