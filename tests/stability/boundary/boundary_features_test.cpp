#include "holdfast/stability/boundary/boundary_features.hpp"
#include "holdfast/plant/two_mass.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <iostream>
#include <limits>
#include <vector>

#include "holdfast/stability/boundary/boundary.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "support/polynomial/made_polynomial.hpp"
#include "support/polynomial/pair_gains.hpp"
#include "support/random_loop.hpp"

namespace holdfast {
namespace {

using Kind = BoundaryFeatureKind;

const GainWindow whole_plane{{-1e9, 1e9}, {-1e7, 1e7}};

/// |p(x)| over the sum of the moduli of its terms, x = λ − 1 or s, in extended precision.
template <int Degree>
double relative_residual(const AffinePolynomial<double, Degree>& polynomial,
                         const BoundaryRoot<double>& root, const PdGains<double>& gains) {
  using Complex = std::complex<long double>;
  const long double angle = root.angle;
  const Complex x = Degree == 5 ? test::unit_circle_minus_one(angle) : Complex(0, angle);
  Complex power(1), value(0);
  long double size = 0;
  for (int k = 0; k <= Degree; ++k, power *= x) {
    const long double terms[] = {
        polynomial.base[k],
        static_cast<long double>(gains.proportional) * polynomial.proportional[k],
        static_cast<long double>(gains.differential) * polynomial.differential[k]};
    for (const long double term : terms) {
      value += term * power;
      size += std::abs(term * power);
    }
  }
  return static_cast<double>(std::abs(value) / size);
}

template <int Degree>
AffinePolynomial<double, Degree> random_coefficients(test::Random& random) {
  AffinePolynomial<double, Degree> result;
  result.base = random.matrix<Polynomial<double, Degree>>();
  result.proportional = random.matrix<Polynomial<double, Degree>>();
  result.differential = random.matrix<Polynomial<double, Degree>>();
  return result;
}

int count(const std::vector<BoundaryFeature<double>>& features, Kind kind) {
  return static_cast<int>(std::count_if(features.begin(), features.end(),
                                        [kind](const auto& f) { return f.kind == kind; }));
}

TEST(BoundaryFeatures, AreRootsOfThePolynomial) {
  test::Random random(821);
  int seen[5] = {}, lines_meet = 0;
  double worst = 0.0, worst_stated = 0.0;
  const auto look_at = [&](const auto& polynomial, const GainWindow& window) {
    for (const auto& feature : boundary_features(polynomial, window)) {
      ++seen[static_cast<int>(feature.kind)];
      const bool two_lines = feature.first.curve == BoundaryCurve::plus_one;
      lines_meet += feature.kind == Kind::crossing && two_lines ? 1 : 0;
      for (const auto& root : {feature.first, feature.second}) {
        worst = std::max(worst, relative_residual(polynomial, root, feature.gains));
      }
      worst_stated = std::max(worst_stated, feature.residual);
    }
  };
  for (int draw = 0; draw < 500; ++draw) {
    const auto plant = test::random_plant(random);
    const auto sampling = test::random_sampling(plant, random);
    // Gains with which sampling matters, m/τ² and m/τ, and up to ten times them.
    const double d = 10 * plant.conductor_mass / sampling.period, p = d / sampling.period;
    look_at(characteristic_polynomial(sampled_loop(plant, sampling)), {{-p, p}, {-d, d}});
    look_at(characteristic_polynomial(plant), whole_plane);
    look_at(random_coefficients<5>(random), whole_plane);
    auto continuous = random_coefficients<4>(random);
    continuous.proportional[4] = continuous.differential[4] = 0.0;
    look_at(continuous, whole_plane);
  }
  std::cout << "  tangents " << seen[0] << " + " << seen[1] << ", crossings " << seen[3]
            << ", ends " << seen[4] << ", worst residual " << worst << " and " << worst_stated
            << '\n';
  EXPECT_LE(worst, 1e-9);
  EXPECT_LE(worst_stated, 1e-9);
  EXPECT_EQ(seen[static_cast<int>(Kind::cusp)], 0) << "a cusp takes a coincidence";
  EXPECT_GT(std::min({seen[0], seen[1], seen[3], seen[4], lines_meet}), 100);
}

/// Values of the gain in the role of D at which roots cross at the fixed one in the role of P.
std::vector<double> crossings_of_row(const AffinePolynomial<double, 5>& polynomial, double p) {
  const auto q = polynomial.transformed(in_half_plane<double, 6>);
  return boundary_crossings<double, 6>(q.base + p * q.proportional, q.differential);
}

/// At a tangent two crossings within `reach` of D are born or die.
void expect_two_meet(const AffinePolynomial<double, 5>& polynomial, double p, double d,
                     double reach) {
  const auto near = [&](double row) {
    int result = 0;
    for (const double crossing : crossings_of_row(polynomial, row)) {
      result += std::abs(crossing - d) < reach ? 1 : 0;
    }
    return result;
  };
  const double step = 1e-7 * std::abs(p);
  EXPECT_EQ(std::abs(near(p + step) - near(p - step)), 2) << p << ' ' << d;
}

TEST(BoundaryFeatures, TangentsAreWhereTwoCrossingsMeet) {
  for (const double period : {0.002, 0.01, 0.03, 0.1}) {
    for (const double fraction : {0.0, 0.4, 1.0}) {
      const auto polynomial = characteristic_polynomial(
          sampled_loop(kollar2022_plant(), Sampling<double>{period, fraction * period}));
      const AffinePolynomial<double, 5> exchanged{polynomial.base, polynomial.differential,
                                                  polynomial.proportional};
      int seen = 0;
      for (const auto& feature : boundary_features(polynomial, {{-1e4, 1e4}, {-1e3, 1e3}})) {
        const double p = feature.gains.proportional, d = feature.gains.differential;
        if (feature.kind == Kind::vertical_tangent) {
          expect_two_meet(polynomial, p, d, 0.02 * std::abs(d));
        } else if (feature.kind == Kind::horizontal_tangent) {
          expect_two_meet(exchanged, d, p, 0.05 * std::abs(p));
        }
        ++seen;
      }
      EXPECT_GT(seen, 1);
    }
  }
}

TEST(BoundaryFeatures, CrossingsWithALineAreAllChangesOfSideAlongTheCurve) {
  test::Random random(823);
  int seen = 0;
  for (int draw = 0; draw < 300; ++draw) {
    const auto polynomial = random_coefficients<5>(random);
    const BoundaryCurves<double, 5> curves(polynomial);
    const auto& line = curves.lines()[random.index(curves.lines().size())];
    // Δ times the line's value changes sign at crossings alone, not at poles.
    const auto side = [&](double square) {
      const auto gains = curves.pairs().gains(square);
      return (line.constant + gains.proportional * line.proportional +
              gains.differential * line.differential) *
             evaluate(curves.pairs().denominator(), square);
    };
    const double from = 1e-4, to = 1e4;
    int changes = 0;
    const int steps = 4000;
    double before = side(from);
    for (int k = 1; k <= steps; ++k) {
      const double now = side(from * std::pow(to / from, static_cast<double>(k) / steps));
      changes += (now > 0) != (before > 0) ? 1 : 0;
      before = now;
    }
    int expected = 0;
    for (const auto& feature : boundary_features(polynomial, whole_plane)) {
      const bool meets = feature.kind == Kind::crossing &&
                         feature.first.curve == BoundaryCurve::complex_pair &&
                         feature.second.curve == line.curve;
      const double y = std::tan(feature.first.angle / 2) / curves.pairs().unit();
      expected += meets && y * y > from && y * y < to ? 1 : 0;
    }
    EXPECT_EQ(changes, expected) << draw;
    seen += expected;
  }
  EXPECT_GT(seen, 200);
}

TEST(BoundaryFeatures, TheCurveEndsInADoubleRoot) {
  test::Random random(824);
  int seen = 0;
  for (int draw = 0; draw < 300; ++draw) {
    const auto polynomial = random_coefficients<5>(random);
    for (const auto& feature : boundary_features(polynomial, whole_plane)) {
      if (feature.kind != Kind::end) continue;
      const double x = feature.second.curve == BoundaryCurve::minus_one ? -2.0 : 0.0;
      const Polynomial<double, 5> p = polynomial.at(feature.gains);
      const double size =
          100 * (1 + std::abs(feature.gains.proportional) + std::abs(feature.gains.differential));
      EXPECT_LE(std::abs(evaluate(p, x)), 1e-14 * size);
      EXPECT_LE(std::abs(evaluate(derivative<double, 6>(p), x)), 1e-14 * size);
      ++seen;
    }
  }
  EXPECT_GT(seen, 500);
}

/// A double pair at the angle (Y = tan²(θ/2) or ω²) makes a cusp at the gains.
template <int Degree>
AffinePolynomial<double, Degree> with_cusp(double angle, const PdGains<double>& gains,
                                           test::Random& random) {
  const double size = 2 - 2 * std::cos(angle);  // |e^{iθ} − 1|²
  const Polynomial<double, 2> pair =
      Degree == 5 ? test::quadratic(size, size) : test::quadratic(angle * angle, 0.0);
  return test::through<Degree>(test::product<Degree>(pair, pair, 0.4), gains, random);
}

/// Of either kind of tangent one that is marked; a third, of another cusp's making, may be far.
bool tangents_are_nearly_a_cusp(const std::vector<BoundaryFeature<double>>& features) {
  const auto is_marked = [&](Kind kind) {
    return std::any_of(features.begin(), features.end(), [kind](const auto& feature) {
      return feature.kind == kind && feature.nearly_cusp;
    });
  };
  return is_marked(Kind::vertical_tangent) && is_marked(Kind::horizontal_tangent);
}

template <int Degree>
void expect_cusps_are_told(std::uint64_t seed) {
  test::Random random(seed);
  for (int draw = 0; draw < 100; ++draw) {
    const double angle = random.uniform(0.3, 2.5);
    const PdGains<double> gains{random.uniform(-2, 2), random.uniform(-2, 2)};
    auto polynomial = with_cusp<Degree>(angle, gains, random);
    const GainWindow window{{gains.proportional - 1e-4, gains.proportional + 1e-4},
                            {gains.differential - 1e-4, gains.differential + 1e-4}};
    const auto exact = boundary_features(polynomial, window);
    const auto cusp = std::find_if(exact.begin(), exact.end(),
                                   [](const auto& f) { return f.kind == Kind::cusp; });
    ASSERT_NE(cusp, exact.end()) << draw;
    EXPECT_EQ(count(exact, Kind::cusp), 1) << draw;
    EXPECT_NEAR(cusp->first.angle, angle, 1e-9);
    EXPECT_NEAR(cusp->gains.proportional, gains.proportional, 1e-9);
    bool nearly = false;
    for (const double change : {1e-7, 1e-6, 1e-5}) {
      auto other = polynomial;
      other.base[1] += change;
      const auto near = boundary_features(other, window);
      const bool is_cusp = count(near, Kind::cusp) > 0;
      nearly = nearly || (!is_cusp && tangents_are_nearly_a_cusp(near));
      EXPECT_FALSE(is_cusp && change == 1e-5) << draw;
    }
    EXPECT_TRUE(nearly) << draw;
  }
}

TEST(BoundaryFeatures, TangentsFarFromEachOtherAreNotNearlyACusp) {
  const auto polynomial =
      characteristic_polynomial(sampled_loop(kollar2022_plant(), Sampling<double>{0.01}));
  const auto features = boundary_features(polynomial, {{-1e6, 1e6}, {-1e6, 1e6}});
  EXPECT_GT(count(features, Kind::vertical_tangent) + count(features, Kind::horizontal_tangent), 0);
  for (const auto& feature : features) EXPECT_FALSE(feature.nearly_cusp);
}

TEST(BoundaryFeatures, ACuspIsToldFromTwoTangentsCloseTogether) {
  expect_cusps_are_told<4>(825);
  expect_cusps_are_told<5>(826);
}

TEST(BoundaryFeatures, KollarsContinuousLoopHasOneTangent) {
  // Without the damping of the conductor (c₁ = 0) P would be largest at ω⁴ = k₁k₂/(m₁m₂).
  const auto features =
      boundary_features(characteristic_polynomial(kollar2022_plant()), {{-1e5, 1e5}, {-1e4, 1e4}});
  ASSERT_EQ(features.size(), 1U);
  EXPECT_EQ(features[0].kind, Kind::vertical_tangent);
  EXPECT_NEAR(features[0].first.angle, std::pow(50.3 * 74.4 / (0.0767 * 0.16), 0.25), 1e-9);
}

/// How often P turns (and D) along the curve of root pairs in fine steps from Y = 10⁻⁵ to 10⁵. A
/// pole is no turn: the step across it is left out.
struct TurnScan {
  int of_proportional = 0, of_differential = 0;

