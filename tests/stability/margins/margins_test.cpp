#include "holdfast/stability/margins/margins.hpp"
#include "holdfast/plant/two_mass.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "holdfast/math/linalg/spectral_radius.hpp"
#include "support/dense_routes.hpp"

namespace holdfast {
namespace {

struct MarginCase {
  Sampling<double> sampling;
  PdGains<double> gains;
};

/// All stable; the fifth one is close to its lower edge in D.
const std::vector<MarginCase>& margin_cases() {
  static const std::vector<MarginCase> cases = {
      {{0.001, 0.0}, {-557.0, -13.0}},   {{0.010, 0.0}, {-557.0, -13.0}},
      {{0.010, 0.005}, {-557.0, -13.0}}, {{0.003, 0.003}, {-557.0, -13.0}},
      {{0.010, 0.0}, {-557.0, -15.4}},   {{0.050, 0.0}, {-20.0, -1.0}}};
  return cases;
}

double radius_of(const Sampling<double>& sampling, const PdGains<double>& gains) {
  return spectral_radius<double, 5>(sampled_loop(kollar2022_plant(), sampling).engaged_map(gains));
}

/// One quantity of a loop as it is moved: its margin, its value, and ρ at another value.
struct Moved {
  const char* name;
  TwoSidedMargin margin;
  double value;
  std::function<double(double)> radius;
};

std::vector<Moved> all_moved(const MarginCase& c) {
  const auto margins = stability_margins(kollar2022_plant(), c.sampling, c.gains);
  EXPECT_EQ(margins.outcome, MarginOutcome::stable);
  EXPECT_NEAR(margins.unit_circle, 1.0 - radius_of(c.sampling, c.gains), 1e-9);
  const double fraction = c.sampling.processing_delay / c.sampling.period;
  return {{"D", margins.differential_gain, c.gains.differential,
           [c](double d) {
             return radius_of(c.sampling, {c.gains.proportional, d});
           }},
          {"P", margins.proportional_gain, c.gains.proportional,
           [c](double p) {
             return radius_of(c.sampling, {p, c.gains.differential});
           }},
          {"period", margins.sampling_period, c.sampling.period,
           [c, fraction](double t) {
             return radius_of({t, fraction * t}, c.gains);
           }},
          {"delay", margins.processing_delay, c.sampling.processing_delay, [c](double t) {
             return radius_of({c.sampling.period, t}, c.gains);
           }}};
}

void expect_edge(const Moved& moved, const MarginEnd& end) {
  if (end.outcome != MarginEndOutcome::boundary) return;
  EXPECT_DOUBLE_EQ(end.distance, std::abs(end.position - moved.value)) << moved.name;
  EXPECT_NEAR(moved.radius(end.position), 1.0, 1e-10) << moved.name << ' ' << end.position;
  const double step = 1e-6 * (end.position - moved.value);
  EXPECT_LT(moved.radius(end.position - step), 1.0) << moved.name << ' ' << end.position;
  EXPECT_GT(moved.radius(end.position + step), 1.0) << moved.name << ' ' << end.position;
}

TEST(Margins, EndWhereTheSpectralRadiusIsOne) {
  for (const MarginCase& c : margin_cases()) {
    for (const Moved& moved : all_moved(c)) {
      expect_edge(moved, moved.margin.below);
      expect_edge(moved, moved.margin.above);
    }
  }
}

/// Eigenvalues on a fine grid from the value to the margin's end, or far where there is none.
TEST(Margins, NothingUnstableLiesBetween) {
  for (const MarginCase& c : margin_cases()) {
    for (const Moved& moved : all_moved(c)) {
      const auto scan = [&](const MarginEnd& end, double far) {
        ASSERT_NE(end.outcome, MarginEndOutcome::undefined) << moved.name;
        const double goal = std::isfinite(end.position) ? end.position : far;
        for (int k = 1; k < 2000; ++k) {
          const double at = moved.value + (goal - moved.value) * k / 2000.0;
          ASSERT_LT(moved.radius(at), 1.0) << moved.name << " = " << at << ", end " << goal;
        }
      };
      scan(moved.margin.below, moved.value - 1e4);
      scan(moved.margin.above, moved.value + 1e4);
    }
  }
}

/// Lightly damped plants at periods at which a mode is sampled twice a cycle: a pair meets at −1,
/// one root passes it and comes back within about one per cent of the period.
TEST(Margins, ARealRootThatPassesMinusOneAndComesBackIsSeen) {
  struct Window {
    TwoMass<double> plant;
    double period, unstable;
    PdGains<double> gains;
  };
  for (const Window& w :
       {Window{{0.2271059623, 58.23088085, 0.00698940124, 0.177601167, 96.79231922, 0.1532374473},
               0.05443099411,
               0.0931,
               {-6.85303428, -0.2504667882}},
        {{0.1925192123, 98.5423247, 0.001496166126, 0.2108491509, 36.58791694, 0.02516200096},
         0.2402993092,
         0.1146,
         {-1.308302221, 0.05844000019}}}) {
    const auto radius = [&](double period) {
      const auto loop = sampled_loop(w.plant, Sampling<double>{period});
      return spectral_radius<double, 5>(loop.engaged_map(w.gains));
    };
    ASSERT_LT(radius(w.period), 1.0);
    ASSERT_GT(radius(w.unstable), 1.0);
    const auto margins = stability_margins(w.plant, {w.period}, w.gains);
    const auto& end =
        w.unstable > w.period ? margins.sampling_period.above : margins.sampling_period.below;
    ASSERT_EQ(end.outcome, MarginEndOutcome::boundary);
    EXPECT_EQ(end.curve, BoundaryCurve::minus_one);
    EXPECT_LT(std::abs(end.position - w.period), std::abs(w.unstable - w.period));
    for (int k = 1; k < 5000; ++k) {
      ASSERT_LT(radius(w.period + (end.position - w.period) * k / 5000.0), 1.0) << k;
    }
  }
}

/// Random plants, most of them lightly damped, against eigenvalues on a fine grid of periods.
TEST(Margins, OfRandomLoopsHoldOnAFineGrid) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int tried = 0;
  while (tried < 40) {
    const auto between = [&](double a, double b) { return a * std::pow(b / a, share(generator)); };
    const TwoMass<double> plant{between(0.05, 0.5), between(20, 200),   between(1e-3, 1.0),
                                between(0.05, 0.5), between(20.0, 200), between(1e-3, 5.0)};
    const Sampling<double> sampling{between(1e-3, 0.3), 0.0};
    const PdGains<double> gains{-between(1.0, 100.0),
                                between(0.05, 5.0) * (share(generator) - 0.5)};
    const auto margins = stability_margins(plant, sampling, gains);
    if (margins.outcome != MarginOutcome::stable) continue;
    ++tried;
    const auto scan = [&](const MarginEnd& end, double far) {
      const double goal = std::isfinite(end.position) && end.position > 0.0 ? end.position : far;
      for (int k = 1; k < 1500; ++k) {
        const double period = sampling.period * std::pow(goal / sampling.period, k / 1500.0);
        const auto loop = sampled_loop(plant, Sampling<double>{period});
        ASSERT_LT((spectral_radius<double, 5>(loop.engaged_map(gains))), 1.0 + 1e-12)
            << "loop " << tried << ", period " << period << ", end " << goal;
      }
    };
    scan(margins.sampling_period.below, 1e-2 * sampling.period);
    scan(margins.sampling_period.above, 30.0 * sampling.period);
  }
}

TEST(Margins, OfThePapersGainsEndWhereItsChartsDo) {
  const auto margins =
      stability_margins(kollar2022_plant(), Sampling<double>{0.010}, {-557.0, -13.0});
  EXPECT_NEAR(margins.differential_gain.below.position, -15.5, 0.05) << "Fig. 4a";
  EXPECT_EQ(margins.sampling_period.below.outcome, MarginEndOutcome::none) << "Fig. 3: −33.7 < D";
  EXPECT_EQ(margins.sampling_period.below.position, 0.0);
  EXPECT_EQ(margins.sampling_period.above.outcome, MarginEndOutcome::boundary);
  EXPECT_LT(margins.sampling_period.above.position, 0.050) << "Fig. 4b: never stable";
}

TEST(Margins, NameTheRootThatCrosses) {
  for (const MarginCase& c : margin_cases()) {
    const auto margins = stability_margins(kollar2022_plant(), c.sampling, c.gains);
    for (const MarginEnd& end :
         {margins.differential_gain.below, margins.differential_gain.above}) {
      if (end.outcome != MarginEndOutcome::boundary) continue;
      const Matrix<double, 5> map = sampled_loop(kollar2022_plant(), c.sampling)
                                        .engaged_map({c.gains.proportional, end.position});
      const double angle = 2.0 * pi<double> * end.frequency * c.sampling.period;
      double closest = 1e9;
      for (const auto& lambda : test::eigenvalues_of(map)) {
        closest = std::min(closest, std::abs(lambda - std::polar(1.0, angle)));
      }
      EXPECT_LT(closest, 1e-8);
      EXPECT_EQ(end.curve == BoundaryCurve::plus_one, angle < 1e-8);
      EXPECT_EQ(end.curve == BoundaryCurve::minus_one, angle > pi<double> - 1e-8);
    }
  }
}

TEST(Margins, WithoutControlEveryPeriodIsStable) {
  const auto margins = stability_margins(kollar2022_plant(), Sampling<double>{0.01}, {0.0, 0.0});
  EXPECT_EQ(margins.sampling_period.above.outcome, MarginEndOutcome::none);
  EXPECT_EQ(margins.sampling_period.above.position, std::numeric_limits<double>::infinity());
  EXPECT_EQ(margins.processing_delay.below.outcome, MarginEndOutcome::none);
  EXPECT_EQ(margins.processing_delay.below.position, 0.0);
  EXPECT_EQ(margins.processing_delay.above.position, 0.01);
  EXPECT_TRUE(std::isnan(margins.processing_delay.above.frequency));
}

TEST(Margins, AnUnstableLoopHasNone) {
  for (const MarginCase& c :
       {MarginCase{{0.05}, {-557.0, -13.0}}, {{0.01}, {-557.0, -16.0}}, {{0.001}, {1e5, 0.0}}}) {
    const auto margins = stability_margins(kollar2022_plant(), c.sampling, c.gains);
    EXPECT_EQ(margins.outcome, MarginOutcome::not_stable);
    EXPECT_LT(margins.unit_circle, 0.0);
    EXPECT_EQ(margins.differential_gain.below.outcome, MarginEndOutcome::undefined);
    EXPECT_TRUE(std::isnan(margins.sampling_period.above.position));
  }
}

TEST(Margins, SayWhenTheSearchEnds) {
  // So little damping that nothing is certain of long periods.
  auto plant = kollar2022_plant();
  plant.conductor_damping = plant.absorber_damping = 1e-4;
  MarginSearch search;
  search.longest_period_ratio = 1.5;
  const auto margins = stability_margins(plant, Sampling<double>{0.001}, {0.0, 1e-6}, search);
  ASSERT_EQ(margins.outcome, MarginOutcome::stable);
  const MarginEnd& end = margins.sampling_period.above;
  EXPECT_EQ(end.outcome, MarginEndOutcome::beyond_search);
  EXPECT_NEAR(end.position, 20.0 / 1.999, 0.01) << "twenty periods of the slowest mode";
  EXPECT_DOUBLE_EQ(end.distance, end.position - 0.001);
  EXPECT_TRUE(std::isnan(end.frequency));
}

TEST(Margins, RefuseWhatIsOutOfRange) {
  const auto plant = kollar2022_plant();
  const PdGains<double> gains{-557.0, -13.0};
  EXPECT_THROW(stability_margins(plant, {0.0}, gains), InvalidParameter);
  EXPECT_THROW(stability_margins(plant, {0.01}, {INFINITY, 0.0}), InvalidParameter);
  EXPECT_THROW(stability_margins(plant, {0.01}, gains, {1.0, 1e-6}), InvalidParameter);
  EXPECT_THROW(stability_margins(plant, {0.01}, gains, {10.0, 0.0}), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
