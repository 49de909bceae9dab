#include "holdfast/stability/boundary/stable_regions.hpp"

#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "support/polynomial/made_polynomial.hpp"
#include "support/random_loop.hpp"

namespace holdfast {
namespace {

/// A random loop and a window of gains in which sampling matters to it.
struct WindowedLoop {
  TwoMass<double> plant;
  Sampling<double> sampling;
  GainWindow window;

  explicit WindowedLoop(test::Random& random)
      : plant(test::random_plant(random)), sampling(test::random_sampling(plant, random)) {
    const auto gains = test::random_gains(plant, sampling.period, random);
    const double p = std::abs(gains.proportional) * random.uniform(0.5, 3.0);
    const double d = std::abs(gains.differential) * random.uniform(0.5, 3.0);
    window = {{gains.proportional - p, gains.proportional + p},
              {gains.differential - d, gains.differential + d}};
  }

  template <class Scalar>
  AffinePolynomial<Scalar, 5> polynomial() const {
    return characteristic_polynomial(
        sampled_loop(converted<Scalar>(plant),
                     Sampling<Scalar>{Scalar(sampling.period), Scalar(sampling.processing_delay)}));
  }
};

AffinePolynomial<double, 5> kollar_polynomial(double period, double delay) {
  return characteristic_polynomial(
      sampled_loop(kollar2022_plant(), Sampling<double>{period, delay}));
}

const GainWindow picture{{-1000.0, 200.0}, {-40.0, 20.0}};

/// Those without unstable roots, which come first.
template <int Degree>
std::vector<GainRegion<double>> stable_regions(const AffinePolynomial<double, Degree>& polynomial,
                                               const GainWindow& window) {
  auto regions = gain_regions(polynomial, window);
  while (!regions.empty() && regions.back().unstable_roots > 0) regions.pop_back();
  return regions;
}

template <class Scalar>
Scalar total_area(const std::vector<GainRegion<Scalar>>& regions) {
  Scalar sum(0);
  for (const auto& region : regions) sum += region.area;
  return sum;
}

TEST(StableRegions, AreasAreThoseOfExtendedPrecision) {
  test::Random random(832);
  double worst = 0.0;
  int compared = 0;
  for (int draw = 0; draw < 200; ++draw) {
    const WindowedLoop loop(random);
    const auto regions = gain_regions(loop.polynomial<double>(), loop.window);
    const auto precise = gain_regions(loop.polynomial<long double>(), loop.window);
    ASSERT_EQ(regions.size(), precise.size()) << draw;
    for (std::size_t k = 0; k < regions.size(); ++k) {
      EXPECT_EQ(regions[k].unstable_roots, precise[k].unstable_roots) << draw;
      const double error = std::abs(regions[k].area - static_cast<double>(precise[k].area));
      worst = std::max(worst, error / loop.window.area());
      ++compared;
    }
  }
  std::cout << "  " << compared << " regions, worst error " << worst << " of the window\n";
  EXPECT_LE(worst, 1e-10);
  EXPECT_GT(compared, 250);
}

/// Routh: s⁴ + a s³ + b s² + D s + P is stable where 0 < P < D (a b − D)/a².
TEST(StableRegions, OfAQuarticUnderAParabolaHasItsAreaInClosedForm) {
  const double a = 3.0, b = 2.0;
  AffinePolynomial<double, 4> polynomial;
  polynomial.base << 0, 0, b, a, 1;
  polynomial.proportional = Polynomial<double, 4>::Unit(0);
  polynomial.differential = Polynomial<double, 4>::Unit(1);
  const GainWindow window{{-2.0, 3.0}, {-1.0, 9.0}};
  const auto stable = stable_regions(polynomial, window);
  ASSERT_EQ(stable.size(), 1U);
  EXPECT_NEAR(stable[0].area, a * b * b * b / 6, 1e-11);
  EXPECT_NEAR(stable[0].proportional.lower, 0.0, 1e-12);
  EXPECT_NEAR(stable[0].proportional.upper, b * b / 4, 1e-12);
  EXPECT_NEAR(stable[0].differential.lower, 0.0, 1e-12);
  EXPECT_NEAR(stable[0].differential.upper, a * b, 1e-12);
  EXPECT_FALSE(stable[0].at_edge);
  // On the other side of the vertical line P = 0 one root is unstable, however close.
  const auto regions = gain_regions(polynomial, window);
  EXPECT_TRUE(std::any_of(regions.begin(), regions.end(), [](const auto& region) {
    return region.unstable_roots == 1 && std::abs(region.proportional.upper) < 1e-12;
  }));
}

/// Regions of the polynomial with its gains exchanged.
std::vector<GainRegion<double>> lying_regions(const AffinePolynomial<double, 5>& q,
                                              const GainWindow& window) {
  return gain_regions(AffinePolynomial<double, 5>{q.base, q.differential, q.proportional},
                      {window.differential, window.proportional});
}

TEST(StableRegions, DoNotDependOnWhichGainIsAcross) {
  test::Random random(833);
  for (int draw = 0; draw < 100; ++draw) {
    const WindowedLoop loop(random);
    const auto& window = loop.window;
    const auto upright = gain_regions(loop.polynomial<double>(), window);
    const auto lying = lying_regions(loop.polynomial<double>(), window);
    ASSERT_EQ(upright.size(), lying.size()) << draw;
    for (std::size_t k = 0; k < upright.size(); ++k) {
      EXPECT_EQ(upright[k].unstable_roots, lying[k].unstable_roots) << draw;
      EXPECT_NEAR(upright[k].area, lying[k].area, 1e-11 * window.area()) << draw;
      EXPECT_NEAR(upright[k].proportional.lower, lying[k].differential.lower,
                  1e-7 * window.width());
      EXPECT_NEAR(upright[k].differential.upper, lying[k].proportional.upper,
                  1e-7 * window.height());
    }
  }
}

int eigenvalues_beyond_the_circle(const WindowedLoop& loop, const PdGains<double>& gains) {
  const auto precise = test::precise_loop(loop.plant, loop.sampling);
  const auto eigenvalues = detail::balanced_eigenvalues<long double, 5>(
      precise.engaged_map({gains.proportional, gains.differential}));
  return static_cast<int>((eigenvalues.array().abs() > 1).count());
}

/// Every third loop is not damped.
TEST(StableRegions, FillTheWindowAndTheirPointsHaveAsManyUnstableEigenvalues) {
  test::Random random(834);
  int seen = 0;
  for (int draw = 0; draw < 500; ++draw) {
    WindowedLoop loop(random);
    if (draw % 3 == 0) loop.plant.conductor_damping = loop.plant.absorber_damping = 0.0;
    const auto regions = gain_regions(loop.polynomial<double>(), loop.window);
    EXPECT_NEAR(total_area(regions) / loop.window.area(), 1.0, 1e-11) << draw;
    for (const auto& region : regions) {
      EXPECT_TRUE(loop.window.contains(region.inside));
      EXPECT_EQ(region.unstable_roots, eigenvalues_beyond_the_circle(loop, region.inside)) << draw;
      ++seen;
    }
    const auto continuous = gain_regions(characteristic_polynomial(loop.plant), loop.window);
    EXPECT_NEAR(total_area(continuous) / loop.window.area(), 1.0, 1e-11) << draw;
  }
  EXPECT_GT(seen, 600);
}

/// The gap of its slab in which a point lies, and the middle of that gap at the slab's middle.
PdGains<double> middle_of_the_cell(const detail::GainSlab<double>& slab, const GainWindow& window,
                                   const PdGains<double>& gains) {
  const double p = slab.lower + (slab.upper - slab.lower) / 2;
  double lower = window.differential.lower, upper = window.differential.upper;
  for (const auto& branch : slab.branches) {
    if (branch.differential(gains.proportional) < gains.differential) {
      lower = branch.differential(p);
    } else {
      upper = std::min(upper, branch.differential(p));
    }
  }
  return {p, (lower + upper) / 2};
}

TEST(StableRegions, TheCountIsTheSameAllOverACell) {
  test::Random random(835);
  int tested = 0;
  for (int draw = 0; draw < 150; ++draw) {
    const WindowedLoop loop(random);
    const BoundaryCurves<double, 5> curves(loop.polynomial<double>());
    const detail::RegionBuilder<double, 5> slabs(curves, loop.window);
    for (int point = 0; point < 20; ++point) {
      const auto& window = loop.window;
      const PdGains<double> gains{
          random.uniform(window.proportional.lower, window.proportional.upper),
          random.uniform(window.differential.lower, window.differential.upper)};
      const auto slab = std::find_if(
          slabs.slabs().begin(), slabs.slabs().end(),
          [&](const auto& candidate) { return gains.proportional <= candidate.upper; });
      ASSERT_NE(slab, slabs.slabs().end());
      EXPECT_EQ(eigenvalues_beyond_the_circle(loop, gains),
                eigenvalues_beyond_the_circle(loop, middle_of_the_cell(*slab, window, gains)))
          << draw << ' ' << gains.proportional << ' ' << gains.differential;
      ++tested;
    }
  }
  EXPECT_EQ(tested, 3000);
}

/// Σ (unstable roots) · area.
double weighted(const std::vector<GainRegion<double>>& regions) {
  return std::accumulate(regions.begin(), regions.end(), 0.0, [](double sum, const auto& region) {
    return sum + region.unstable_roots * region.area;
  });
}

/// Areas within a window that rows in equal steps sweep, each cut at the crossings of its boundary.
struct SweptArea {
  double stable = 0.0, weighted = 0.0;  // the latter with the number of unstable roots

