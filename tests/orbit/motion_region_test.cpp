#include "holdfast/orbit/motion_region.hpp"

#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "support/kollar_case.hpp"
#include "support/random.hpp"
#include "support/region_places.hpp"

namespace holdfast {
namespace {

PeriodicOrbit mapped_orbit(const IdealLoop<double>& loop) {
  const auto found = find_periodic_orbit(loop, Vector<double, 4>::Zero());
  EXPECT_EQ(found.outcome, OrbitOutcome::certified);
  return *found.orbit;
}

/// (r₀, D) ↦ loop.
auto over_width_and_gain(const IdealLoop<double>& loop) {
  return [loop](double width, double gain) {
    IdealLoop<double> other = loop;
    other.backlash_width = width;
    other.gains.differential = gain;
    return other;
  };
}

/// Whether the orbit's itinerary is that of an attracting motion of another loop.
bool lasts(const IdealLoop<double>& loop, const PeriodicOrbit& orbit) {
  const auto found =
      orbit_of_itinerary(loop, orbit.ratio, ItineraryMaps<double>(loop, orbit.ratio),
                         orbit.itinerary, Backlash<double>(loop.backlash_width, orbit.memory));
  return found.outcome == OrbitOutcome::certified && found.orbit->is_attracting();
}

TEST(MotionRegion, TheMotionLastsJustInsideAndNowhereJustOutside) {
  const IdealLoop<double> loop = test::kollar_loop(0.001, 0.0005);
  const PeriodicOrbit orbit = mapped_orbit(loop);
  const auto family = over_width_and_gain(loop);
  const ParameterWindow window{0.0004, 0.0006, -15.0, -11.0};
  const MotionRegion region = motion_region(family, orbit, window, {0.0005, -13.0});
  ASSERT_TRUE(region.closed);
  for (std::size_t k = 0; k + 1 < region.border.size(); ++k) {
    const auto &here = region.border[k], &next = region.border[k + 1];
    EXPECT_EQ(here.border.kind, BorderKind::border_collision);
    const PlanePoint a = window.shares_of({here.x, here.y}), b = window.shares_of({next.x, next.y});
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (!(here.border == next.border) || length < 1e-4) continue;
    // A step bends by 0.3 at most, so that the border leaves its chord by less.
    const double out = 0.06 * length, x = 0.5 * (a.x + b.x), y = 0.5 * (a.y + b.y);
    const auto beside = [&](double share) {
      return window.at(
          {x + share * out * (b.y - a.y) / length, y - share * out * (b.x - a.x) / length});
    };
    const PlanePoint inner = beside(-1.0), outer = beside(1.0);
    EXPECT_TRUE(lasts(family(inner.x, inner.y), orbit)) << inner.x << ' ' << inner.y;
    EXPECT_FALSE(lasts(family(outer.x, outer.y), orbit)) << outer.x << ' ' << outer.y;
  }
}

TEST(MotionRegion, RandomPointsOfTheWindowAreInsideWhereTheMotionLasts) {
  const IdealLoop<double> loop = test::kollar_loop(0.01, 0.002);
  const PeriodicOrbit orbit = mapped_orbit(loop);
  const auto family = over_width_and_gain(loop);
  const ParameterWindow window{0.0015, 0.0025, -16.0, -8.0};
  const MotionRegion region = motion_region(family, orbit, window, {0.002, -13.0});
  ASSERT_TRUE(region.closed);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int inside = 0, differ = 0;
  for (int k = 0; k < 2000; ++k) {
    const PlanePoint at = window.at({share(random), share(random)});
    const bool is_inside = test::encloses(region, at.x, at.y);
    inside += is_inside ? 1 : 0;
    differ += is_inside != lasts(family(at.x, at.y), orbit) ? 1 : 0;
  }
  EXPECT_GT(inside, 50);
  // The border is a polygon here, and other parts of the region may lie beyond it.
  EXPECT_LE(differ, 4);
}

TEST(MotionRegion, OfBacklashAndForceIsBoundedByRays) {
  const IdealLoop<double> loop = test::kollar_loop(0.001, 0.002);
  const PeriodicOrbit orbit = mapped_orbit(loop);
  const auto family = [&](double width, double force) {
    IdealLoop<double> other = loop;
    other.backlash_width = width;
    other.excitation.amplitude = force;
    return other;
  };
  const MotionRegion region = motion_region(family, orbit, {0.001, 0.003, 0.2, 0.8}, {0.002, 0.5});
  ASSERT_TRUE(region.closed);
  double least = 1.0, most = 0.0;
  for (const auto& point : region.border) {
    if (point.border.kind == BorderKind::window) continue;
    least = std::min(least, point.x / point.y);
    most = std::max(most, point.x / point.y);
  }
  for (const auto& point : region.border) {
    if (point.border.kind == BorderKind::window) continue;
    const double ratio = point.x / point.y;
    EXPECT_NEAR(std::min(ratio - least, most - ratio), 0.0, 1e-11 * ratio);
  }
}

TEST(MotionRegion, WithoutBacklashIsThatOfStableGains) {
  const IdealLoop<double> loop = test::kollar_loop(0.01, 0.0);
  const PeriodicOrbit orbit = mapped_orbit(loop);
  const auto family = [&](double p, double d) {
    IdealLoop<double> other = loop;
    other.gains = {p, d};
    return other;
  };
  const MotionRegion region =
      motion_region(family, orbit, {-1500.0, 800.0, -60.0, 60.0}, {-557.0, -13.0});
  ASSERT_TRUE(region.closed);
  const auto polynomial = characteristic_polynomial(sampled_loop(loop.plant, loop.sampling));
  int resonances[5] = {}, kinds[10] = {};
  for (std::size_t k = 0; k + 1 < region.border.size(); ++k) {
    const auto &point = region.border[k], &next = region.border[k + 1];
    ++kinds[static_cast<int>(point.border.kind)];
    if (point.border.kind == BorderKind::window) continue;
    EXPECT_NEAR(point.border.multiplier.log_modulus, 0.0, 1e-9);
    double nearest = 1e9;
    for (const auto& interval : stable_differential_gains(polynomial, point.x))
      for (const double end : {interval.lower, interval.upper})
        nearest = std::min(nearest, std::abs(end - point.y));
    const auto vertical = stable_differential_gains(polynomial, point.x + 1e-6).size() +
                          stable_differential_gains(polynomial, point.x - 1e-6).size();
    if (vertical == 2) {
      EXPECT_LT(nearest, 1e-6) << point.x << ' ' << point.y;
    }
    if (point.border == next.border) continue;
    const auto order = strong_resonance(point.border, next.border);
    if (!order) continue;
    ++resonances[*order];
    const double turn = std::acos(-1.0);
    const double angles[] = {0.0, 0.0, turn, 2.0 * turn / 3.0, turn / 2.0};
    EXPECT_NEAR(std::abs(point.border.multiplier.angle), angles[*order], *order < 3 ? 0.01 : 1e-6);
  }
  EXPECT_GT(kinds[static_cast<int>(BorderKind::neimark_sacker)], 10);
  EXPECT_GT(kinds[static_cast<int>(BorderKind::fold)], 10);
  EXPECT_EQ(resonances[1], 1);
  EXPECT_EQ(resonances[2], 0);
  EXPECT_GT(resonances[3], 0);
  EXPECT_GT(resonances[4], 0);
}

TEST(MotionRegion, RefusesAWindowThatDoesNotHoldTheMotion) {
  const IdealLoop<double> loop = test::kollar_loop(0.001, 0.0005);
  const PeriodicOrbit orbit = mapped_orbit(loop);
  EXPECT_THROW(motion_region(over_width_and_gain(loop), orbit, {0.0001, 0.0004, -15.0, -11.0},
                             {0.0005, -13.0}),
               InvalidParameter);
}

TEST(StrongResonance, IsNamedByWhatMeets) {
  const auto border = [](BorderKind kind, int part) {
    return MotionBorder{kind, {}, -1, part, {}};
  };
  const auto pair = [&](int part) { return border(BorderKind::neimark_sacker, part); };
  EXPECT_EQ(strong_resonance(pair(0), border(BorderKind::fold, 0)), 1);
  EXPECT_EQ(strong_resonance(border(BorderKind::flip, 0), pair(2)), 2);
  EXPECT_EQ(strong_resonance(pair(1), pair(2)), 3);
  EXPECT_EQ(strong_resonance(pair(1), pair(0)), 4);
  EXPECT_EQ(strong_resonance(pair(1), border(BorderKind::border_collision, 0)), std::nullopt);
  EXPECT_EQ(strong_resonance(border(BorderKind::flip, 0), border(BorderKind::fold, 0)),
            std::nullopt);
}

}  // namespace
}  // namespace holdfast
