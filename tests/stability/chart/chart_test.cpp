#include "holdfast/stability/chart/chart.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/stability/boundary/boundary_curves.hpp"
#include "holdfast/stability/chart/loop_chart_rows.hpp"
#include "holdfast/stability/polynomial/loop_polynomial.hpp"

#include "support/random.hpp"
#include "support/random_loop.hpp"

namespace holdfast {
namespace {

const GainGrid chart_grid{{-900.0, 100.0, 26}, {-40.0, 10.0, 51}};

HalfPlanePolynomial<double, 5> half_plane_polynomial(const TwoMass<double>& plant,
                                                     const Sampling<double>& sampling) {
  return in_half_plane(characteristic_polynomial(sampled_loop(plant, sampling)));
}

int count_stable(const std::vector<std::uint8_t>& chart) {
  int stable = 0;
  for (const std::uint8_t cell : chart) stable += cell;
  return stable;
}

template <class Loop, class = void>
struct IsCharted : std::false_type {};
template <class Loop>
struct IsCharted<Loop,
                 std::void_t<decltype(stability_chart(std::declval<const Loop&>(), chart_grid))>>
    : std::true_type {};

// About a centre that the type does not tell there is no chart, nor are there rows of what lies in
// another plane; a change of variable says which it leads to.
using AboutCentre = decltype(LoopPolynomial<double>::polynomial);
using InHalfPlane = HalfPlanePolynomial<double, 5>;
using AboutOne = AffinePolynomial<double, 5>;
static_assert(IsCharted<AboutOne>::value && IsCharted<InHalfPlane>::value &&
              IsCharted<AffinePolynomial<double, 4>>::value && !IsCharted<AboutCentre>::value);
static_assert(std::is_constructible_v<StabilityRows<5>, InHalfPlane, Axis> &&
              !std::is_constructible_v<StabilityRows<5>, AboutOne, Axis> &&
              !std::is_constructible_v<StabilityRows<5>, AboutCentre, Axis>);
static_assert(std::is_constructible_v<RootPairCurve<double>, InHalfPlane> &&
              !std::is_constructible_v<RootPairCurve<double>, AboutOne>);
static_assert(std::is_constructible_v<BoundaryCurves<double, 5>, AboutOne> &&
              !std::is_constructible_v<BoundaryCurves<double, 5>, InHalfPlane> &&
              !std::is_constructible_v<BoundaryCurves<double, 5>, AboutCentre>);

/// The polynomial as it comes from the loop, and the one that was taken to the half-plane.
TEST(Chart, OfEitherPolynomialOfTheLoopIsTheSpectralRadius) {
  for (const double delay : {0.0, 0.004, 0.01}) {
    const auto loop = sampled_loop(kollar2022_plant(), Sampling<double>{0.01, delay});
    const auto polynomial = characteristic_polynomial(loop);
    const auto chart = stability_chart(polynomial, chart_grid);
    EXPECT_EQ(chart, stability_chart(in_half_plane(polynomial), chart_grid));
    EXPECT_EQ(chart, stability_chart(in_half_plane(in_half_plane(polynomial)), chart_grid));
    for (std::int64_t k = 0; k < chart_grid.cells(); ++k) {
      const double radius =
          spectral_radius<double, 5>(loop.engaged_map(chart_grid.at(k / 51, k % 51)));
      EXPECT_EQ(chart[static_cast<std::size_t>(k)] == 1, radius < 1.0) << k << ' ' << delay;
    }
    EXPECT_GT(count_stable(chart), 100);
    EXPECT_LT(count_stable(chart), 26 * 51 - 100);
  }
}

TEST(Chart, IsTheSpectralAbscissaOfTheContinuousLoopCellByCell) {
  const auto plant = kollar2022_plant();
  const auto chart = stability_chart(characteristic_polynomial(plant), chart_grid);
  for (std::int64_t k = 0; k < chart_grid.cells(); ++k) {
    const Matrix<double, 4> closed =
        plant.state_matrix() + plant.control_input() * chart_grid.at(k / 51, k % 51).feedback_row();
    EXPECT_EQ(chart[static_cast<std::size_t>(k)] == 1, (spectral_abscissa<double, 4>(closed) < 0.0))
        << k;
  }
  EXPECT_GT(count_stable(chart), 100);
  EXPECT_LT(count_stable(chart), 26 * 51 - 100);
}

TEST(Chart, RowsDoNotDependOnTheRowsBefore) {
  const auto polynomial = half_plane_polynomial(kollar2022_plant(), {0.01, 0.004});
  const auto chart = stability_chart(polynomial, chart_grid);
  for (std::int64_t i = chart_grid.proportional.count - 1; i >= 0; i -= 5) {
    StabilityRows<5> rows(polynomial, chart_grid.differential);
    std::vector<std::uint8_t> row(51);
    rows.fill(chart_grid.proportional.at(i), row.data());
    EXPECT_TRUE(std::equal(row.begin(), row.end(), chart.begin() + i * 51)) << i;
  }
}

/// A chart of 20 × 50 cells about the origin, as wide as sampling lets gains be; each of its rows
/// spans the boundary.
GainGrid random_grid(const TwoMass<double>& plant, double period, test::Random& random) {
  const double mass =
      plant.conductor_mass * plant.absorber_mass / (plant.conductor_mass + plant.absorber_mass);
  const double p = random.log_uniform(1e-3, 1.0) * mass / (period * period);
  const double d = random.log_uniform(1e-2, 2.0) * mass / period;
  return {{-p, p * random.unit(), 20}, {-d, d * random.unit(), 50}};
}

/// A million cells, each row from its crossings, against the conditions in extended precision on a
/// polynomial that is built in extended precision.
TEST(Chart, AgreesWithExtendedPrecisionOnAMillionRandomCells) {
  test::Random random(20260401);
  std::int64_t cells = 0, differ = 0, close = 0;
  for (int draw = 0; draw < 1000; ++draw) {
    const auto plant = test::random_plant(random);
    const auto sampling = test::random_sampling(plant, random);
    const GainGrid grid = random_grid(plant, sampling.period, random);
    const auto chart = stability_chart(half_plane_polynomial(plant, sampling), grid);
    const auto precise = characteristic_polynomial(test::precise_loop(plant, sampling));
    const auto q = in_half_plane(precise);
    for (std::int64_t k = 0; k < grid.cells(); ++k) {
      const auto gains = grid.at(k / 50, k % 50);
      const bool stable =
          is_hurwitz<long double, 6>(q.at({gains.proportional, gains.differential}));
      ++cells;
      if (stable == (chart[static_cast<std::size_t>(k)] == 1)) continue;
      ++differ;
      if (std::abs(test::growth(plant, sampling, gains).excess) <= 1e-9) ++close;
    }
  }
  RecordProperty("differ", static_cast<int>(differ));
  EXPECT_EQ(cells, 1000000);
  EXPECT_EQ(differ, close) << "cells that differ further than 1e-9 from the boundary";
  EXPECT_LT(differ, 20);
}

/// (s² + bs + c)(s² ± (D − d)s + e + P): at every P > −e a pair is on the axis exactly where D = d.
TEST(Chart, ACellOnTheBoundaryIsNotStable) {
  test::Random random(20260405);
  for (int draw = 0; draw < 1000; ++draw) {
    const double side = random.sign(), d = random.uniform(-10.0, 10.0);
    const double e = random.uniform(0.1, 10.0), p = random.uniform(0.1, 10.0);
    const Vector<double, 3> rest{random.uniform(0.1, 10.0), random.uniform(0.1, 10.0), 1.0};
    const auto times_rest = [&rest](double constant, double linear, double square) {
      return multiply<double, 3, 3>(rest, {constant, linear, square});
    };
    const AffinePolynomial<double, 4> polynomial{
        times_rest(e, -side * d, 1.0), times_rest(1.0, 0.0, 0.0), times_rest(0.0, side, 0.0)};
    const auto cell = [&](double differential_gain) {
      return stability_chart(polynomial, {{p, p, 1}, {differential_gain, differential_gain, 1}})[0];
    };
    EXPECT_EQ(cell(d), 0) << draw;
    EXPECT_EQ(cell(d + 1e-6 * side), 1) << draw;
    EXPECT_EQ(cell(d - 1e-6 * side), 0) << draw;
  }
}

TEST(Chart, OneCellAndOneColumnAreCharts) {
  const auto polynomial = half_plane_polynomial(kollar2022_plant(), {0.001});
  EXPECT_EQ(stability_chart(polynomial, {{-557, -557, 1}, {-13, -13, 1}}),
            std::vector<std::uint8_t>{1});
  EXPECT_EQ(stability_chart(polynomial, {{-557, 100, 2}, {-60, -60, 1}}),
            (std::vector<std::uint8_t>{0, 0}));
}

TEST(Chart, GainsOfAnySizeHaveAnAnswer) {
  const auto polynomial = half_plane_polynomial(kollar2022_plant(), {0.001});
  const std::vector<std::uint8_t> unstable(15, 0);
  for (const double huge : {1e20, 1e100, 1e200}) {
    auto chart = stability_chart(polynomial, {{-huge, huge, 3}, {-huge, huge, 5}});
    EXPECT_EQ(chart[7], 1) << "P = D = 0 amid gains of " << huge;
    chart[7] = 0;
    EXPECT_EQ(chart, unstable) << huge;
  }
}

/// Without damping and without control every root sits on the boundary: such a loop is not
/// asymptotically stable, and round-off may not say otherwise.
TEST(Chart, TheUndampedUncontrolledLoopIsNotStable) {
  TwoMass<double> plant = kollar2022_plant();
  plant.conductor_damping = plant.absorber_damping = 0.0;
  for (const double period : {1e-4, 1e-3, 0.01, 0.03}) {
    for (const double fraction : {0.0, 0.3, 1.0}) {
      const auto polynomial = half_plane_polynomial(plant, {period, fraction * period});
      EXPECT_EQ(stability_chart(polynomial, {{0, 0, 1}, {0, 0, 1}})[0], 0)
          << period << ' ' << fraction;
    }
  }
  EXPECT_EQ(stability_chart(characteristic_polynomial(plant), {{0, 0, 1}, {0, 0, 1}})[0], 0);
}

/// Sampling so slow that nothing is left of the motion from one sample to the next: every root is 0
/// for any gains, since a force moves the conductor's equilibrium nowhere.
TEST(Chart, AForgottenMotionIsStableForAnyGains) {
  const auto chart =
      stability_chart(half_plane_polynomial(kollar2022_plant(), {1e4, 5e3}), chart_grid);
  EXPECT_EQ(count_stable(chart), 26 * 51);
}

TEST(HurwitzRow, IsTheTestOfEachCell) {
  test::Random random(11);
  int stable_cells = 0;
  for (int draw = 0; draw < 300; ++draw) {
    const double binomial[] = {1, 5, 10, 10, 5, 1};
    Vector<double, 6> constant, slope;
    for (int k = 0; k < 6; ++k) {
      constant[k] = binomial[k] * random.log_uniform(0.7, 1.4);
      slope[k] = binomial[k] * random.uniform(-0.3, 0.3);
    }
    std::vector<double> values;
    for (int j = 0; j < 37; ++j) values.push_back(-3.0 + 6.0 * j / 36.0);
    std::vector<std::uint8_t> stable(37, 2);
    hurwitz_row<double, 6>(constant, slope, values, stable.data());
    Eigen::Matrix<double, Eigen::Dynamic, 6> table(37, 6);
    for (int j = 0; j < 37; ++j) table.row(j) = constant + values[std::size_t(j)] * slope;
    std::vector<std::uint8_t> from_table(37, 2);
    hurwitz_row<double, 6>(table, from_table.data());
    for (std::size_t j = 0; j < 37; ++j) {
      const Vector<double, 6> polynomial = constant + values[j] * slope;
      EXPECT_EQ(stable[j], (is_hurwitz<double, 6>(polynomial) ? 1 : 0)) << draw << ' ' << j;
      EXPECT_EQ(from_table[j], stable[j]) << draw << ' ' << j;
      stable_cells += stable[j];
    }
  }
  EXPECT_GT(stable_cells, 500);
}

/// (w + 1)⁵ + x w: stable about x = 0 however far the row reaches.
TEST(HurwitzRow, CellsNearZeroAmidHugeOnesHaveTheirAnswer) {
  const Vector<double, 6> constant{1, 5, 10, 10, 5, 1}, slope{0, 1, 0, 0, 0, 0};
  for (const double huge : {1e10, 1e70, 1e150, 1e290}) {
    std::vector<std::uint8_t> stable(5);
    hurwitz_row<double, 6>(constant, slope, {-huge, -huge / 2, 0.0, 0.5, huge}, stable.data());
    EXPECT_EQ(stable, (std::vector<std::uint8_t>{0, 0, 1, 1, 0})) << huge;
  }
}

}  // namespace
}  // namespace holdfast