  SweptArea(const AffinePolynomial<double, 5>& polynomial, const GainWindow& window, int rows) {
    const auto q = in_half_plane(polynomial);
    for (int row = 0; row < rows; ++row) {
      const double p = window.proportional.lower + window.width() * (row + 0.5) / rows;
      auto cuts = boundary_crossings<double, 6>(q.base + p * q.proportional, q.differential);
      cuts.push_back(window.differential.upper);
      double from = window.differential.lower;
      for (const double cut : cuts) {
        const double to = std::clamp(cut, from, window.differential.upper);
        if (!(from < to)) continue;
        const int roots = unstable_roots(q.at({p, (from + to) / 2}));
        const double area = (to - from) * window.width() / rows;
        stable += roots == 0 ? area : 0.0;
        weighted += roots * area;
        from = to;
      }
    }
  }
};

TEST(StableRegions, HaveTheAreasThatRowsSweep) {
  for (const double period : {0.001, 0.01, 0.02, 0.03, 0.1}) {
    for (const double fraction : {0.0, 0.4, 1.0}) {
      const auto polynomial = kollar_polynomial(period, fraction * period);
      const SweptArea swept(polynomial, picture, 20000);
      const double area = total_area(stable_regions(polynomial, picture));
      EXPECT_NEAR(swept.stable / area, 1.0, 2e-6) << period << ' ' << fraction;
      const double sum = weighted(gain_regions(polynomial, picture));
      EXPECT_NEAR(swept.weighted / sum, 1.0, 2e-6) << period << ' ' << fraction;
    }
  }
  test::Random random(836);
  for (int draw = 0; draw < 8; ++draw) {
    // A line λ = +1 as well, which the two-mass plant has not.
    const auto polynomial =
        test::through<5>(random.matrix<Polynomial<double, 5>>(), {0, 0}, random);
    const GainWindow window{{-2, 2}, {-3, 1}};
    const double sum = weighted(gain_regions(polynomial, window));
    EXPECT_NEAR(SweptArea(polynomial, window, 20000).weighted / sum, 1.0, 2e-6) << draw;
  }
}

TEST(StableRegions, EqualCountsApartAreTwoRegions) {
  // τ = 10 ms, δ = 4 ms: two unstable roots above the stable region and, apart from that, below.
  const auto regions = gain_regions(kollar_polynomial(0.01, 0.004), picture);
  std::vector<GainRegion<double>> two;
  std::copy_if(regions.begin(), regions.end(), std::back_inserter(two),
               [](const auto& region) { return region.unstable_roots == 2; });
  ASSERT_EQ(two.size(), 2U);
  EXPECT_GT(two[0].inside.differential, 0.0);
  EXPECT_LT(two[1].inside.differential, -26.0);
  EXPECT_GT(two[0].area, two[1].area);
  EXPECT_TRUE(two[0].at_edge && two[1].at_edge);
}

TEST(StableRegions, ExtentsAreThoseOfTheBoundarysTangents) {
  const auto stable = stable_regions(kollar_polynomial(0.01, 0.01), picture);
  ASSERT_EQ(stable.size(), 1U);
  EXPECT_FALSE(stable[0].at_edge);
  double right = -1e9, left = 1e9, up = -1e9;
  for (const auto& feature : boundary_features(kollar_polynomial(0.01, 0.01), picture)) {
    if (feature.kind == BoundaryFeatureKind::vertical_tangent) {
      right = std::max(right, feature.gains.proportional);
      left = std::min(left, feature.gains.proportional);
    } else if (feature.kind == BoundaryFeatureKind::horizontal_tangent) {
      up = std::max(up, feature.gains.differential);
    }
  }
  EXPECT_NEAR(stable[0].proportional.upper, right, 1e-9);
  EXPECT_NEAR(stable[0].proportional.lower, left, 1e-9);
  EXPECT_NEAR(stable[0].differential.upper, up, 1e-9);
}

TEST(StableRegions, OfFastSamplingAreThoseOfTheContinuousLoop) {
  const double limit =
      total_area(stable_regions(characteristic_polynomial(kollar2022_plant()), picture));
  double previous = 1.0;
  for (const double period : {1e-4, 1e-5, 1e-6}) {
    const double area = total_area(stable_regions(kollar_polynomial(period, 0.0), picture));
    const double off = std::abs(area / limit - 1);
    EXPECT_LT(off, 5 * period) << period;
    EXPECT_LT(off, previous / 5) << period;
    previous = off;
  }
}

TEST(StableRegions, WithoutDampingOnlyDelayedFeedbackStabilises) {
  TwoMass<double> plant = kollar2022_plant();
  plant.conductor_damping = plant.absorber_damping = 0.0;
  // No delay: stability would need all odd coefficients D · m₂ k₁ … of one sign, but they are 0.
  EXPECT_TRUE(stable_regions(characteristic_polynomial(plant), picture).empty());
  EXPECT_NEAR(total_area(gain_regions(characteristic_polynomial(plant), picture)), 72000.0, 1e-6);
  for (const double fraction : {0.0, 0.4, 1.0}) {
    const auto loop = sampled_loop(plant, Sampling<double>{0.01, fraction * 0.01});
    const auto stable = stable_regions(characteristic_polynomial(loop), picture);
    ASSERT_EQ(stable.size(), 1U);
    EXPECT_NEAR(stable[0].proportional.lower, 0.0, 1e-9) << "the region begins at no control";
    EXPECT_LT((spectral_radius<double, 5>(loop.engaged_map(stable[0].inside))), 1.0);
  }
}

TEST(StableRegions, BesideAVerticalLineAreThoseBesideTheSameLineLying) {
  test::Random random(837);
  int with_wall = 0;
  for (int draw = 0; draw < 100; ++draw) {
    // D does not move λ = +1: a vertical line.
    auto polynomial = test::through<5>(random.matrix<Polynomial<double, 5>>(), {0, 0}, random);
    polynomial.differential[0] = 0.0;
    const GainWindow window{{-2, 2}, {-3, 1}};
    const auto upright = gain_regions(polynomial, window);
    const auto lying = lying_regions(polynomial, window);
    const double wall = -polynomial.base[0] / polynomial.proportional[0];
    with_wall += std::abs(wall) < 2 ? 1 : 0;
    ASSERT_EQ(upright.size(), lying.size()) << draw;
    for (std::size_t k = 0; k < upright.size(); ++k) {
      EXPECT_EQ(upright[k].unstable_roots, lying[k].unstable_roots) << draw;
      EXPECT_NEAR(upright[k].area, lying[k].area, 1e-10) << draw;
      EXPECT_FALSE(upright[k].proportional.lower < wall - 1e-9 &&
                   upright[k].proportional.upper > wall + 1e-9)
          << draw << ": no region reaches through the wall";
    }
  }
  EXPECT_GT(with_wall, 30);
}

TEST(StableRegions, OfALoopThatForgetsBetweenSamplesAreOneStableRegion) {
  // e^{Aτ} is nothing at τ = 50 s and underflows at 1000 s; the force finds the plant at rest.
  for (const double period : {50.0, 1000.0}) {
    for (const double fraction : {0.0, 0.4, 1.0}) {
      const auto regions = gain_regions(kollar_polynomial(period, fraction * period), picture);
      ASSERT_EQ(regions.size(), 1U) << period << ' ' << fraction;
      EXPECT_EQ(regions[0].unstable_roots, 0);
      EXPECT_NEAR(regions[0].area, 72000.0, 1e-6);
    }
  }
}

}  // namespace
}  // namespace holdfast
