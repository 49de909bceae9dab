// The curve of root pairs is cut into arcs on which P is monotone: at poles, and at extremes
// however far apart their scales are.

#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/boundary/boundary_curves.hpp"
#include "holdfast/stability/boundary/root_pair_curve.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"

#include "support/polynomial/pair_gains.hpp"
#include "support/random_loop.hpp"

namespace holdfast {
namespace {

/// Y from just above the start of an arc to just below its end, in geometric steps.
std::vector<double> along(const MonotoneArc<double>& arc, int count) {
  const double start = std::max(arc.start.square, 1e-8) * (1 + 1e-6);
  const double end = std::min(arc.end.square, 1e8) * (1 - 1e-6);
  std::vector<double> squares;
  for (int k = 0; k <= count && start < end; ++k) {
    squares.push_back(start * std::pow(end / start, static_cast<double>(k) / count));
  }
  return squares;
}

/// Curves of random loops.
std::vector<BoundaryCurves<double, 5>> random_curves(std::uint64_t seed, int count) {
  test::Random random(seed);
  std::vector<BoundaryCurves<double, 5>> all;
  while (count-- > 0) {
    const auto plant = test::random_plant(random);
    const auto sampling = test::random_sampling(plant, random);
    all.emplace_back(characteristic_polynomial(sampled_loop(plant, sampling)));
  }
  return all;
}

TEST(RootPairCuts, PIsMonotoneBetweenThem) {
  int arcs = 0;
  for (const auto& curves : random_curves(841, 300)) {
    for (const auto& arc : curves.pairs().arcs()) {
      const std::vector<double> squares = along(arc, 60);
      const auto p_at = [&](double square) { return curves.pairs().gains(square).proportional; };
      const bool rising = !squares.empty() && p_at(squares.front()) < p_at(squares.back());
      double before = std::numeric_limits<double>::quiet_NaN(), fall = 0.0;
      for (const double square : squares) {
        const double p = p_at(square);
        if (before == before)
          fall = std::max(fall, (rising ? before - p : p - before) / std::abs(p));
        before = p;
      }
      EXPECT_LE(fall, 1e-9) << arc.start.square << ' ' << arc.end.square;
      ++arcs;
    }
  }
  EXPECT_GT(arcs, 700);
}

TEST(RootPairCuts, AnOverdampedAbsorberDoesNotHideAnExtreme) {
  // Roots from 7 to 2400 rad/s: the coefficients of dP/dY span sixteen decades.
  const TwoMass<double> plant{0.0137, 0.76, 0.07, 3.04, 429.0, 32.8};
  const RootPairCurve curve(characteristic_polynomial(plant));
  int turns = 0;
  double before = curve.gains(1e-8).proportional;
  bool rising = true;
  for (double square = 1.001e-8; square < 1e8; square *= 1.001) {
    const double p = curve.gains(square).proportional;
    turns += (p > before) != rising ? 1 : 0;
    rising = p > before;
    before = p;
  }
  const auto extremes = curve.proportional_extremes();
  EXPECT_EQ(turns, 1);
  EXPECT_EQ(std::count_if(extremes.begin(), extremes.end(),
                          [](double square) { return square > 1e-8 && square < 1e8; }),
            turns);
}

TEST(RootPairCuts, WithoutDampingThePoleOfDAloneIsNoPoleOfP) {
  TwoMass<double> plant = kollar2022_plant();
  plant.conductor_damping = plant.absorber_damping = 0.0;
  for (const double delay : {0.0, 0.1}) {
    const auto polynomial =
        characteristic_polynomial(sampled_loop(plant, Sampling<double>{0.1, delay}));
    const BoundaryCurves<double, 5> curves(polynomial);
    const auto poles = curves.pairs().poles();
    ASSERT_EQ(poles.size(), 1U);
    const double pole = poles[0];
    const auto before = curves.pairs().gains(pole * (1 - 1e-6));
    const auto after = curves.pairs().gains(pole * (1 + 1e-6));
    EXPECT_NEAR(before.proportional, after.proportional, 1e-3);
    EXPECT_LT(before.differential * after.differential, -1e6);
    for (const auto& arc : curves.pairs().arcs()) {
      for (const auto& end : {arc.start, arc.end}) {
        if (end.square != pole) continue;
        EXPECT_NEAR(end.numerator / end.denominator, before.proportional, 1e-3);
      }
      // P is taken on the arc exactly when it lies between the values at its ends.
      for (const double square : along(arc, 20)) {
        EXPECT_TRUE(arc.passes(curves.pairs().gains(square).proportional)) << square;
      }
    }
    for (const double square : curves.pairs().proportional_extremes()) {
      EXPECT_GT(std::abs(square - pole), 1e-3 * pole);
    }
  }
}

TEST(RootPairCurve, AnArcIsTheInverseOfP) {
  int seen = 0;
  for (const auto& curves : random_curves(842, 300)) {
    for (const auto& arc : curves.pairs().arcs()) {
      for (const double square : along(arc, 8)) {
        const auto gains = curves.pairs().gains(square);
        const double found = curves.pairs().square(arc, gains.proportional);
        // Close to an extreme P determines Y to half its digits only, and Y P close to a pole.
        const double p = curves.pairs().gains(found).proportional;
        EXPECT_NEAR(p / gains.proportional, 1.0, 1e-9);
        ++seen;
      }
    }
  }
  EXPECT_GT(seen, 5000);
}

TEST(RootPairCurve, StopsAtTheEndOfAnArcThatDoesNotReachP) {
  const RootPairCurve curve(characteristic_polynomial(kollar2022_plant()));
  const auto arcs = curve.arcs();
  ASSERT_EQ(arcs.size(), 2U);
  const auto extreme = curve.gains(arcs[0].end.square);
  for (const auto& arc : arcs) {
    EXPECT_NEAR(curve.square(arc, extreme.proportional + 10) / arcs[0].end.square, 1.0, 1e-9);
    const double square = curve.square(arc, extreme.proportional);
    EXPECT_NEAR(curve.crossing(extreme.proportional, square).differential, extreme.differential,
                1e-6);
  }
}

TEST(PositiveRoots, AreThePositiveRealOnesInOrder) {
  Polynomial<double, 4> p;  // (x − 3)(x − 0.5)(x + 2)(x + 7)
  p << 21, -35.5, -16, 5.5, 1;
  const auto found = positive_roots(p);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0], 0.5, 1e-13);
  EXPECT_NEAR(found[1], 3.0, 1e-13);
  EXPECT_TRUE(positive_roots(Polynomial<double, 2>(1, 0, 1)).empty());
  EXPECT_TRUE(positive_roots(Polynomial<double, 2>(0, 0, 0)).empty());
  EXPECT_EQ(positive_roots(Polynomial<double, 2>(1, -2, 1)).size(), 2U) << "a double root";
}

