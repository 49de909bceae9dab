#include "holdfast/stability/margins/margins.hpp"

#include <cstdlib>
#include <random>

#include "holdfast/plant/linear_plant.hpp"
#include "support/dense_routes.hpp"
#include "support/lagging_plant.hpp"
#include "support/margin_ends.hpp"
#include "support/random_loop.hpp"

namespace holdfast {
namespace {

struct MarginCase {
  Sampling<double> sampling;
  PdGains<double> gains;
};

/// All stable; the fifth one is close to its lower edge in D.
const std::vector<MarginCase> margin_cases = {
    {{0.001, 0.0}, {-557.0, -13.0}},   {{0.010, 0.0}, {-557.0, -13.0}},
    {{0.010, 0.005}, {-557.0, -13.0}}, {{0.003, 0.003}, {-557.0, -13.0}},
    {{0.010, 0.0}, {-557.0, -15.4}},   {{0.050, 0.0}, {-20.0, -1.0}}};

/// ρ, the commands on their way being states.
double radius_of(const TwoMass<double>& plant, const Sampling<double>& sampling,
                 const PdGains<double>& gains) {
  return spectral_radius(loop_map(plant, sampling).closed_map(gains));
}

/// How many points of a margin are looked at, how far where it has no end, how near to one ρ is at
/// an end, and beside it by which share of the way to it ρ is on the right side of one.
struct Look {
  int points;
  double far, rounding, beside;
};

void expect_first_loss(const test::Moved& moved, const MarginEnd& end, double far,
                       const Look& look) {
  SCOPED_TRACE(moved.name);
  ASSERT_NE(end.outcome, MarginEndOutcome::undefined);
  const double goal = std::isfinite(end.position) ? end.position : moved.value + far;
  for (int k = 1; k < look.points; ++k) {
    const double at = moved.value + (goal - moved.value) * k / look.points;
    ASSERT_LT(moved.radius(at), 1.0) << at << ", end " << goal;
  }
  if (end.outcome != MarginEndOutcome::boundary) return;
  EXPECT_DOUBLE_EQ(end.distance, std::abs(end.position - moved.value));
  EXPECT_NEAR(moved.radius(end.position), 1.0, look.rounding) << end.position;
  const double step = look.beside * (end.position - moved.value);
  EXPECT_LT(moved.radius(end.position - step), 1.0) << end.position;
  EXPECT_GT(moved.radius(end.position + step), 1.0) << end.position;
}

template <class Plant>
StabilityMargins expect_first_losses(const Plant& plant, const MarginCase& c, const Look& look) {
  const auto margins = stability_margins(plant, c.sampling, c.gains);
  EXPECT_EQ(margins.outcome, MarginOutcome::stable);
  const auto all = test::all_moved(margins, plant, c.sampling, c.gains);
  EXPECT_NEAR(margins.unit_circle, 1.0 - all[0].radius(c.gains.differential), look.rounding);
  for (const test::Moved& moved : all) {
    expect_first_loss(moved, moved.margin.below, -look.far, look);
    expect_first_loss(moved, moved.margin.above, look.far, look);
  }
  return margins;
}

TEST(Margins, EndWhereTheSpectralRadiusIsOneAndNotBefore) {
  for (const MarginCase& c : margin_cases)
    expect_first_losses(kollar2022_plant(), c, {2000, 1e4, 1e-10, 1e-6});
}

struct LaggingCase {
  double filter, drive;
  MarginCase loop;
};

/// Stable loops of seven states, with delays of none, part of a sample, and several.
const std::vector<LaggingCase> lagging_cases = {{200.0, 300.0, {{0.001, 0.0}, {-100.0, -5.0}}},
                                                {100.0, 150.0, {{0.002, 0.001}, {-50.0, -3.0}}},
                                                {200.0, 300.0, {{0.001, 0.0025}, {-60.0, -4.0}}},
                                                {100.0, 300.0, {{0.001, 0.003}, {-30.0, -2.0}}},
                                                {200.0, 300.0, {{0.005, 0.002}, {-100.0, -6.5}}},
                                                {200.0, 300.0, {{0.0005, 0.0031}, {-60.0, -5.5}}},
                                                {30.0, 60.0, {{0.01, 0.0}, {-20.0, -1.0}}}};

TEST(AnyOrderMargins, OfSevenStatesAreTheFirstLossesOfStability) {
  int late = 0;
  for (const LaggingCase& c : lagging_cases) {
    SCOPED_TRACE(c.loop.sampling.processing_delay / c.loop.sampling.period);
    const auto margins =
        expect_first_losses(test::lagging_plant(c.filter, c.drive), c.loop, {500, 1e4, 1e-9, 1e-5});
    const MarginEnd& delay = margins.processing_delay.above;
    late +=
        delay.outcome == MarginEndOutcome::boundary && delay.position > 2.0 * c.loop.sampling.period
            ? 1
            : 0;
  }
  EXPECT_GE(late, 1);
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

/// Two lightly damped loops of outside judges, whose root pairs nearly meet where one of them
/// leaves the circle for four thousandths of the period.
TEST(Margins, AWindowBetweenTwoPairsThatNearlyMeetIsSeenFromEveryPeriod) {
  const TwoMass<double> plant{0.1157336128758562,  1.567728964593707, 0.003258642440361626,
                              0.14832293510810604, 17.21286097380955, 0.0036387040574816644};
  const PdGains<double> gains{0.29194358230569967, 0.00047046590574949785};
  const auto radius = [&](double period) {
    return spectral_radius<double, 5>(
        sampled_loop(plant, Sampling<double>{period}).engaged_map(gains));
  };
  ASSERT_GT(radius(0.3315), 1.0);
  for (const double period : {0.3, 0.31, 0.32, 0.33}) {
    const MarginEnd end = stability_margins(plant, {period}, gains).sampling_period.above;
    ASSERT_EQ(end.outcome, MarginEndOutcome::boundary) << period;
    EXPECT_NEAR(end.position, 0.33076, 1e-5) << period;
    EXPECT_GT(radius(end.position * (1.0 + 1e-7)), 1.0) << period;
  }
  const MarginEnd below = stability_margins(plant, {0.34}, gains).sampling_period.below;
  EXPECT_NEAR(below.position, 0.33208, 1e-5);
}

/// HOLDFAST_RANDOM_LOOPS of them, 300 where it is not set.
int random_loops() {
  const char* const wanted = std::getenv("HOLDFAST_RANDOM_LOOPS");
  return wanted == nullptr ? 300 : std::atoi(wanted);
}

/// Lightly damped plants, both ways along τ and δ, against eigenvalues on a grid from the value to
/// the end: finer than the roots' own angles turn, and finer still towards the end.
TEST(Margins, NoScanOfALightlyDampedLoopFindsAnEarlierExit) {
  std::mt19937 generator(24);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto between = [&](double a, double b) { return a * std::pow(b / a, share(generator)); };
  int boundaries = 0;
  for (int tried = 0, loops = random_loops(); tried < loops;) {
    const TwoMass<double> plant{between(0.05, 0.5), between(1.0, 100.0), between(3e-4, 0.03),
                                between(0.05, 0.5), between(1.0, 100.0), between(3e-4, 0.03)};
    const double fraction = share(generator) < 0.5 ? 0.0 : share(generator);
    const double period = between(1e-2, 0.5);
    const PdGains<double> gains{(share(generator) - 0.5) * between(0.01, 10.0),
                                (share(generator) - 0.7) * between(1e-3, 1.0)};
    const auto radius = [&](double t, double delay) {
      if (delay > t) return radius_of(plant, {t, delay}, gains);
      return spectral_radius<double, 5>(
          sampled_loop(plant, Sampling<double>{t, delay}).engaged_map(gains));
    };
    if (!(radius(period, fraction * period) < 1.0 - 1e-9)) continue;
    ++tried;
    MarginSearch search;
    search.longest_period_ratio = 1.5;
    search.most_steps = 3000;
    const auto margins = stability_margins(plant, {period, fraction * period}, gains, search);
    if (margins.outcome != MarginOutcome::stable) continue;
    const auto scan = [&](const MarginEnd& end, double value, const auto& radius_at) {
      boundaries += end.outcome == MarginEndOutcome::boundary ? 1 : 0;
      const double goal = std::min(end.position, value + 2.0);
      for (int k = 1; k < 600; ++k) {
        const double at =
            value + (goal - value) * (1.0 - 1e-6) * std::sin(0.5 * pi<double> * k / 600);
        if (at <= 1e-3 * value) continue;
        ASSERT_LT(radius_at(at), 1.0 + 1e-13)
            << "loop " << tried << " at " << at << ", end " << goal;
      }
    };
    const auto by_period = [&](double t) { return radius(t, fraction * t); };
    const auto by_delay = [&](double delay) { return radius(period, delay); };
    scan(margins.sampling_period.above, period, by_period);
    scan(margins.sampling_period.below, period, by_period);
    scan(margins.processing_delay.above, fraction * period, by_delay);
    scan(margins.processing_delay.below, fraction * period, by_delay);
  }
  EXPECT_GT(boundaries, random_loops() / 2);
}

/// A stiffness at which the steps are as short as the fastest mode: the work is bounded, and what
/// is shown is said.
TEST(Margins, OfAnAbsurdStiffnessEndWithTheWork) {
  auto plant = kollar2022_plant();
  plant.absorber_stiffness = 1e15;
  MarginSearch search;
  search.most_steps = 50;
  const auto margins = stability_margins(plant, {1e-3}, {0.0, -1e-3}, search);
  if (margins.outcome != MarginOutcome::stable) GTEST_SKIP() << "not stable";
  EXPECT_EQ(margins.sampling_period.above.outcome, MarginEndOutcome::beyond_search);
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
  for (const MarginCase& c : margin_cases) {
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
  EXPECT_EQ(margins.processing_delay.above.outcome, MarginEndOutcome::none);
  EXPECT_EQ(margins.processing_delay.above.position, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(margins.processing_delay.above.frequency));
}

/// A delay may be longer than a sample: what a walk has not met there is not infinitely far.
TEST(Margins, OfTheDelayGoOnBeyondASample) {
  for (const double d : {-13.0, -14.2122, -20.0, -5.0}) {
    const PdGains<double> gains{-557.0, d};
    const MarginEnd above = stability_margins(kollar2022_plant(), Sampling<double>{0.001}, gains)
                                .processing_delay.above;
    const bool ends = above.outcome == MarginEndOutcome::boundary;
    ASSERT_TRUE(ends || above.outcome == MarginEndOutcome::beyond_search) << d;
    EXPECT_TRUE(std::isfinite(above.distance)) << d;
    for (int k = 1; k <= 40; ++k)
      EXPECT_LT(radius_of(kollar2022_plant(), {0.001, above.position * 0.999 * k / 40}, gains), 1.0)
          << d;
    if (ends) {
      EXPECT_GT(radius_of(kollar2022_plant(), {0.001, 1.001 * above.position}, gains), 1.0);
    } else {
      EXPECT_NEAR(above.position, 0.010, 1e-12) << "ten samples";
    }
    if (d == -14.2122) {
      EXPECT_NEAR(above.position, 0.009196, 1e-6);
    }
  }
}

/// Ends of P that the roots of the characteristic polynomial give to five digits only, and what
/// extended precision has.
TEST(Margins, OfIllConditionedLoopsHaveTheEndsOfTheCrossings) {
  struct Hard {
    TwoMass<double> plant;
    Sampling<double> sampling;
    PdGains<double> gains;
    double end;
  };
  for (const Hard& hard : {Hard{{0.0907159, 10.4702, 0.162981, 965.835, 43983.8, 778.704},
                                {0.000201064, 7.97458e-05},
                                {-45315.37, -566.0896772},
                                3551.480851},
                           {{0.0369828, 0.427114, 0.0264557, 10.8146, 25651.0, 87.5551},
                            {0.000122939, 6.21177e-05},
                            {-2160.3654, -650.0431934},
                            14418.460745091}}) {
    const auto margins = stability_margins(hard.plant, hard.sampling, hard.gains);
    EXPECT_NEAR(margins.proportional_gain.above.position, hard.end, 1e-9 * hard.end);
    const auto crossings = stable_gains(loop_map(linear_plant(hard.plant), hard.sampling),
                                        FreeGain::proportional, hard.gains);
    EXPECT_TRUE(std::any_of(crossings.begin(), crossings.end(), [&](const auto& interval) {
      return interval.upper == margins.proportional_gain.above.position;
    }));
  }
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
  const auto late =
      stability_margins(test::lagging_plant(20.0, 20.0), {0.01, 0.03}, {-300.0, 40.0});
  EXPECT_EQ(late.outcome, MarginOutcome::not_stable);
  EXPECT_LE(late.unit_circle, 0.0);
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
  EXPECT_THROW(stability_margins(test::through_ports(plant), {0.0}, gains), InvalidParameter);
  EXPECT_THROW(stability_margins(plant, {0.01}, {INFINITY, 0.0}), InvalidParameter);
  EXPECT_THROW(stability_margins(plant, {0.01}, gains, {1.0}), InvalidParameter);
  EXPECT_THROW(stability_margins(plant, {0.01}, gains, {10.0, 0}), InvalidParameter);
}

/// The closed map anywhere in a stretch is its polynomial but for the remainder, which is small.
TEST(SamplingFamily, TheMovingMapIsTheMapAllOverTheStretch) {
  const LinearPlant<double> plant = test::lagging_plant(40.0, 60.0);
  const PdGains<double> gains{-50.0, -3.0};
  const double period = 0.003;
  using Family = SamplingFamily<LinearPlant<double>>;
  for (const bool by_period : {true, false}) {
    for (const double fraction : {0.0, 0.4, 1.0, 2.3}) {
      if (!by_period && fraction == std::floor(fraction)) continue;
      const Family family = by_period
                                ? Family::of_period(plant, fraction)
                                : Family::of_delay(plant, period, held_commands({1.0, fraction}));
      const double position = by_period ? period : fraction * period, radius = 0.3 * period;
      const TaylorMatrix moving = family.moving(family.map_at(position), gains, radius);
      for (const double x : {-0.9, -0.3, 0.4, 0.9}) {
        const Eigen::MatrixXd map = family.map_at(position + x * radius).closed_increment(gains);
        Eigen::MatrixXd sum = moving.terms.back();
        for (std::size_t k = moving.terms.size() - 1; k > 0; --k)
          sum = (x * sum + moving.terms[k - 1]).eval();
        if (!by_period && position + x * radius > held_commands({1.0, fraction}) * period) continue;
        const Eigen::MatrixXd allowed =
            moving.remainder.array() + 1e-12 * moving.terms.front().cwiseAbs().maxCoeff();
        EXPECT_LE(((map - sum).cwiseAbs() - allowed).maxCoeff(), 0.0) << by_period << fraction << x;
        EXPECT_LT(moving.remainder.maxCoeff(), 1e-8);
      }
    }
  }
}
}  // namespace
}  // namespace holdfast