  explicit TurnScan(const RootPairCurve<long double>& curve) {
    const int steps = 5000;
    int p_before = 0, d_before = 0;
    bool positive = false;
    PdGains<long double> here{};
    for (int k = 0; k <= steps; ++k) {
      const long double square = std::pow(10.0L, -5 + 10.0L * k / steps);
      const bool now_positive = evaluate(curve.denominator(), square) > 0;
      const auto next = curve.gains(square);
      if (k > 0 && now_positive == positive) {
        count(next.proportional - here.proportional, p_before, of_proportional);
        count(next.differential - here.differential, d_before, of_differential);
      }
      here = next;
      positive = now_positive;
    }
  }

  static void count(long double step, int& before, int& turns) {
    const int now = step > 0 ? 1 : -1;
    turns += before != 0 && now != before ? 1 : 0;
    before = now;
  }
};

/// Two turns within one step are seen by the features alone.
template <int Degree>
int expect_all_turns_are_found(const AffinePolynomial<long double, Degree>& precise,
                               const AffinePolynomial<double, Degree>& polynomial) {
  const BoundaryCurves<long double, Degree> curves(precise);
  const TurnScan scan(curves.pairs());
  int vertical = 0, horizontal = 0;
  for (const auto& feature :
       detail::FeatureFinder<double, Degree>(BoundaryCurves<double, Degree>(polynomial)).find()) {
    const double angle = feature.first.angle, y = Degree == 5 ? std::tan(angle / 2) : angle;
    const double square = std::pow(y / static_cast<double>(curves.pairs().unit()), 2);
    if (square < 1e-5 || square > 1e5) continue;
    vertical += feature.kind == Kind::vertical_tangent ? 1 : 0;
    horizontal += feature.kind == Kind::horizontal_tangent ? 1 : 0;
  }
  EXPECT_EQ(vertical, scan.of_proportional);
  EXPECT_EQ(horizontal, scan.of_differential);
  return vertical + horizontal;
}

template <int Degree>
AffinePolynomial<long double, Degree> extended(const AffinePolynomial<double, Degree>& exact) {
  return {exact.base.template cast<long double>(), exact.proportional.template cast<long double>(),
          exact.differential.template cast<long double>()};
}

TEST(BoundaryFeatures, TangentsAreAllTurnsAlongTheCurve) {
  test::Random random(827);
  int seen = 0;
  for (int draw = 0; draw < 60; ++draw) {
    const auto any = random_coefficients<5>(random);
    seen += expect_all_turns_are_found<5>(extended(any), any);
    auto continuous = random_coefficients<4>(random);
    continuous.proportional[4] = continuous.differential[4] = 0.0;
    seen += expect_all_turns_are_found<4>(extended(continuous), continuous);
    const auto plant = test::random_plant(random);
    const auto sampling = test::random_sampling(plant, random);
    const Sampling<long double> precise{sampling.period, sampling.processing_delay};
    seen += expect_all_turns_are_found<5>(
        characteristic_polynomial(sampled_loop(converted<long double>(plant), precise)),
        characteristic_polynomial(sampled_loop(plant, sampling)));
  }
  EXPECT_GT(seen, 200);
}

TEST(BoundaryFeatures, OfTheLoopWithoutDelayAreThoseWithoutItsRootAtZero) {
  using Extended = long double;
  test::Random random(831);
  int seen = 0, crossings = 0;
  for (int draw = 0; draw < 200; ++draw) {
    auto plant = test::random_plant(random);
    // Without damping the curve crosses itself at no control.
    if (draw % 4 == 0) plant.conductor_damping = plant.absorber_damping = 0.0;
    const Sampling<Extended> sampling{test::random_sampling(plant, random).period, 0};
    const BoundaryCurves<Extended, 5> curves(
        characteristic_polynomial(sampled_loop(converted<Extended>(plant), sampling)));
    // λ = 0 is w = −1.
    const auto& q = curves.polynomial();
    const auto without = [](const Polynomial<Extended, 5>& part) {
      return Polynomial<Extended, 4>(without_root<Extended, 6>(part, -1).head<5>());
    };
    const RootPairCurve<Extended> reduced(AffinePolynomial<Extended, 4>{
        without(q.base), without(q.proportional), without(q.differential)});
    const auto expect_same = [&](const std::vector<Extended>& all,
                                 const std::vector<Extended>& expected) {
      ASSERT_EQ(all.size(), expected.size()) << draw;
      for (std::size_t k = 0; k < all.size(); ++k, ++seen) {
        const Extended ratio = curves.pairs().root(all[k]) / reduced.root(expected[k]);
        EXPECT_NEAR(static_cast<double>(ratio), 1.0, 1e-5) << draw;
      }
    };
    expect_same(curves.pairs().proportional_extremes(), reduced.proportional_extremes());
    expect_same(curves.pairs().differential_extremes(), reduced.differential_extremes());
    EXPECT_EQ(double_neimark_sacker_points(curves.pairs()).size(),
              double_neimark_sacker_points(reduced).size())
        << draw;
    crossings += static_cast<int>(double_neimark_sacker_points(reduced).size());
  }
  EXPECT_GT(seen, 300);
  EXPECT_GT(crossings, 20);
}

TEST(BoundaryFeatures, WithoutDampingTheContinuousCurveTurnsBackOnItself) {
  test::Random random(829);
  for (int draw = 0; draw < 200; ++draw) {
    TwoMass<double> plant = test::random_plant(random);
    plant.conductor_damping = plant.absorber_damping = 0.0;
    // On D = 0, P = −(m₁m₂ω⁴ − (…)ω² + k₁k₂)/(m₂ω²) has its maximum at ω⁴ = k₁k₂/(m₁m₂).
    const auto features = boundary_features(characteristic_polynomial(plant), whole_plane);
    ASSERT_EQ(features.size(), 1U) << draw;
    EXPECT_EQ(features[0].kind, Kind::cusp);
    EXPECT_EQ(features[0].gains.differential, 0.0);
    const double expected = std::pow(plant.conductor_stiffness * plant.absorber_stiffness /
                                         (plant.conductor_mass * plant.absorber_mass),
                                     0.25);
    EXPECT_NEAR(features[0].first.angle / expected, 1.0, 1e-7) << draw;
  }
}

TEST(BoundaryFeatures, ALineIsKeptHoweverFarApartTheRootsAre) {
  // (s + 1)² (s² + 900 s + 10⁶) + P (1 + s²) + D s: s = 0 at P = −10⁶.
  AffinePolynomial<double, 4> polynomial;
  polynomial.base = test::product<4>(test::quadratic(1, 2), test::quadratic(1e6, 900));
  polynomial.proportional << 1, 0, 1, 0, 0;
  polynomial.differential << 0, 1, 0, 0, 0;
  const auto features = boundary_features(polynomial, whole_plane);
  const auto end = std::find_if(features.begin(), features.end(),
                                [](const auto& f) { return f.kind == Kind::end; });
  ASSERT_NE(end, features.end());
  EXPECT_EQ(end->second.curve, BoundaryCurve::zero);
  EXPECT_NEAR(end->gains.proportional, -1e6, 1e-8);
  EXPECT_NEAR(end->gains.differential, -2000900.0, 1e-8);
}

TEST(BoundaryFeatures, OutsideTheWindowAreLeftOut) {
  const auto polynomial =
      characteristic_polynomial(sampled_loop(kollar2022_plant(), Sampling<double>{0.01}));
  const GainWindow window{{-300.0, 60.0}, {-20.0, 10.0}};
  const auto all = boundary_features(polynomial, whole_plane);
  const auto inside = boundary_features(polynomial, window);
  EXPECT_LT(inside.size(), all.size());
  EXPECT_EQ(static_cast<std::ptrdiff_t>(inside.size()),
            std::count_if(all.begin(), all.end(),
                          [&](const auto& f) { return window.contains(f.gains); }));
}

TEST(BoundaryFeatures, ABadWindowIsRefused) {
  const auto polynomial = characteristic_polynomial(kollar2022_plant());
  constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  for (const GainWindow& bad : {GainWindow{{1, 1}, {0, 1}},
                                {{0, 1}, {1, 1}},
                                {{0, 1}, {2, 1}},
                                {{0, 1}, {not_a_number, 1}},
                                {{0, 1}, {0, std::numeric_limits<double>::infinity()}}}) {
    EXPECT_THROW(boundary_features(polynomial, bad), InvalidParameter);
  }
}

}  // namespace
}  // namespace holdfast
