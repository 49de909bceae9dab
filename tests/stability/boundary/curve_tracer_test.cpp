#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/boundary/boundary.hpp"

#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "support/polynomial/rounding.hpp"
#include "support/random_loop.hpp"

namespace holdfast {
namespace {

using LongDouble = long double;

/// A random loop and a range of P in which sampling matters to it.
struct TracedLoop {
  TwoMass<double> plant;
  Sampling<double> sampling;
  Interval<double> range;

  explicit TracedLoop(test::Random& random)
      : plant(test::random_plant(random)), sampling(test::random_sampling(plant, random)) {
    const double middle = test::random_gains(plant, sampling.period, random).proportional;
    const double reach = std::abs(middle) * random.uniform(0.5, 3.0);
    range = {middle - reach, middle + reach};
  }

  /// D beyond which it moves the roots less than round-off in the coefficients may.
  double largest_differential() const { return 1e3 * plant.conductor_mass / sampling.period; }

  AffinePolynomial<double, 5> polynomial() const {
    return characteristic_polynomial(sampled_loop(plant, sampling));
  }

  SampledLoop<LongDouble> precise() const { return test::precise_loop(plant, sampling); }
};

/// The crossings of the whole boundary at P, in closed form (by elimination of D).
std::vector<double> closed_form_crossings(const AffinePolynomial<double, 5>& polynomial, double p) {
  const auto q = in_half_plane(polynomial);
  return boundary_crossings<double, 6>(q.base + p * q.proportional, q.differential);
}

int eigenvalues_outside(const SampledLoop<LongDouble>& loop, const PdGains<LongDouble>& gains) {
  const auto eigenvalues = detail::balanced_eigenvalues<LongDouble, 5>(loop.engaged_map(gains));
  return static_cast<int>((eigenvalues.array().abs() > 1).count());
}

/// D between two others at which the number of eigenvalues outside the unit circle changes.
LongDouble bisect_the_count(const SampledLoop<LongDouble>& loop, LongDouble p, LongDouble lower,
                            LongDouble upper) {
  const int at_lower = eigenvalues_outside(loop, {p, lower});
  for (int halving = 0; halving < 60; ++halving) {
    const LongDouble middle = (lower + upper) / 2;
    (eigenvalues_outside(loop, {p, middle}) == at_lower ? lower : upper) = middle;
  }
  return (lower + upper) / 2;
}

TEST(CurveTracer, PointsAreWhereBisectionOnEigenvaluesPutsTheBoundary) {
  test::Random random(801);
  int tested = 0;
  LongDouble worst = 0;
  while (tested < 300) {
    const TracedLoop loop(random);
    const auto precise = loop.precise();
    const auto points = stability_boundary(characteristic_polynomial(precise), loop.range);
    for (int draw = 0; draw < 4 && !points.empty(); ++draw) {
      const auto& point = points[random.index(points.size())];
      const LongDouble p = point.gains.proportional, d = point.gains.differential;
      if (std::abs(d) > loop.largest_differential()) continue;
      const LongDouble reach = 1e-5L * std::abs(d);
      // Where the curve is steep or near another, more than one root crosses within reach.
      const int step = std::abs(eigenvalues_outside(precise, {p, d + reach}) -
                                eigenvalues_outside(precise, {p, d - reach}));
      if (step != (point.curve == BoundaryCurve::complex_pair ? 2 : 1)) continue;
      ++tested;
      const LongDouble found = bisect_the_count(precise, p, d - reach, d + reach);
      worst = std::max(worst, std::abs(found - d) / std::abs(d));
    }
  }
  std::cout << "  " << tested << " points, furthest " << static_cast<double>(worst) << " of D\n";
  EXPECT_LE(worst, 1e-10L);
}

/// How far from a point of the curve a D at its P is, in what rounding makes of D.
double roundings_apart(const test::RoundingOfGains<5>& rounding, const BoundaryPoint<double>& point,
                       double d) {
  const auto difference = std::abs(LongDouble(point.gains.differential) - d);
  return static_cast<double>(difference / rounding.differential_at(point.angle, point.gains));
}

TEST(CurveTracer, TheCurveEntersAndLeavesTheRangeAtItsEnds) {
  test::Random random(805);
  int ends = 0;
  double furthest = 0.0;
  for (int draw = 0; draw < 200; ++draw) {
    const TracedLoop loop(random);
    const test::RoundingOfGains<5> rounding(loop.polynomial());
    const auto points = stability_boundary(loop.polynomial(), loop.range);
    for (const double p : {loop.range.lower, loop.range.upper}) {
      for (const double d : closed_form_crossings(loop.polynomial(), p)) {
        if (std::abs(d) > loop.largest_differential()) continue;
        double nearest = std::numeric_limits<double>::infinity();
        for (const auto& point : points)
          if (point.gains.proportional == p)
            nearest = std::min(nearest, roundings_apart(rounding, point, d));
        furthest = std::max(furthest, nearest);
        ++ends;
      }
    }
  }
  std::cout << "  " << ends << " ends, furthest " << furthest << " roundings\n";
  EXPECT_LE(furthest, 4.0) << "of two ways, some operations each";
  EXPECT_GT(furthest, 0.25) << "the bound is of the size of the errors";
  EXPECT_GT(ends, 600);
}

/// How often the points pass P with D within the bound; a jump from one end of the range to the
/// other, the curve being outside between them, does not count.
int passes(const TracedLoop& loop, const std::vector<BoundaryPoint<double>>& points, double p) {
  int result = 0;
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const auto &a = points[k], &b = points[k + 1];
    const bool pass = (a.gains.proportional > p) != (b.gains.proportional > p);
    const bool within = std::abs(a.gains.differential) <= loop.largest_differential();
    if (a.curve != b.curve || !pass || !within) continue;
    const auto between = test::complex_pair_gains(loop.polynomial(), (a.angle + b.angle) / 2);
    const bool inside = between && between->proportional > loop.range.lower &&
                        between->proportional < loop.range.upper;
    result += inside || a.curve == BoundaryCurve::minus_one ? 1 : 0;
  }
  return result;
}

TEST(CurveTracer, NoBranchIsMissed) {
  test::Random random(803);
  int crossings = 0;
  for (int draw = 0; draw < 400; ++draw) {
    const TracedLoop loop(random);
    const auto points = stability_boundary(loop.polynomial(), loop.range);
    for (int row = 0; row < 5; ++row) {
      const double p = random.uniform(loop.range.lower, loop.range.upper);
      int expected = 0;
      for (const double d : closed_form_crossings(loop.polynomial(), p)) {
        expected += std::abs(d) <= loop.largest_differential() ? 1 : 0;
      }
      EXPECT_EQ(passes(loop, points, p), expected) << draw << ' ' << p;
      crossings += expected;
    }
  }
  EXPECT_GT(crossings, 4000);
}

TEST(CurveTracer, TheCurveBetweenTwoPointsIsOnTheirChord) {
  test::Random random(804);
  double furthest = 0.0;
  for (int draw = 0; draw < 200; ++draw) {
    const TracedLoop loop(random);
    const double width = loop.range.upper - loop.range.lower;
    const auto points = stability_boundary(loop.polynomial(), loop.range);
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      const auto &a = points[k], &b = points[k + 1];
      const double size = std::abs(a.gains.differential) + std::abs(b.gains.differential);
      const auto between = test::complex_pair_gains(loop.polynomial(),
                                                    a.angle + random.unit() * (b.angle - a.angle));
      if (a.curve != b.curve || a.curve != BoundaryCurve::complex_pair || !between) continue;
      // The curve leaves the range here and comes back elsewhere.
      if (between->proportional < loop.range.lower || between->proportional > loop.range.upper) {
        continue;
      }
      const double x = (b.gains.proportional - a.gains.proportional) / width;
      const double y = (b.gains.differential - a.gains.differential) / size;
      const double off = std::abs(x * (between->differential - a.gains.differential) / size -
                                  y * (between->proportional - a.gains.proportional) / width) /
                         std::hypot(x, y);
      furthest = std::max(furthest, off);
    }
  }
  std::cout << "  furthest from the chord: " << furthest << '\n';
  EXPECT_LE(furthest, 0.00101);
  EXPECT_GT(furthest, 0.0005);
}

