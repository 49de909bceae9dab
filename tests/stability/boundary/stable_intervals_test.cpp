#include "holdfast/stability/boundary/stable_intervals.hpp"

#include "holdfast/math/linalg/spectral_radius.hpp"
#include "support/random_loop.hpp"

namespace holdfast {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// (s + 1)(s + 2)(s + 3)(s + 4) + x sᵏ, and of another sign before s.
TEST(StableIntervals, OfQuarticsAreKnownByHand) {
  const auto of = [](double linear, const Polynomial<double, 4>& slope) {
    Polynomial<double, 4> a;
    a << 24, linear, 35, 10, 1;
    return stable_intervals<double, 5>(a, slope);
  };
  const auto expect_one = [](const std::vector<Interval<double>>& found, double from, double to) {
    ASSERT_EQ(found.size(), 1U);
    const auto is_near = [](double end, double expected) {
      return end == expected || std::abs(end - expected) <= 4e-14 * std::abs(expected);
    };
    EXPECT_TRUE(is_near(found[0].lower, from)) << found[0].lower;
    EXPECT_TRUE(is_near(found[0].upper, to)) << found[0].upper;
  };
  // a₀ = 24 + x > 0, H₃ = 50 · 300 − 100 (24 + x) > 0
  expect_one(of(50, Polynomial<double, 4>::Unit(0)), -24.0, 126.0);
  // H₃ = 50 (10 (35 + x) − 50) − 2400 = 0 at x = −25.2: more of s² only parts the roots
  expect_one(of(50, Polynomial<double, 4>::Unit(2)), -25.2, infinity);
  expect_one(of(50, Polynomial<double, 4>::Zero()), -infinity, infinity);
  EXPECT_TRUE(of(-50, Polynomial<double, 4>::Unit(3)).empty());
}

TEST(StableIntervals, EndWhereARootReachesTheUnitCircle) {
  test::Random random(221);
  int ends = 0;
  for (int draw = 0; draw < 1000; ++draw) {
    const auto plant = test::random_plant(random);
    const auto sampling = test::random_sampling(plant, random);
    const auto loop = sampled_loop(plant, sampling);
    const double p = test::random_gains(plant, sampling.period, random).proportional;
    for (const auto& interval : stable_differential_gains(characteristic_polynomial(loop), p)) {
      for (const double end : {interval.lower, interval.upper}) {
        if (!std::isfinite(end)) continue;
        ++ends;
        EXPECT_NEAR(test::growth(plant, sampling, {p, end}).excess, 0.0, 1e-9);
      }
      EXPECT_LT(test::growth(plant, sampling, {p, interval.representative()}).excess, 0.0);
    }
  }
  EXPECT_GT(ends, 500);
}

TEST(StableIntervals, MissNoStableGainOfAScan) {
  for (const double period : {0.002, 0.01, 0.025}) {
    for (const double fraction : {0.0, 0.5, 1.0}) {
      const auto loop =
          sampled_loop(kollar2022_plant(), Sampling<double>{period, fraction * period});
      const auto polynomial = characteristic_polynomial(loop);
      for (const double p : {-557.0, -100.0, 0.0, 50.0}) {
        const auto intervals = stable_differential_gains(polynomial, p);
        for (double d = -80.0; d < 80.0; d += 0.37) {
          const double radius = spectral_radius<double, 5>(loop.engaged_map({p, d}));
          const bool inside =
              std::any_of(intervals.begin(), intervals.end(),
                          [d](const auto& interval) { return interval.contains(d); });
          if (std::abs(radius - 1) <= 1e-9) continue;
          EXPECT_EQ(inside, radius < 1) << period << " " << p << " " << d;
        }
      }
    }
  }
}

/// The place of each end against bisection on the dominant root in extended precision.
TEST(StableIntervals, EndWhereTheDominantRootCrossesInExtendedPrecision) {
  test::Random random(20260404);
  int compared = 0;
  for (int draw = 0; draw < 200; ++draw) {
    const auto plant = test::random_plant(random);
    const auto sampling = test::random_sampling(plant, random);
    const auto q = in_half_plane(characteristic_polynomial(sampled_loop(plant, sampling)));
    const double p = test::random_gains(plant, sampling.period, random).proportional;
    const auto precise = characteristic_polynomial(test::precise_loop(plant, sampling));
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