TEST(PositiveRoots, DivisionByAFactorLeavesTheOthers) {
  Polynomial<double, 2> p(6, -5, 1);  // (x − 2)(x − 3)
  const Polynomial<double, 2> rest = without_root<double, 3>(p, 2.0);
  EXPECT_EQ(rest, (Polynomial<double, 2>(-3, 1, 0)));
}

TEST(BoundaryCurves, OfTheTwoMassPlantHaveTheLineOfMinusOneAlone) {
  test::Random random(843);
  for (int draw = 0; draw < 500; ++draw) {
    const auto plant = test::random_plant(random);
    const auto sampling = test::random_sampling(plant, random);
    const BoundaryCurves<double, 5> sampled(
        characteristic_polynomial(sampled_loop(plant, sampling)));
    ASSERT_EQ(sampled.lines().size(), 1U) << draw;
    EXPECT_EQ(sampled.lines()[0].curve, BoundaryCurve::minus_one);
    EXPECT_TRUE((BoundaryCurves<double, 4>(characteristic_polynomial(plant)).lines().empty()));
  }
}

TEST(BoundaryCurves, ALineThatOnlyPMovesIsVertical) {
  AffinePolynomial<double, 5> polynomial;
  polynomial.base << 2, 1, 1, 1, 1, 1;
  polynomial.proportional << 4, 1, 0, 0, 0, 0;
  polynomial.differential << 1e-12, 1, 2, 0, 0, 0;
  const BoundaryCurves<double, 5> curves(polynomial);
  ASSERT_EQ(curves.lines().size(), 2U);
  EXPECT_EQ(curves.lines()[0].curve, BoundaryCurve::plus_one);
  EXPECT_TRUE(curves.lines()[0].is_vertical());
  EXPECT_EQ(curves.lines()[0].proportional_at(7.0), -0.5);
  EXPECT_EQ(curves.lines()[1].curve, BoundaryCurve::minus_one);
}

TEST(RootPairCurve, PutsThePairOnTheUnitCircle) {
  const auto polynomial =
      characteristic_polynomial(sampled_loop(kollar2022_plant(), Sampling<double>{0.01, 0.004}));
  const RootPairCurve<double> curve(in_half_plane(polynomial));
  for (const double angle : {0.1, 0.5, 1.0, 2.0, 3.0}) {
    const double y = std::tan(angle / 2.0) / curve.unit();
    const auto gains = curve.gains(y * y);
    const auto expected = test::complex_pair_gains(polynomial, angle);
    ASSERT_TRUE(expected);
    EXPECT_NEAR(gains.proportional, expected->proportional, 1e-9 * std::abs(gains.proportional));
    EXPECT_NEAR(gains.differential, expected->differential, 1e-9 * std::abs(gains.differential));
    EXPECT_NEAR(2.0 * std::atan(curve.root(y * y)), angle, 1e-14);
  }
}

}  // namespace
}  // namespace holdfast
