#include "holdfast/stability/boundary/stable_intervals.hpp"

#include "holdfast/math/linalg/spectral_radius.hpp"
#include "support/random_loop.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(StableIntervals, OfAQuarticWithAMovingConstantAreKnownByHand) {
  // (s + 1)(s + 2)(s + 3)(s + 4) + x: a₀ = 24 + x > 0, H₃ = 50 · 300 − 100 (24 + x) > 0.
  Polynomial<double, 4> a;
  a << 24, 50, 35, 10, 1;
  const auto intervals = stable_intervals<double, 5>(a, Polynomial<double, 4>::Unit(0));
  ASSERT_EQ(intervals.size(), 1U);
  EXPECT_NEAR(intervals[0].lower, -24.0, 1e-12);
  EXPECT_NEAR(intervals[0].upper, 126.0, 1e-11);
}

TEST(StableIntervals, MayReachToInfinity) {
  // A growing middle coefficient only separates the roots further: stable beyond H₃ = 0.
  Polynomial<double, 4> a;
  a << 24, 50, 35, 10, 1;
  const auto intervals = stable_intervals<double, 5>(a, Polynomial<double, 4>::Unit(2));
  ASSERT_EQ(intervals.size(), 1U);
  // H₃ = 50 (10 (35 + x) − 50) − 2400 = 0 at x = −25.2
  EXPECT_NEAR(intervals[0].lower, -25.2, 1e-12);
  EXPECT_EQ(intervals[0].upper, infinity);
}

TEST(StableIntervals, AreEmptyWhereNothingHelps) {
  Polynomial<double, 4> a;
  a << 24, -50, 35, 10, 1;
  EXPECT_TRUE((stable_intervals<double, 5>(a, Polynomial<double, 4>::Unit(3)).empty()));
}

TEST(StableIntervals, AreTheWholeLineWhereTheGainIsIdle) {
  Polynomial<double, 4> a;
  a << 24, 50, 35, 10, 1;
  const auto intervals = stable_intervals<double, 5>(a, Polynomial<double, 4>::Zero());
  ASSERT_EQ(intervals.size(), 1U);
  EXPECT_EQ(intervals[0].lower, -infinity);
  EXPECT_EQ(intervals[0].upper, infinity);
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

}  // namespace
}  // namespace holdfast
