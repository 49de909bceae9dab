#include "holdfast/stability/chart/proved_family.hpp"

#include "holdfast/stability/polynomial/loop_polynomial.hpp"
#include "support/loop_family.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

const OperatingPoint paper_point{kollar2022_plant(), {0.001, 0.0}, {-557.0, -13.0}};

/// ρ − 1 of a loop, by its roots.
double excess_of(const OperatingPoint& point) {
  return loop_polynomial(sampled_loop(point.plant, point.sampling)).excess(point.gains);
}

OperatingPoint random_point(test::Random& random) {
  const auto times = [&](double value) { return random.log_uniform(0.4 * value, 2.5 * value); };
  OperatingPoint point{
      {times(0.0767), times(50.3), times(0.079), times(0.16), times(74.4), times(4.0)},
      {random.log_uniform(0.0006, 0.013), 0.0},
      {random.uniform(-800.0, 100.0), random.uniform(-15.0, 3.0)}};
  if (random.unit() < 0.5)
    point.sampling.processing_delay = random.uniform(0.0, 0.9) * point.sampling.period;
  return point;
}

/// Some of the parameters by 2 to 50 per cent either way, the delay within a sample.
TwoMassFamily::Box box_about(const OperatingPoint& point, test::Random& random) {
  TwoMassFamily::Box box = test::box_about(TwoMassFamily::of(point), 0.02, 0.5, random);
  constexpr std::size_t period = 6, delay = 7;
  if (box.highest[delay] > box.lowest[period]) box.lowest[delay] = box.highest[delay] = 0.0;
  return box;
}

// The spectral radius, from the roots of a polynomial that the proof does not use.
TEST(ProvedFamily, NoMemberContradictsIt) {
  test::Random random(41);
  int decided = 0, stable = 0;
  for (int draw = 0; draw < 30; ++draw) {
    const TwoMassFamily::Box box = box_about(random_point(random), random);
    const ProvedFamily family = prove_family(TwoMassFamily(), box, {300}, [] {});
    decided += family.verdict() != ProvedStability::undecided;
    if (family.unstable_loop) {
      EXPECT_GT(excess_of(TwoMassFamily::point_of(*family.unstable_loop)), 0.0) << draw;
      const TwoMassFamily::Parameters<double> loop = *family.unstable_loop;
      for (std::size_t k = 0; k < TwoMassFamily::parameters; ++k) {
        EXPECT_GE(loop[k], box.lowest[k]);
        EXPECT_LE(loop[k], box.highest[k]);
      }
    }
    if (family.verdict() != ProvedStability::stable) continue;
    ++stable;
    EXPECT_NEAR(family.stable_share, 1.0, 1e-12);
    for (int k = 0; k < 500; ++k)
      ASSERT_LT(excess_of(TwoMassFamily::point_of(test::member_of(box, random))), 0.0)
          << "box " << draw;
  }
  EXPECT_GE(decided, 28);
  EXPECT_GE(stable, 10);
}

TEST(ProvedFamily, IsOfSixParametersByAFifthEitherWay) {
  TwoMassFamily::Box box{TwoMassFamily::of(paper_point), TwoMassFamily::of(paper_point)};
  for (const std::size_t k : {1U, 2U, 3U, 4U, 5U, 6U}) {
    box.lowest[k] *= 0.8;
    box.highest[k] *= 1.2;
  }
  const ProvedFamily family = prove_family(TwoMassFamily(), box, {200}, [] {});
  EXPECT_EQ(family.verdict(), ProvedStability::stable);
  const ProvedFamily cut_short = prove_family(TwoMassFamily(), box, {3}, [] {});
  EXPECT_EQ(cut_short.verdict(), ProvedStability::undecided);
  EXPECT_NEAR(cut_short.stable_share + cut_short.undecided_share, 1.0, 1e-12);
}

