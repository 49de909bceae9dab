#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/stability/boundary/boundary.hpp"
#include "support/random_loop.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

using BisectionScalar = long double;

/// One eigenvalue of the loop as D varies at a fixed P, that next to a point of the unit circle, in
/// extended precision and without the characteristic polynomial.
class FollowedEigenvalue {
 public:
  FollowedEigenvalue(const SampledLoop<BisectionScalar>& loop, const BoundaryPoint<double>& point)
      : loop_(loop),
        proportional_(point.gains.proportional),
        root_(std::polar(BisectionScalar(1), BisectionScalar(point.angle))) {}

  /// |λ| − 1.
  BisectionScalar excess(const BisectionScalar& differential_gain) const {
    const auto eigenvalues = detail::balanced_eigenvalues<BisectionScalar, 5>(
        loop_.engaged_map({proportional_, differential_gain}));
    Eigen::Index nearest = 0;
    (eigenvalues.array() - root_).abs().minCoeff(&nearest);
    return std::abs(eigenvalues[nearest]) - 1;
  }

  /// D at which |λ| = 1, by halving `start` ± `reach`; nothing if |λ| − 1 has one sign at both
  /// ends.
  std::optional<BisectionScalar> crossing(const BisectionScalar& start,
                                          const BisectionScalar& reach) const {
    BisectionScalar lower = start - reach, upper = start + reach;
    const bool outside_below = excess(lower) > 0;
    if (outside_below == (excess(upper) > 0)) return std::nullopt;
    for (int step = 0; step < 30; ++step) {
      const BisectionScalar middle = (lower + upper) / 2;
      ((excess(middle) > 0) == outside_below ? lower : upper) = middle;
    }
    return (lower + upper) / 2;
  }

 private:
  const SampledLoop<BisectionScalar>& loop_;
  BisectionScalar proportional_;
  std::complex<BisectionScalar> root_;
};

struct BisectionTally {
  int compared = 0, ill_conditioned = 0;
  double worst = 0.0;

  /// Well conditioned: |∂|λ|/∂D| max(1, |D|) is at least 10⁻³ and alike above and below the point,
  /// no tangent being near. Only the others are passed over.
  void compare(const SampledLoop<BisectionScalar>& loop, const BoundaryPoint<double>& point) {
    const FollowedEigenvalue eigenvalue(loop, point);
    const BisectionScalar d = point.gains.differential,
                          size = std::max(BisectionScalar(1), std::abs(d));
    const BisectionScalar step(1e-3);
    const BisectionScalar above = eigenvalue.excess(d + step * size) / step;
    const BisectionScalar below = -eigenvalue.excess(d - step * size) / step;
    const bool alike = std::abs(above - below) < std::abs(above + below) / 10;
    if (!alike || std::abs(above + below) / 2 < BisectionScalar(1e-3)) {
      ++ill_conditioned;
      return;
    }
    const auto crossing = eigenvalue.crossing(d, BisectionScalar(1e-6) * size);
    ASSERT_TRUE(crossing.has_value()) << point.angle << ' ' << point.gains.proportional;
    worst = std::max(worst, static_cast<double>(std::abs(*crossing - d) / size));
    ++compared;
  }
};

TEST(BoundaryBisection, PointsAreWhereAnEigenvalueIsFoundToCrossTheUnitCircle) {
  test::Random random(841);
  BisectionTally pairs, lines;
  for (int draw = 0; draw < 12; ++draw) {
    const auto plant = draw == 0 ? kollar2022_plant() : test::random_plant(random);
    for (const double period : {0.001, 0.01}) {
      for (const double fraction : {0.0, 0.5, 1.0}) {
        const Sampling<double> sampling{period, fraction * period};
        const auto polynomial = characteristic_polynomial(sampled_loop(plant, sampling));
        const auto loop =
            sampled_loop(converted<BisectionScalar>(plant),
                         Sampling<BisectionScalar>{sampling.period, sampling.processing_delay});
        const double p = 20 * (plant.conductor_stiffness + plant.absorber_stiffness);
        const auto points = stability_boundary(polynomial, {-p, p / 5});
        for (std::size_t k = 0; k < points.size(); ++k) {
          const bool is_line = points[k].curve == BoundaryCurve::minus_one;
          if (is_line || k % 5 == 0) (is_line ? lines : pairs).compare(loop, points[k]);
        }
      }
    }
  }
  for (const BisectionTally* tally : {&pairs, &lines}) {
    std::cout << "  " << tally->compared << " points, furthest " << tally->worst << ", "
              << tally->ill_conditioned << " ill conditioned\n";
    EXPECT_LE(tally->worst, 1e-10);
    EXPECT_LT(tally->ill_conditioned, tally->compared / 2);
  }
  EXPECT_GT(pairs.compared, 1000);
  EXPECT_GT(lines.compared, 50);
}

}  // namespace
}  // namespace holdfast
