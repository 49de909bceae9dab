// Passages and root counts of loops of any order on the resolved circle: against the pencil of
// circle_crossings, against the eigenvalues of the loop's map, and against values computed apart.

#include "holdfast/stability/boundary/unit_circle_crossings.hpp"
#include "holdfast/cable/taut_string.hpp"
#include "holdfast/plant/plant_poles.hpp"
#include "holdfast/stability/boundary/circle_crossings.hpp"

#include "support/lagging_plant.hpp"
#include "support/message_of.hpp"
#include "support/random.hpp"
#include "support/same_intervals.hpp"
#include "support/testing.hpp"

namespace holdfast::test {
namespace {

LinearPlant<double> paper_string(int modes, double clamp_mass) {
  return modal_plant<double>(string_modes(taut_string(kollar2022_conductor()), 0.64, modes),
                             {0.16, 74.4, 4.0, clamp_mass});
}

/// What a random loop is drawn from.
struct SpanRange {
  int most_modes = 12;
  double least_damping = 1e-4, largest_damping = 0.05;  // of the modes; both 0: none
  double least_pace = 0.02, largest_pace = 1.0;         // sampling period over that of the absorber
  double largest_delay = 2.5;                           // samples
  bool damped_absorber = true;
};

/// A span, an absorber tuned near one of its modes, its computer.
struct RandomSpan {
  LinearPlant<double> plant;
  Sampling<double> sampling;
  double stiffness, resistance;  // of the absorber; of absorber and waves
};

RandomSpan random_span(Random& random, const SpanRange& range) {
  const double damping = range.largest_damping > 0.0
                             ? random.log_uniform(range.least_damping, range.largest_damping)
                             : 0.0;
  const TautString<double> string{random.log_uniform(10.0, 1e5), random.log_uniform(0.02, 3.0),
                                  random.log_uniform(2.0, 300.0), damping};
  const int modes = 1 + static_cast<int>(random.index(static_cast<std::size_t>(range.most_modes)));
  const double omega = string.angular_frequency(1 + static_cast<int>(random.index(5)) % modes);
  Absorber<double> absorber{random.log_uniform(0.05, 10.0), 0.0, 0.0};
  absorber.stiffness = absorber.mass * omega * omega;
  if (range.damped_absorber) absorber.damping = random.uniform(0.0, 0.4) * absorber.mass * omega;
  if (random.unit() < 0.7) absorber.clamp_mass = random.uniform(0.0, 0.2) * absorber.mass;
  const double period = random.log_uniform(range.least_pace, range.largest_pace) / omega;
  return {
      modal_plant(string_modes(string, string.span * random.uniform(0.02, 0.45), modes), absorber),
      {period, period * random.uniform(0.0, range.largest_delay)},
      absorber.stiffness,
      absorber.damping + string.wave_impedance()};
}

/// Cells of one gain at a held other one, stable and not, against the eigenvalues of the map:
/// within the intervals or not, and the number of roots outside.
struct Compared {
  int stable = 0, unstable = 0;
};

void compare_row(const RandomSpan& span, const UnitCircleCrossings<double>& circle,
                 const LoopMap<double>& map, FreeGain free, Random& random, Compared& compared) {
  const bool by_d = free == FreeGain::differential;
  const PdGains<double> held{random.uniform(-2.0, 1.0) * span.stiffness,
                             random.uniform(-2.0, 0.5) * span.resistance};
  const auto stable = circle.stable_gains(free, held);
  for (int cell = 0; cell < 12; ++cell) {
    const double size = by_d ? span.resistance : span.stiffness;
    const double x = random.sign() * size * random.log_uniform(1e-5, 100.0);
    const PdGains<double> gains =
        by_d ? PdGains<double>{held.proportional, x} : PdGains<double>{x, held.differential};
    int outside = 0;
    double radius = 0.0, nearest = 1.0;
    for (const auto& root : detail::balanced_eigenvalues(map.closed_map(gains))) {
      const double modulus = std::abs(root);
      outside += modulus > 1.0 ? 1 : 0;
      radius = std::max(radius, modulus);
      nearest = std::min(nearest, std::abs(modulus - 1.0));
    }
    const auto holds = [x](const Interval<double>& interval) { return interval.contains(x); };
    const bool inside = std::any_of(stable.begin(), stable.end(), holds);
    if (std::abs(radius - 1.0) > 1e-9) {
      EXPECT_EQ(inside, radius < 1.0) << gains.proportional << ' ' << gains.differential;
      (inside ? compared.stable : compared.unstable) += 1;
    }
    if (nearest > 1e-9) {
      EXPECT_EQ(circle.roots_outside(gains), outside)
          << gains.proportional << ' ' << gains.differential;
    }
  }
}

Compared compare(const SpanRange& range, int draws, std::uint64_t seed) {
  Random random(seed);
  Compared compared;
  for (int draw = 0; draw < draws; ++draw) {
    SCOPED_TRACE(draw);
    const RandomSpan span = random_span(random, range);
    const UnitCircleCrossings<double> circle({span.plant, span.sampling});
    const LoopMap<double> map = loop_map(span.plant, span.sampling);
    for (int row = 0; row < 6; ++row)
      compare_row(span, circle, map, row % 2 == 0 ? FreeGain::differential : FreeGain::proportional,
                  random, compared);
  }
  return compared;
}

/// Stable D of the paper's conductor as a taut string, by eigenvalues of the augmented map in
/// another program.
TEST(UnitCircleCrossings, StableGainsOfThePapersString) {
  struct Row {
    int modes;
    double clamp_mass, period, delay, proportional, from, to;
  };
  for (const Row& row : {Row{10, 0.0, 0.003, 0.0, -557.0, -18.620243931, 3.944717701},
                         Row{40, 0.010, 0.001, 0.0, -557.0, -33.050641432, 4.563099517},
                         Row{40, 0.010, 0.003, 0.003, -557.0, -7.339352696, 3.300516682},
                         Row{40, 0.020, 0.005, 0.0, 0.0, -1.565813520, 4.926156571}}) {
    const UnitCircleCrossings<double> circle(
        {paper_string(row.modes, row.clamp_mass), {row.period, row.delay}});
    const auto stable = circle.stable_gains(FreeGain::differential, {row.proportional, 0.0});
    ASSERT_EQ(stable.size(), 1U);
    EXPECT_NEAR(stable[0].lower, row.from, 1e-8);
    EXPECT_NEAR(stable[0].upper, row.to, 1e-8);
  }
}

TEST(UnitCircleCrossings, CellsAndRootsOutsideAreThoseOfTheEigenvalues) {
  const Compared compared = compare({20}, 20, 253);
  EXPECT_GT(compared.stable, 200);
  EXPECT_GT(compared.unstable, 200);
}

TEST(UnitCircleCrossings, HoldsForFastAndForSlowComputers) {
  EXPECT_GT(compare({8, 1e-4, 0.05, 1e-7, 1e-2}, 15, 254).stable, 50);
  EXPECT_GT(compare({8, 1e-4, 0.05, 3.0, 3000.0}, 15, 255).stable, 50);
}

/// A command that is on its way for k samples turns G by (k − 1) θ.
TEST(UnitCircleCrossings, HoldsForDelaysOfManySamples) {
  EXPECT_GT(compare({4, 1e-3, 0.05, 0.02, 1.0, 30.0}, 15, 256).stable, 50);
  EXPECT_GT(compare({2, 1e-3, 0.05, 0.02, 1.0, 120.0}, 3, 257).unstable, 20);
}

TEST(UnitCircleCrossings, HoldsWhereLittleOrNothingIsDamped) {
  EXPECT_GT(compare({10, 1e-7, 1e-4, 1e-3, 1.0}, 15, 258).stable, 50);
  EXPECT_GT(compare({10, 0.0, 0.0}, 15, 259).stable, 50);
  EXPECT_GT(compare({10, 1e-4, 0.05, 0.02, 1.0, 2.5, false}, 15, 260).stable, 20);
  EXPECT_GT(compare({10, 0.0, 0.0, 0.02, 1.0, 2.5, false}, 15, 261).unstable, 50);
}

/// At λ = 1 neither gain moves the loop, since drive and conductor push each other: the passages
/// that round-off leaves there, at gains of 10¹² and more, are none.
TEST(UnitCircleCrossings, PassagesOfRoundOffAreNone) {
  const LinearPlant<double> plant = modal_plant<double>({{10.0, 1e-4, 1.0, 1.0}}, {0.1, 10.0, 0.4});
  for (const double period : {1e-4, 1e-5, 1e-6}) {
    const UnitCircleCrossings<double> circle({plant, {period}});
    const auto stable = circle.stable_gains(FreeGain::proportional, {0.0, 0.0});
    ASSERT_EQ(stable.size(), 1U) << period;
    EXPECT_TRUE(stable[0].contains(-1.0)) << period;
    EXPECT_LT(circle.passages(FreeGain::proportional, {0.0, 0.0}).size(), 6U) << period;
  }
}

TEST(UnitCircleCrossings, GainsThatAreNoiseEndWithoutACount) {
  const UnitCircleCrossings<double> circle({paper_string(10, 0.010), {0.001}});
  EXPECT_EQ(circle.roots_outside({NAN, 0.0}), -1);
  EXPECT_EQ(circle.roots_outside({0.0, INFINITY}), -1);
  EXPECT_TRUE(circle.stable_gains(FreeGain::differential, {1e200, 0.0}).empty());
  EXPECT_THROW(circle.stable_gains(FreeGain::differential, {NAN, 0.0}), InvalidParameter);
}

/// Of either gain, and of loops with delays, filters and lags.
TEST(UnitCircleCrossings, IntervalsAreThoseOfThePencil) {
  Random random(255);
  int compared = 0;
  for (int draw = 0; draw < 100; ++draw) {
    const RandomSpan span = random_span(random, {6});
    const bool lagging = draw % 2 == 0;
    const LinearPlant<double> plant =
        lagging ? with_drive_lag(with_measurement_filter(span.plant, 0.2 / span.sampling.period),
                                 0.3 / span.sampling.period, 0.7)
                : span.plant;
    const FreeGain free = draw % 3 == 0 ? FreeGain::proportional : FreeGain::differential;
    const PdGains<double> held{random.uniform(-2.0, 1.0) * span.stiffness,
                               random.uniform(-1.0, 0.0) * span.resistance};
    SCOPED_TRACE(draw);
    const auto found = UnitCircleCrossings<double>({plant, span.sampling}).stable_gains(free, held);
    const auto expected = stable_gains(loop_map(plant, span.sampling), free, held);
    compared += expect_same_intervals(found, expected, 1e-7);
  }
  EXPECT_GT(compared, 60);
}

/// A hundred modes, where no polynomial has a digit left: stable just inside, unstable just
/// outside, by the eigenvalues of a map of 203 rows.
TEST(UnitCircleCrossings, HoldsAtTwoHundredStates) {
  const LinearPlant<double> plant = paper_string(100, 0.010);
  const Sampling<double> sampling{0.003, 0.0};
  const auto stable = UnitCircleCrossings<double>({plant, sampling})
                          .stable_gains(FreeGain::differential, {-557.0, 0.0});
  ASSERT_EQ(stable.size(), 1U);
  const LoopMap<double> map = loop_map(plant, sampling);
  const double lower = stable[0].lower;
  EXPECT_LT(spectral_radius(map.closed_map({-557.0, lower * (1.0 - 1e-6)})), 1.0);
  EXPECT_GT(spectral_radius(map.closed_map({-557.0, lower * (1.0 + 1e-6)})), 1.0);
}

// The string without ends: its triangle of stable gains in closed form, its receptance.

constexpr double impedance = 0.67;

/// The force straight on the string.
UnitCircleCrossings<double> circle(double clamp_mass, double period) {
  const PlaceMode<double> mode = infinite_string_mode(impedance, clamp_mass, period);
  const auto [s, partner] = holdfast::detail::PoleFinder::bare(mode);
  const std::complex<double> residue = mode.shape * mode.shape / (mode.mass * (s - partner));
  const std::vector<PlantPole> poles = {{s, residue}, {partner, -residue}};
  return UnitCircleCrossings<double>(modal_response(poles, {period}));
}

/// λ² − (1 + (Pτ + D)/(2 Z_c)) λ + D/(2 Z_c) = 0: stable inside (0, −2Z_c), (0, 2Z_c), (−8Z_c/τ,
/// 2Z_c).
TEST(InfiniteString, StableGainsFormATriangle) {
  constexpr double twice = 2.0 * impedance;
  for (const double period : {1e-3, 0.02}) {
    const UnitCircleCrossings<double> string = circle(0.0, period);
    for (const double share : {0.01, 0.3, 0.7, 0.99}) {
      const double p = -8.0 * impedance / period * share;
      const auto stable = string.stable_gains(FreeGain::differential, {p, 0.0});
      ASSERT_EQ(stable.size(), 1U) << p;
      EXPECT_NEAR(stable[0].lower, -twice - p * period / 2.0, 1e-12 * twice);
      EXPECT_NEAR(stable[0].upper, twice, 1e-12 * twice);
    }
    EXPECT_TRUE(
        string.stable_gains(FreeGain::differential, {-8.1 * impedance / period, 0.0}).empty());
    EXPECT_TRUE(string.stable_gains(FreeGain::differential, {0.01 / period, 0.0}).empty());
  }
}

/// With a clamp mass and P = 0, C = c₂ + 2Z_c: −C coth(Cτ/(2M)) < D < C. A heavy absorber without
/// spring is a wall for the dashpot.
TEST(InfiniteString, AClampMassWidensThem) {
  const double damping = 4.0, c = damping + 2.0 * impedance, period = 1e-3;
  for (const double mass : {1e-4, 0.002, 0.01}) {
    const std::vector<PlaceMode<double>> modes = {infinite_string_mode(impedance, mass, period)};
    const auto poles = plant_poles(modes, {1e9, 1e-6, damping, 0.0});
    ASSERT_FALSE(poles.empty());
    const UnitCircleCrossings<double> string(modal_response(poles, {period}));
    const auto stable = string.stable_gains(FreeGain::differential, {0.0, 0.0});
    ASSERT_FALSE(stable.empty());
    EXPECT_NEAR(stable[0].lower, -c / std::tanh(c * period / (2.0 * mass)), 1e-7 * c) << mass;
    EXPECT_NEAR(stable[0].upper, c, 1e-7 * c) << mass;
  }
}

TEST(InfiniteString, ItsReceptanceIsThatOfTwoWaves) {
  const std::vector<PlaceMode<double>> modes = {infinite_string_mode(impedance, 0.003, 1e-3)};
  for (const double omega : {1.0, 60.0, 3000.0}) {
    const std::complex<double> s(0.0, omega);
    const auto expected = 1.0 / (2.0 * impedance * s + 0.003 * s * s);
    EXPECT_LT(std::abs(receptance(modes, s) / expected - 1.0), 1e-8) << omega;
  }
}

TEST(InfiniteString, RefusesWhatIsNone) {
  const auto message = [](double of_string, double clamp_mass, double period) {
    return tests::message_of<InvalidParameter>(
        [&] { infinite_string_mode(of_string, clamp_mass, period); });
  };
  EXPECT_NE(message(0.0, 0.0, 1e-3).find("wave impedance"), std::string::npos);
  EXPECT_NE(message(1.0, -1.0, 1e-3).find("clamp mass"), std::string::npos);
  EXPECT_NE(message(1.0, 0.0, 0.0).find("sampling period"), std::string::npos);
}

}  // namespace
}  // namespace holdfast::test
