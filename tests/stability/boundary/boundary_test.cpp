#include "holdfast/stability/boundary/boundary.hpp"

#include "holdfast/math/linalg/spectral_radius.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

using Precise = long double;
using PreciseComplex = std::complex<Precise>;

const Interval<double> range{-1500.0, 300.0};

TwoMass<Precise> plant() { return {0.0767L, 50.3L, 0.079L, 0.16L, 74.4L, 4.0L}; }

/// Distance from `target` to the nearest eigenvalue, in extended precision.
template <int Size>
Precise distance(const Matrix<Precise, Size>& matrix, const PreciseComplex& target) {
  const Vector<PreciseComplex, Size> eigenvalues =
      detail::balanced_eigenvalues<Precise, Size>(matrix);
  return (eigenvalues.array() - target).abs().minCoeff();
}

TEST(Boundary, EveryPointOfTheSampledLoopHasItsRootOnTheUnitCircle) {
  int pairs = 0, lines = 0;
  for (const Precise period : {0.001L, 0.01L, 0.03L, 0.1L}) {
    for (const Precise fraction : {0.0L, 0.4L, 1.0L}) {
      const auto loop = sampled_loop(plant(), Sampling<Precise>{period, fraction * period});
      const auto points = stability_boundary(characteristic_polynomial(loop), range);
      for (const auto& point : points) {
        ASSERT_TRUE(std::isfinite(point.gains.differential));
        const PreciseComplex root = std::polar(Precise(1), point.angle);
        EXPECT_LE(distance<5>(loop.engaged_map(point.gains), root), 1e-9L)
            << static_cast<double>(period) << ' ' << static_cast<double>(point.angle);
        (point.curve == BoundaryCurve::complex_pair ? pairs : lines) += 1;
      }
    }
  }
  EXPECT_GT(pairs, 100);
  EXPECT_EQ(lines, 2 * 12) << "the two ends of the line λ = −1 for each loop; no line λ = +1";
}

TEST(Boundary, EveryPointOfTheContinuousLoopHasItsRootOnTheImaginaryAxis) {
  const auto points = stability_boundary(characteristic_polynomial(plant()), range);
  int seen = 0;
  for (const auto& point : points) {
    ASSERT_EQ(point.curve, BoundaryCurve::imaginary_pair);
    const Matrix<Precise, 4> closed =
        plant().state_matrix() + plant().control_input() * point.gains.feedback_row();
    EXPECT_LE(distance<4>(closed, {0, point.angle}), 1e-9L * std::max(Precise(1), point.angle));
    ++seen;
  }
  EXPECT_GT(seen, 50);
}

TEST(Boundary, ALineThatTheDifferentialGainDoesNotMoveIsVertical) {
  // (s² + 3s + 5)(s² + s + 10) with a control that pushes against the ground: P adds to the
  // constant term and D to the one of s, so that s = 0 at P = −50 whatever D is.
  AffinePolynomial<double, 4> grounded{{50, 35, 18, 4, 1}, {1, 0, 0, 0, 0}, {0, 1, 0, 0, 0}};
  std::vector<double> ends;
  for (const auto& point : stability_boundary(grounded, range)) {
    if (point.curve != BoundaryCurve::zero) continue;
    EXPECT_EQ(point.angle, 0.0);
    EXPECT_NEAR(point.gains.proportional, -50.0, 1e-12);
    EXPECT_EQ(grounded.at({point.gains.proportional, 7.0})[0], 0.0);
    ends.push_back(point.gains.differential);
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(ends, (std::vector<double>{-infinity, infinity}));
  for (const auto& point : stability_boundary(grounded, {0.0, 300.0}))
    EXPECT_EQ(point.curve, BoundaryCurve::imaginary_pair);
}

TEST(Boundary, ANarrowRangeIsNotSteppedOver) {
  const auto continuous = characteristic_polynomial(kollar2022_plant());
  const auto sampled =
      characteristic_polynomial(sampled_loop(kollar2022_plant(), Sampling<double>{0.01}));
  for (double p = -1400.5; p < 0; p += 100.0) {
    EXPECT_FALSE(stability_boundary(continuous, {p, p + 0.01}).empty()) << p;
    int pairs = 0;
    for (const auto& point : stability_boundary(sampled, {p, p + 0.01})) {
      pairs += point.curve == BoundaryCurve::complex_pair ? 1 : 0;
    }
    EXPECT_GT(pairs, 0) << p;
  }
}

TEST(Boundary, ThePointsFollowTheCurveClosely) {
  const auto loop = sampled_loop(plant(), Sampling<Precise>{0.01L});
  const auto points = stability_boundary(characteristic_polynomial(loop), range);
  Precise previous = std::numeric_limits<Precise>::quiet_NaN(), widest = 0;
  int steps = 0;
  for (const auto& point : points) {
    if (point.curve != BoundaryCurve::complex_pair) continue;
    // A jump beyond a tenth is the curve leaving the range and coming back.
    const Precise step =
        std::abs(point.gains.proportional - previous) / Precise(range.upper - range.lower);
    if (step < 0.1L) {
      widest = std::max(widest, step);
      ++steps;
    }
    previous = point.gains.proportional;
  }
  EXPECT_GT(steps, 50);
  EXPECT_LE(widest, 0.02L);
}
TEST(Boundary, ABadRangeIsRefused) {
  const auto polynomial = characteristic_polynomial(kollar2022_plant());
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  for (const Interval<double>& bad : {Interval<double>{1, 1},
                                      {2, 1},
                                      {-infinity, 0},
                                      {0, infinity},
                                      {not_a_number, 1},
                                      {0, not_a_number}}) {
    EXPECT_THROW(stability_boundary(polynomial, bad), InvalidParameter);
  }
}

}  // namespace
}  // namespace holdfast