// The ends of the stable D are known in closed form.
TEST(ProvedFamily, ReachesTheEdgeAndNeverBeyond) {
  for (const double period : {0.001, 0.005, 0.01}) {
    OperatingPoint point = paper_point;
    point.sampling.period = period;
    const Interval<double> stable =
        differential_gains_within_radius(sampled_loop(point.plant, point.sampling),
                                         point.gains.proportional, 1.0)
            .front();
    TwoMassFamily::Box box{TwoMassFamily::of(point), TwoMassFamily::of(point)};
    constexpr std::size_t d = 9;
    const double width = stable.upper - stable.lower;
    box.lowest[d] = stable.lower + 0.01 * width;
    box.highest[d] = stable.upper - 0.01 * width;
    EXPECT_EQ(prove_family(TwoMassFamily(), box, {2000}, [] {}).verdict(), ProvedStability::stable)
        << period;
    for (const double beyond : {1e-9, 1e-4}) {
      TwoMassFamily::Box lower = box, upper = box;
      lower.lowest[d] = stable.lower - beyond * width;
      upper.highest[d] = stable.upper + beyond * width;
      for (const TwoMassFamily::Box& touching : {lower, upper})
        EXPECT_NE(prove_family(TwoMassFamily(), touching, {300}, [] {}).verdict(),
                  ProvedStability::stable)
            << period << ' ' << beyond;
    }
  }
}

TEST(ProvedFamily, SumsTheFrequenciesThatSamplesDoNotTellApart) {
  test::Random random(42);
  for (int draw = 0; draw < 200; ++draw) {
    const OperatingPoint point = random_point(random);
    test::expect_function_of(TwoMassFamily(), TwoMassFamily::of(point),
                             random.log_uniform(1e-3, pi<double>),
                             loop_map(linear_plant(point.plant), point.sampling));
  }
}

// Differences of values at both ends of a short interval.
TEST(EnclosedSlope, EnclosesValuesAndDerivatives) {
  test::Random random(43);
  const auto function = [](const EnclosedSlope& x) {
    return sinc(x) * cos(x * x) / (EnclosedSlope(2.0) + sin(x)) - x;
  };
  for (int draw = 0; draw < 300; ++draw) {
    const double at = random.uniform(0.0, 1.5), width = random.log_uniform(1e-4, 0.1);
    const EnclosedSlope over = function({Enclosure(at, at + width), Enclosure(1.0)});
    const auto value = [](double x) {
      return (x == 0.0 ? 1.0 : std::sin(x) / x) * std::cos(x * x) / (2.0 + std::sin(x)) - x;
    };
    for (int k = 0; k < 20; ++k) {
      const double x = at + width * random.unit(), y = at + width * random.unit();
      EXPECT_TRUE(over.value.lower() - 1e-15 <= value(x) && value(x) <= over.value.upper() + 1e-15);
      if (std::abs(y - x) < 1e-3 * width) continue;
      const double rate = (value(y) - value(x)) / (y - x), rounding = 1e-14 / std::abs(y - x);
      EXPECT_TRUE(over.slope.lower() - rounding <= rate && rate <= over.slope.upper() + rounding);
    }
  }
}

TEST(ProvedFamily, HalvesOfABoxShareAFaceAndLeaveNothingOut) {
  const ParameterBox<2> box{{1.0, -3.0}, {2.0, 5.0}};
  const auto halves = detail::halves_of(box, 1);
  ASSERT_EQ(halves.size(), 2U);
  EXPECT_EQ(halves[0].lowest, box.lowest);
  EXPECT_EQ(halves[0].highest[1], halves[1].lowest[1]);
  EXPECT_EQ(halves[0].highest[1], box.middle()[1]);
  EXPECT_EQ(halves[1].highest, box.highest);
}

TEST(ProvedFamily, RefusesBoxesThatHoldNoLoops) {
  const TwoMassFamily::Parameters<double> x = TwoMassFamily::of(paper_point);
  // The last two: a delay longer than a sample, and ends that are exchanged.
  for (const auto& [k, lowest, highest] :
       {std::tuple{0U, -1.0, 1.0}, {6U, 0.0, 1.0}, {7U, 0.0, 0.002}, {9U, 1.0, 0.0}}) {
    TwoMassFamily::Box box{x, x};
    box.lowest[k] = lowest;
    box.highest[k] = highest;
    EXPECT_THROW(prove_family(TwoMassFamily(), box, {10}, [] {}), InvalidParameter) << k;
  }
}

}  // namespace
}  // namespace holdfast
