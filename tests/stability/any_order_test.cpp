// Charts, intervals and boundaries of loops of any order, by transfer functions on the unit circle:
// against the closed forms of the two masses and against the eigenvalues of the loop's map.

#include "holdfast/control/loop_map.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/stability/boundary/circle_boundary.hpp"
#include "holdfast/stability/boundary/circle_crossings.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/chart/circle_chart.hpp"
#include "support/dense_routes.hpp"
#include "support/lagging_plant.hpp"
#include "support/polynomial/pair_gains.hpp"
#include "support/random_loop.hpp"
#include "support/same_intervals.hpp"

namespace holdfast::test {
namespace {

using Complex = std::complex<double>;

double radius(const LoopMap<double>& map, const PdGains<double>& gains) {
  return spectral_radius(map.closed_map(gains));
}

TEST(AnyOrder, IntervalsOfTwoMassesAreTheClosedForms) {
  Random random(20261);
  int compared = 0;
  for (int draw = 0; draw < 300; ++draw) {
    const TwoMass<double> plant = random_plant(random);
    const Sampling<double> sampling = random_sampling(plant, random);
    const PdGains<double> gains = random_gains(plant, sampling.period, random);
    const auto polynomial = characteristic_polynomial(sampled_loop(plant, sampling));
    compared += expect_same_intervals(
        stable_gains(loop_map(plant, sampling), FreeGain::differential, gains),
        stable_differential_gains(polynomial, gains.proportional), 1e-8);
  }
  EXPECT_GT(compared, 150);
}

TEST(AnyOrder, ProportionalIntervalsOfTwoMassesAreTheClosedForms) {
  const TwoMass<double> plant = kollar2022_plant();
  for (const double period : {0.001, 0.003, 0.01}) {
    const Sampling<double> sampling{period, 0.3 * period};
    const auto polynomial = characteristic_polynomial(sampled_loop(plant, sampling));
    const auto closed = stable_proportional_gains(polynomial, -8.0);
    EXPECT_EQ(expect_same_intervals(
                  stable_gains(loop_map(plant, sampling), FreeGain::proportional, {0.0, -8.0}),
                  closed, 5e-11),
              static_cast<int>(closed.size()));
  }
}

TEST(AnyOrder, EndsOfIntervalsLieOnTheCircleAndTheirInsideWithin) {
  Random random(20262);
  int ends = 0;
  for (int draw = 0; draw < 60; ++draw) {
    const TwoMass<double> masses = random_plant(random);
    Sampling<double> sampling = random_sampling(masses, random);
    if (draw % 3 == 2) sampling.processing_delay = sampling.period * random.uniform(1.0, 4.0);
    const auto plant =
        lagging_plant(5.0 * (0.2 / sampling.period), 8.0 * (0.2 / sampling.period), masses);
    const LoopMap<double> map = loop_map(plant, sampling);
    const PdGains<double> gains = random_gains(masses, sampling.period, random);
    const PdGains<double> held{0.1 * gains.proportional, 0.0};
    for (const auto& interval : stable_gains(map, FreeGain::differential, held)) {
      for (const double d : {interval.lower, interval.upper}) {
        if (!std::isfinite(d)) continue;
        EXPECT_NEAR(radius(map, {held.proportional, d}), 1.0, 1e-7) << draw;
        ++ends;
      }
      if (!std::isfinite(interval.upper - interval.lower)) continue;
      const double width = interval.upper - interval.lower;
      if (width < 1e-6 * std::abs(interval.upper)) continue;
      for (const double share : {0.01, 0.5, 0.99})
        EXPECT_LT(radius(map, {held.proportional, interval.lower + share * width}), 1.0) << draw;
      for (const double beyond : {interval.lower - 1e-3 * width, interval.upper + 1e-3 * width})
        EXPECT_GT(radius(map, {held.proportional, beyond}), 1.0 - 1e-9) << draw;
    }
  }
  EXPECT_GT(ends, 60);
}

TEST(AnyOrder, ChartIsThatOfTheEigenvalues) {
  const auto plant = lagging_plant(40.0, 64.0);
  for (const double delay : {0.0, 0.0004, 0.0027}) {
    const LoopMap<double> map = loop_map(plant, {0.001, delay});
    const GainGrid grid{{-600.0, 100.0, 36}, {-30.0, 10.0, 41}};
    const UnitCircleCrossings<double> circle({plant, {0.001, delay}});
    const std::vector<std::uint8_t> chart = stability_chart(circle, grid);
    int stable = 0;
    for (std::int64_t i = 0; i < grid.proportional.count; ++i) {
      for (std::int64_t j = 0; j < grid.differential.count; ++j) {
        const double excess = radius(map, grid.at(i, j)) - 1.0;
        const bool inside = chart[static_cast<std::size_t>(i * grid.differential.count + j)] == 1;
        stable += inside ? 1 : 0;
        if (std::abs(excess) > 1e-9) {
          EXPECT_EQ(inside, excess < 0.0) << i << ' ' << j;
        }
      }
    }
    EXPECT_GT(stable, 50);
  }
}

/// G_z and G_v at λ = e^{iθ}, by a dense solution.
CommandResponse<double> dense_response(const LoopMap<double>& map, double angle) {
  Eigen::MatrixXcd matrix = -map.open_map.cast<Complex>();
  matrix.diagonal().array() += std::polar(1.0, angle);
  const Eigen::VectorXcd x = solution_of(matrix, map.command.cast<Complex>());
  return {(map.displacement.cast<Complex>() * x).value(),
          (map.velocity.cast<Complex>() * x).value()};
}

TEST(AnyOrder, ResponseIsThatOfTheDenseResolvent) {
  const auto plant = lagging_plant(50.0, 80.0);
  const LoopMap<double> map = loop_map(plant, {0.002, 0.0051});
  EXPECT_EQ(map.held_commands, 3);
  const LoopResponse<double> response(map);
  for (const double angle : {1e-3, 0.1, 0.7, 2.0, 3.1, pi<double>}) {
    const CommandResponse<double> g = response.at_angle(angle);
    const auto [z, v] = dense_response(map, angle);
    EXPECT_LT(std::abs(g.displacement - z), 1e-10 * std::abs(z)) << angle;
    // At low frequencies the absorber's force hardly moves the conductor: G_v is a small
    // difference.
    EXPECT_LT(std::abs(g.velocity - v), 1e-10 * std::abs(v) + 1e-14) << angle;
  }
}

TEST(AnyOrder, BoundaryPointsHaveARootOnTheCircle) {
  const auto plant = lagging_plant(40.0, 64.0);
  const LoopMap<double> map = loop_map(plant, {0.002, 0.003});
  const auto points =
      stability_boundary(ModalResponse<double>(plant, {0.002, 0.003}), {-1000.0, 200.0});
  int pairs = 0;
  for (const BoundaryPoint<double>& point : points) {
    EXPECT_GE(point.gains.proportional, -1000.0);
    EXPECT_LE(point.gains.proportional, 200.0);
    if (!std::isfinite(point.gains.differential)) continue;
    // 1 − P G_z − D G_v = 0 at the point's own λ, by a dense solution.
    const auto g = dense_response(map, point.angle);
    const Complex z = point.gains.proportional * g.displacement;
    const Complex v = point.gains.differential * g.velocity;
    EXPECT_LT(std::abs(1.0 - z - v), 1e-7 * (1.0 + std::abs(z) + std::abs(v))) << point.angle;
    pairs += point.curve == BoundaryCurve::complex_pair ? 1 : 0;
  }
  EXPECT_GT(pairs, 100);
}

TEST(AnyOrder, DelaysOfManySamplesAreCommandsOnTheirWay) {
  // A delay of two whole samples is the map of no delay with two commands in between.
  const TwoMass<double> plant = kollar2022_plant();
  const LoopMap<double> none = loop_map(plant, {0.004, 0.0});
  const LoopMap<double> two = loop_map(plant, {0.004, 0.008});
  EXPECT_EQ(none.held_commands, 1);
  EXPECT_EQ(two.held_commands, 2);
  const LoopResponse<double> at_once(none), late(two);
  for (const double angle : {0.05, 0.9, 2.2}) {
    const Complex turned = std::polar(1.0, -2.0 * angle);
    EXPECT_LT(std::abs(late.at_angle(angle).velocity - turned * at_once.at_angle(angle).velocity),
              1e-12);
  }
}

TEST(LinearPlant, FilterAndDriveMultiplyTheTransferFunction) {
  const TwoMass<double> masses = kollar2022_plant();
  const double filter = 20.0, drive = 30.0, damping = 0.6;
  const auto plant =
      with_drive_lag(with_measurement_filter(through_ports(masses), filter), drive, damping);
  for (const Complex s : {Complex(0.0, 5.0), Complex(-1.0, 60.0), Complex(2.0, 200.0)}) {
    const auto transfer = [&s](const auto& of, const auto& row) {
      Eigen::MatrixXcd matrix = -of.state_matrix().template cast<Complex>();
      matrix.diagonal().array() += s;
      const Eigen::VectorXcd x =
          test::solution_of(matrix, of.control_input().template cast<Complex>());
      return (row.template cast<Complex>() * x).value();
    };
    const Complex ideal = transfer(masses, RowVector<double, 4>::Unit(0));
    const double f = 2.0 * pi<double> * filter, d = 2.0 * pi<double> * drive;
    const Complex expected = ideal * f / (s + f) * d * d / (s * s + 2.0 * damping * d * s + d * d);
    const Complex z = transfer(plant, plant.ports().measured_displacement);
    const Complex v = transfer(plant, plant.ports().measured_velocity);
    EXPECT_LT(std::abs(z - expected), 1e-12 * std::abs(expected));
    EXPECT_LT(std::abs(v - s * expected), 1e-12 * std::abs(s * expected));
  }
}

TEST(LinearPlant, RefusesWhatNoLoopCanBeClosedOn) {
  auto plant = through_ports(kollar2022_plant());
  EXPECT_NO_THROW(validate(plant));
  EXPECT_THROW(with_drive_lag(plant, 10.0, 0.0), InvalidParameter);
  EXPECT_THROW(loop_map(plant, {0.0, 0.0}), InvalidParameter);
  plant.force_input.setZero();
  EXPECT_THROW(validate(plant), InvalidParameter);
}

}  // namespace
}  // namespace holdfast::test
