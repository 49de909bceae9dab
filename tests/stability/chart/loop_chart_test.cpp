#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/chart/loop_chart_rows.hpp"

#include "holdfast/math/linalg/spectral_radius.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

using Parameter = LoopParameter;

const OperatingPoint chart_point{kollar2022_plant(), {0.005, 0.002}, {-557.0, -13.0}};
const LoopAxis axis_p{Parameter::proportional_gain, {-1000.0, 200.0, 11}};
const LoopAxis axis_d{Parameter::differential_gain, {-40.0, 20.0, 13}};
const LoopAxis axis_period{Parameter::sampling_period, {0.0005, 0.03, 12}};
const LoopAxis axis_delay{Parameter::processing_delay, {0.0, 0.005, 7}};
const LoopAxis axis_mass{Parameter::absorber_mass, {0.05, 0.5, 9}};
const LoopAxis axis_damping{Parameter::conductor_damping, {0.0, 2.0, 9}};

double radius_at(const OperatingPoint& point) {
  return spectral_radius<double, 5>(
      sampled_loop(point.plant, point.sampling).engaged_map(point.gains));
}

/// Stability and radius of every cell against the eigenvalues of S of that cell's loop.
void expect_cell_by_cell(const LoopChart& chart) {
  StabilityChartRows<double> stability(chart);
  RadiusChartRows<double, 6> radius(chart);
  const auto columns = static_cast<std::size_t>(chart.fast.values.count);
  for (std::int64_t row = 0; row < chart.slow.values.count; ++row) {
    std::vector<std::uint8_t> stable(columns);
    std::vector<double> radii(columns);
    stability.fill(row, 1, stable.data());
    radius.fill(row, 1, radii.data());
    for (std::size_t column = 0; column < columns; ++column) {
      const double rho = radius_at(chart.cell(row, static_cast<std::int64_t>(column)));
      EXPECT_NEAR(radii[column], rho, 1e-10) << row << ' ' << column;
      EXPECT_EQ(stable[column] == 1, rho < 1.0) << row << ' ' << column << ' ' << rho;
    }
  }
}

TEST(LoopChart, OverBothGainsInEitherOrder) {
  expect_cell_by_cell({chart_point, axis_p, axis_d});
  expect_cell_by_cell({chart_point, axis_d, axis_p});
}

TEST(LoopChart, OverAGainAndAnotherParameterInEitherOrder) {
  for (const LoopAxis& other : {axis_period, axis_delay, axis_mass, axis_damping}) {
    expect_cell_by_cell({chart_point, other, axis_d});
    expect_cell_by_cell({chart_point, axis_p, other});
  }
}

TEST(LoopChart, OverTwoParametersNeitherOfWhichIsAGain) {
  expect_cell_by_cell({chart_point, axis_period, axis_mass});
  expect_cell_by_cell({chart_point, axis_damping, axis_delay});
}

TEST(LoopChart, ThePeriodTakesTheDelayWithIt) {
  const LoopChart chart{chart_point, axis_period, axis_d};
  EXPECT_DOUBLE_EQ(chart.cell(11, 0).sampling.processing_delay, 0.4 * 0.03);
}

TEST(LoopChart, ADelayOfAWholePeriodStaysOne) {
  OperatingPoint late = chart_point;
  late.sampling = {0.01, 0.01};
  const LoopChart chart{late, {Parameter::sampling_period, {0.0005, 0.02, 997}}, axis_d};
  for (std::int64_t row = 0; row < chart.slow.values.count; ++row) {
    const Sampling<double> sampling = chart.cell(row, 0).sampling;
    EXPECT_EQ(sampling.processing_delay, sampling.period) << row;
  }
}

TEST(LoopChart, AGivenDelayDoesNotScaleWithAGivenPeriod) {
  const LoopAxis delays{Parameter::processing_delay, {0.0, 0.004, 5}};
  const LoopAxis periods{Parameter::sampling_period, {0.005, 0.025, 6}};
  const LoopChart upright{chart_point, delays, periods}, lying{chart_point, periods, delays};
  for (std::int64_t delay = 0; delay < 5; ++delay) {
    for (std::int64_t period = 0; period < 6; ++period) {
      const Sampling<double> sampling = upright.cell(delay, period).sampling;
      EXPECT_EQ(sampling.processing_delay, delays.values.at(delay));
      EXPECT_EQ(sampling.period, periods.values.at(period));
      EXPECT_EQ(lying.cell(period, delay).sampling.processing_delay, delays.values.at(delay));
    }
  }
  expect_cell_by_cell(upright);
  expect_cell_by_cell(lying);
}

TEST(LoopChart, RefusesWhatIsNoLoop) {
  EXPECT_THROW(validate(LoopChart{chart_point, axis_p, axis_p}), InvalidParameter);
  const LoopAxis beyond{Parameter::processing_delay, {0.0, 0.006, 3}};
  EXPECT_THROW(validate(LoopChart{chart_point, axis_p, beyond}), InvalidParameter);
  const LoopAxis massless{Parameter::conductor_mass, {0.0, 0.1, 3}};
  EXPECT_THROW(validate(LoopChart{chart_point, massless, axis_d}), InvalidParameter);
}

/// All numbers of a loop in the order of LoopParameter.
std::array<double, 10> numbers_of(const OperatingPoint& point) {
  const TwoMass<double>& plant = point.plant;
  return {plant.conductor_mass,    plant.conductor_stiffness,       plant.conductor_damping,
          plant.absorber_mass,     plant.absorber_stiffness,        plant.absorber_damping,
          point.sampling.period,   point.sampling.processing_delay, point.gains.proportional,
          point.gains.differential};
}

TEST(OperatingPoint, AParameterIsSetAndNoOther) {
  for (int k = 0; k < 10; ++k) {
    const auto parameter = static_cast<LoopParameter>(k);
    if (parameter == LoopParameter::sampling_period) continue;
    auto expected = numbers_of(chart_point);
    expected[static_cast<std::size_t>(k)] = 0.0123;
    OperatingPoint point = chart_point;
    set(point, parameter, 0.0123);
    EXPECT_EQ(numbers_of(point), expected) << k;
    EXPECT_EQ(is_gain(parameter), k >= 8) << k;
  }
}

TEST(OperatingPoint, TheDelayKeepsItsFractionOfTheSamplingPeriod) {
  auto expected = numbers_of(chart_point);
  OperatingPoint point = chart_point;
  set(point, LoopParameter::sampling_period, 0.020);
  expected[6] = 0.020;
  expected[7] = 0.008;
  EXPECT_EQ(numbers_of(point), expected);
}

}  // namespace
}  // namespace holdfast
