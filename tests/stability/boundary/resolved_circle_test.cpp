// Passages and root counts of loops of any order on the resolved circle: against the pencil of
// circle_crossings, against the eigenvalues of the loop's map, and against values computed apart.

#include "holdfast/stability/boundary/resolved_circle.hpp"

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/stability/boundary/circle_crossings.hpp"
#include "support/lagging_plant.hpp"
#include "support/random.hpp"
#include "support/random_loop.hpp"
#include "support/testing.hpp"

namespace holdfast::test {
namespace {

LinearPlant<double> paper_string(int modes, double clamp_mass) {
  return modal_plant<double>(string_modes(taut_string(kollar2022_conductor()), 0.64, modes),
                             {0.16, 74.4, 4.0, clamp_mass});
}

/// A span, an absorber tuned near one of its modes, a computer about as fast as they need.
struct RandomSpan {
  LinearPlant<double> plant;
  Sampling<double> sampling;
  double stiffness, resistance;  // of the absorber; of absorber and waves
};

RandomSpan random_span(Random& random, int most_modes) {
  const TautString<double> string{random.log_uniform(10.0, 1e5), random.log_uniform(0.02, 3.0),
                                  random.log_uniform(2.0, 300.0), random.log_uniform(1e-4, 0.05)};
  const double omega = string.angular_frequency(1 + static_cast<int>(random.index(5)));
  Absorber<double> absorber{random.log_uniform(0.05, 10.0), 0.0, 0.0};
  absorber.stiffness = absorber.mass * omega * omega;
  absorber.damping = random.uniform(0.0, 0.4) * absorber.mass * omega;
  if (random.unit() < 0.7) absorber.clamp_mass = random.uniform(0.0, 0.2) * absorber.mass;
  const int modes = 1 + static_cast<int>(random.index(static_cast<std::size_t>(most_modes)));
  const double period = random.log_uniform(0.02, 1.0) / omega;
  return {
      modal_plant(string_modes(string, string.span * random.uniform(0.02, 0.45), modes), absorber),
      {period, period * random.uniform(0.0, 2.5)},
      absorber.stiffness,
      absorber.damping + string.wave_impedance()};
}

/// Stable D of the paper's conductor as a taut string, by eigenvalues of the augmented map in
/// another program.
TEST(ResolvedCircle, StableGainsOfThePapersString) {
  struct Row {
    int modes;
    double clamp_mass, period, delay, proportional, from, to;
  };
  for (const Row& row : {Row{10, 0.0, 0.003, 0.0, -557.0, -18.620243931, 3.944717701},
                         Row{40, 0.010, 0.001, 0.0, -557.0, -33.050641432, 4.563099517},
                         Row{40, 0.010, 0.003, 0.003, -557.0, -7.339352696, 3.300516682},
                         Row{40, 0.020, 0.005, 0.0, 0.0, -1.565813520, 4.926156571}}) {
    const ResolvedCircle<double> circle(
        {paper_string(row.modes, row.clamp_mass), {row.period, row.delay}});
    const auto stable = circle.stable_gains(FreeGain::differential, {row.proportional, 0.0});
    ASSERT_EQ(stable.size(), 1U);
    EXPECT_NEAR(stable[0].lower, row.from, 1e-8);
    EXPECT_NEAR(stable[0].upper, row.to, 1e-8);
  }
}

TEST(ResolvedCircle, EveryCellIsThatOfTheEigenvalues) {
  Random random(253);
  int stable_cells = 0, unstable_cells = 0;
  for (int draw = 0; draw < 20; ++draw) {
    const RandomSpan span = random_span(random, 20);
    const ResolvedCircle<double> circle({span.plant, span.sampling});
    const LoopMap<double> map = loop_map(span.plant, span.sampling);
    for (int row = 0; row < 10; ++row) {
      const double p = random.uniform(-2.0, 1.0) * span.stiffness;
      const auto stable = circle.stable_gains(FreeGain::differential, {p, 0.0});
      for (int cell = 0; cell < 10; ++cell) {
        const double share = random.unit();
        const PdGains<double> gains{p, random.uniform(-3.0, 1.0) * share * share * span.resistance};
        const double radius = spectral_radius(map.closed_map(gains));
        if (std::abs(radius - 1.0) < 1e-9) continue;
        const bool inside = std::any_of(stable.begin(), stable.end(), [&](const auto& interval) {
          return interval.contains(gains.differential);
        });
        EXPECT_EQ(inside, radius < 1.0) << draw << ' ' << p << ' ' << gains.differential;
        (inside ? stable_cells : unstable_cells) += 1;
      }
    }
  }
  EXPECT_GT(stable_cells, 100);
  EXPECT_GT(unstable_cells, 100);
}

TEST(ResolvedCircle, CountsTheRootsThatTheMapHasOutside) {
  Random random(254);
  for (int draw = 0; draw < 60; ++draw) {
    const RandomSpan span = random_span(random, 12);
    const ResolvedCircle<double> circle({span.plant, span.sampling});
    const LoopMap<double> map = loop_map(span.plant, span.sampling);
    const PdGains<double> gains{random.uniform(-3.0, 2.0) * span.stiffness,
                                random.uniform(-4.0, 3.0) * span.resistance};
    const auto roots = detail::balanced_eigenvalues(map.closed_map(gains));
    int outside = 0;
    bool near_circle = false;
    for (const auto& root : roots) {
      outside += std::abs(root) > 1.0 ? 1 : 0;
      near_circle = near_circle || std::abs(std::abs(root) - 1.0) < 1e-9;
    }
    if (near_circle) continue;
    EXPECT_EQ(circle.roots_outside(gains), outside) << draw;
  }
}

/// Of either gain, and of loops with delays, filters and lags.
TEST(ResolvedCircle, IntervalsAreThoseOfThePencil) {
  Random random(255);
  int compared = 0;
  for (int draw = 0; draw < 100; ++draw) {
    const RandomSpan span = random_span(random, 6);
    const bool lagging = draw % 2 == 0;
    const LinearPlant<double> plant =
        lagging ? with_drive_lag(with_measurement_filter(span.plant, 0.2 / span.sampling.period),
                                 0.3 / span.sampling.period, 0.7)
                : span.plant;
    const FreeGain free = draw % 3 == 0 ? FreeGain::proportional : FreeGain::differential;
    const PdGains<double> held{random.uniform(-2.0, 1.0) * span.stiffness,
                               random.uniform(-1.0, 0.0) * span.resistance};
    const auto found = ResolvedCircle<double>({plant, span.sampling}).stable_gains(free, held);
    const auto expected = stable_gains(loop_map(plant, span.sampling), free, held);
    const auto reach = [](const auto& intervals) {
      double sum = 0.0;
      for (const auto& interval : intervals)
        if (std::isfinite(interval.upper - interval.lower)) sum += interval.upper - interval.lower;
      return sum;
    };
    if (found.size() != expected.size()) {
      // Only what round-off can hardly see may make a difference.
      EXPECT_NEAR(reach(found), reach(expected), 1e-6 * reach(expected)) << draw;
      continue;
    }
    for (std::size_t k = 0; k < found.size(); ++k) {
      const double size = std::abs(expected[k].lower) + std::abs(expected[k].upper);
      EXPECT_NEAR(found[k].lower, expected[k].lower, 1e-7 * size) << draw;
      EXPECT_NEAR(found[k].upper, expected[k].upper, 1e-7 * size) << draw;
      ++compared;
    }
  }
  EXPECT_GT(compared, 60);
}

/// Two hundred modes, where no polynomial has a digit left: stable just inside, unstable just
/// outside, by the eigenvalues of a map of 403 rows.
TEST(ResolvedCircle, HoldsAtFourHundredStates) {
  const LinearPlant<double> plant = paper_string(200, 0.010);
  const Sampling<double> sampling{0.003, 0.0};
  const auto stable =
      ResolvedCircle<double>({plant, sampling}).stable_gains(FreeGain::differential, {-557.0, 0.0});
  ASSERT_EQ(stable.size(), 1U);
  const LoopMap<double> map = loop_map(plant, sampling);
  const double lower = stable[0].lower;
  EXPECT_LT(spectral_radius(map.closed_map({-557.0, lower * (1.0 - 1e-6)})), 1.0);
  EXPECT_GT(spectral_radius(map.closed_map({-557.0, lower * (1.0 + 1e-6)})), 1.0);
}

}  // namespace
}  // namespace holdfast::test
