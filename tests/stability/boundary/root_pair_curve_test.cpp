#include "holdfast/stability/boundary/root_pair_curve.hpp"

#include "holdfast/stability/boundary/boundary.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/chart/chart.hpp"
#include "support/polynomial/pair_gains.hpp"
#include "support/random_loop.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

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

TEST(RootPairCurve, IsMonotoneInPOnEachArc) {
  test::Random random(3);
  for (int draw = 0; draw < 200; ++draw) {
    const auto plant = test::random_plant(random);
    const auto polynomial =
        characteristic_polynomial(sampled_loop(plant, test::random_sampling(plant, random)));
    const RootPairCurve<double> curve(in_half_plane(polynomial));
    for (const auto& arc : curve.arcs()) {
      if (std::isinf(arc.end.square) || arc.start.square == 0.0) continue;
      const double ratio = arc.end.square / arc.start.square;
      if (ratio < 1.0 + 1e-6) continue;
      double last = 0.0, direction = 0.0;
      for (int step = 0; step <= 40; ++step) {
        const double share = 0.01 + 0.98 * step / 40.0;
        const double p = curve.gains(arc.start.square * std::pow(ratio, share)).proportional;
        if (step == 1) direction = p - last;
        if (step > 1) {
          EXPECT_GE((p - last) * direction, 0.0) << draw << ' ' << step;
        }
        last = p;
      }
    }
  }
}

/// Two routes to the same crossings: arcs followed from row to row, and the roots of one polynomial
/// a row.
TEST(RowCrossings, AreThoseOfTheEliminatedPolynomial) {
  test::Random random(20260403);
  int crossings = 0;
  for (int draw = 0; draw < 300; ++draw) {
    const auto plant = test::random_plant(random);
    const auto sampling = test::random_sampling(plant, random);
    const auto q = in_half_plane(characteristic_polynomial(sampled_loop(plant, sampling)));
    RowCrossings<double, 5> rows(q);
    for (int step = 0; step < 20; ++step) {
      const double p = test::random_gains(plant, sampling.period, random).proportional;
      const auto expected =
          boundary_crossings<double, 6>(q.base + p * q.proportional, q.differential);
      const double mass =
          plant.conductor_mass * plant.absorber_mass / (plant.conductor_mass + plant.absorber_mass);
      const double scale = mass / sampling.period;  // of gains that matter
      for (const auto& crossing : rows.at(p)) {
        if (std::abs(crossing.differential) > 10.0 * scale)
          continue;  // far beyond use, ill-conditioned
        double nearest = std::numeric_limits<double>::infinity();
        for (const double other : expected) {
          nearest = std::min(nearest, std::abs(other - crossing.differential));
        }
        EXPECT_LT(nearest, 1e-6 * scale) << draw << ' ' << p << ' ' << crossing.differential;
        ++crossings;
      }
      // … and none of those that matter is missed.
      for (const double other : expected) {
        if (std::abs(other) > scale) continue;
        const auto before =
            stable_intervals<double, 6>(q.base + p * q.proportional, q.differential);
        const bool ends_an_interval =
            std::any_of(before.begin(), before.end(), [other](const Interval<double>& interval) {
              return interval.lower == other || interval.upper == other;
            });
        if (!ends_an_interval) continue;
        double nearest = std::numeric_limits<double>::infinity();
        for (const auto& crossing : rows.at(p)) {
          nearest = std::min(nearest, std::abs(other - crossing.differential));
        }
        EXPECT_LT(nearest, 1e-6 * scale) << draw << ' ' << p << ' ' << other;
      }
    }
  }
  EXPECT_GT(crossings, 5000);
}

/// The place of each crossing against bisection on the dominant root in extended precision.
TEST(RowCrossings, StandWhereTheDominantRootCrossesInExtendedPrecision) {
  test::Random random(20260404);
  int compared = 0;
  for (int draw = 0; draw < 200; ++draw) {
    const auto plant = test::random_plant(random);
    const auto sampling = test::random_sampling(plant, random);
    const auto q = in_half_plane(characteristic_polynomial(sampled_loop(plant, sampling)));
    const double p = test::random_gains(plant, sampling.period, random).proportional;
    const auto precise = characteristic_polynomial(
        sampled_loop(converted<long double>(plant),
                     Sampling<long double>{sampling.period, sampling.processing_delay}));
    const auto excess = [&](long double d) {
      long double largest = -1;
      for (const auto& root : roots(precise.at({p, d}))) {
        largest = std::max(largest, 2 * root.real() + std::norm(root));
      }
      return largest;
    };
    for (const Interval<double>& interval :
         stable_intervals<double, 6>(q.base + p * q.proportional, q.differential)) {
      if (!std::isfinite(interval.lower) || !std::isfinite(interval.upper)) continue;
      const long double width = static_cast<long double>(interval.upper) - interval.lower;
      long double inside = interval.representative(), outside = interval.lower - width / 1000;
      if (!(excess(inside) < 0) || !(excess(outside) > 0)) continue;
      while (std::abs(inside - outside) > 1e-14L * width) {
        const long double middle = (inside + outside) / 2;
        (excess(middle) < 0 ? inside : outside) = middle;
      }
      EXPECT_LT(std::abs(excess(interval.lower)), 1e-10) << draw;
      // Near a fold of the curve the end moves as the root of what moves it: there its place says
      // less than the root's modulus does.
      const long double slope =
          (excess(inside + width / 1000000) - excess(inside - width / 1000000)) / (width / 500000);
      const double round_off = static_cast<double>(1e-12L / std::abs(slope));
      EXPECT_NEAR(interval.lower, static_cast<double>(inside),
                  1e-10 * static_cast<double>(width) + round_off)
          << draw;
      ++compared;
    }
  }
  EXPECT_GT(compared, 50);
}

}  // namespace
}  // namespace holdfast
