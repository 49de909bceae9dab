#include "holdfast/math/roots/first_roots.hpp"

#include "support/random.hpp"

namespace holdfast {
namespace {

constexpr int terms_of_tests = 12;

LaneSeries<double> lane_series(const Series& p) {
  LaneSeries<double> series{};
  for (Eigen::Index k = 0; k < p.size(); ++k) series[static_cast<std::size_t>(k)] = p[k];
  return series;
}

FirstRoots<double> one_root(const Series& p) {
  std::array<LaneSeries<double>, 1> all{lane_series(p)};
  return first_roots<double, 1>(all, static_cast<int>(p.size()), {true})[0];
}

/// A polynomial like a guard's: its terms fall, some begin with zeros.
Series random_guard(test::Random& random) {
  Series p = Series::Zero(terms_of_tests);
  double size = random.log_uniform(1e-9, 1e3);
  for (Eigen::Index k = 0; k < p.size(); ++k, size *= random.uniform(0.1, 0.7))
    p[k] = size * random.uniform(-1.0, 1.0);
  p[0] = std::abs(p[0]) * random.unit();
  for (std::size_t zeros = random.unit() < 0.3 ? random.index(4) : 0; zeros-- > 0;)
    p[static_cast<Eigen::Index>(zeros)] = 0.0;
  return p;
}

TEST(FirstRoots, AreThoseOfFirstRoot) {
  test::Random random(77);
  int found = 0;
  for (int trial = 0; trial < 50'000; ++trial) {
    const Series p = random_guard(random);
    const FirstRoot alone = first_root(p);
    const FirstRoots<double> root = one_root(p);
    if (alone.outcome == RootOutcome::grazing) continue;
    ASSERT_EQ(root.found, alone.outcome == RootOutcome::crossing) << p.transpose();
    const double slope = std::abs(value_and_slope(p, alone.at).slope);
    const double blur = 1e-14 * p.cwiseAbs().sum() / slope + 1e-15;
    if (root.found && blur < 1e-3) {
      ASSERT_NEAR(root.at, alone.at, 4.0 * blur) << p.transpose();
    }
    found += root.found ? 1 : 0;
  }
  EXPECT_GT(found, 10'000);
}

TEST(FirstRoots, OfTwoPolynomialsEachIsItsOwn) {
  test::Random random(78);
  for (int trial = 0; trial < 1000; ++trial) {
    const Series p = random_guard(random), q = random_guard(random);
    std::array<LaneSeries<double>, 2> both{lane_series(p), lane_series(q)};
    const auto [one, two] = first_roots<double, 2>(both, terms_of_tests, {true, true});
    EXPECT_EQ(one.at, one_root(p).at);
    EXPECT_EQ(two.at, one_root(q).at);
    EXPECT_EQ(two.found, one_root(q).found);
  }
}

TEST(FirstRoots, SizesAtTheEndsOfTheRangeDoNotMatter) {
  Series p(3);
  p << 1.0, -3.0, 1.0;
  for (const double size : {1e-290, 1e-120, 1.0, 1e120, 1e290}) {
    EXPECT_TRUE(one_root(p * size).found);
    EXPECT_NEAR(one_root(p * size).at, 0.5 * (3.0 - std::sqrt(5.0)), 1e-15);
  }
}

TEST(FirstRoots, WhatIsNoNumberHasNone) {
  Series p = Series::Ones(4);
  for (const double odd :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    p[2] = odd;
    EXPECT_FALSE(one_root(p).found);
    EXPECT_EQ(one_root(p).at, 1.0);
  }
  EXPECT_FALSE(one_root(Series::Zero(5)).found);
}

TEST(FirstRoots, OneThatBeginsBelowHasItsRootThere) {
  Series p(3);
  p << 0.0, -1.0, 5.0;
  EXPECT_TRUE(one_root(p).found);
  EXPECT_EQ(one_root(p).at, 0.0);
}

TEST(FirstRoots, LanesThatAreNotAskedHaveNone) {
  Series p(2);
  p << 1.0, -2.0;
  std::array<LaneSeries<double>, 1> all{lane_series(p)};
  EXPECT_FALSE((first_roots<double, 1>(all, 2, {false})[0].found));
}

}  // namespace
}  // namespace holdfast