TEST(CurveTracer, APictureTakesFewPoints) {
  for (const double fraction : {0.0, 0.4, 1.0}) {
    for (const double period : {1e-5, 1e-3, 0.01, 0.1}) {
      const auto loop =
          sampled_loop(kollar2022_plant(), Sampling<double>{period, fraction * period});
      EXPECT_LE(stability_boundary(characteristic_polynomial(loop), {-1000.0, 200.0}).size(), 300U);
    }
  }
  EXPECT_LE(
      stability_boundary(characteristic_polynomial(kollar2022_plant()), {-1000.0, 200.0}).size(),
      150U);
}

TEST(CurveTracer, WithoutDampingTheContinuousPairsNeedNoDamping) {
  TwoMass<double> plant = kollar2022_plant();
  plant.conductor_damping = plant.absorber_damping = 0.0;
  const auto points = stability_boundary(characteristic_polynomial(plant), {-500.0, 200.0});
  ASSERT_GT(points.size(), 10U);
  for (const auto& point : points) EXPECT_EQ(point.gains.differential, 0.0);
  // P = (m₁m₂ω⁴ − (k₁m₂ + k₂(m₁ + m₂))ω² + k₁k₂) / (−m₂ω²) is largest where ω⁴ = k₁k₂/(m₁m₂).
  const double omega = std::pow(50.3 * 74.4 / (0.0767 * 0.16), 0.25);
  const auto same = [omega](const auto& point) { return std::abs(point.angle - omega) < 1e-6; };
  EXPECT_TRUE(std::any_of(points.begin(), points.end(), same));
}

TEST(CurveTracer, ExtremeLoopsGiveNumbersAndAscendingAngles) {
  for (const double damping : {0.0, 1.0}) {
    TwoMass<double> plant = kollar2022_plant();
    plant.conductor_damping *= damping;
    plant.absorber_damping *= damping;
    for (const double period : {1e-7, 1e-5, 0.1, 0.5, 5.0, 500.0}) {
      for (const double fraction : {0.0, 0.3, 1.0}) {
        const auto loop = sampled_loop(plant, Sampling<double>{period, fraction * period});
        double previous = 0.0;
        for (const auto& point :
             stability_boundary(characteristic_polynomial(loop), {-1000.0, 200.0})) {
          EXPECT_TRUE(std::isfinite(point.gains.differential));
          EXPECT_GE(point.gains.proportional, -1000.0);
          EXPECT_LE(point.gains.proportional, 200.0);
          if (point.curve != BoundaryCurve::complex_pair) continue;
          EXPECT_GT(point.angle, previous);
          EXPECT_LT(point.angle, pi<double>);
          previous = point.angle;
        }
      }
    }
  }
}

}  // namespace
}  // namespace holdfast
