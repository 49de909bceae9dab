#include "holdfast/simd/charts.hpp"

#include "support/random_loop.hpp"

namespace holdfast {
namespace {

using Parameter = LoopParameter;
using NumberPack = simd::Pack<double>;

LoopChart gain_chart(double period, double delay, std::int64_t rows, std::int64_t columns) {
  return {{kollar2022_plant(), {period, delay}, {-557.0, -13.0}},
          {Parameter::proportional_gain, {-1000.0, 200.0, rows}},
          {Parameter::differential_gain, {-40.0, 20.0, columns}}};
}

/// The same kernel on one lane.
std::vector<double> scalar_radius(const LoopChart& chart) {
  RadiusChartRows<double, 6> rows(chart);
  std::vector<double> radius(
      static_cast<std::size_t>(chart.slow.values.count * chart.fast.values.count));
  for (std::int64_t row = 0; row < chart.slow.values.count; ++row) {
    rows.fill(row, 1, radius.data() + row * chart.fast.values.count);
  }
  return radius;
}

std::vector<std::uint8_t> tested(const LoopChart& chart, bool packs) {
  const ChartPolynomials<5, PolynomialVariable::half_plane> polynomials(
      chart, StabilityChartRows<>::polynomial_of);
  std::vector<double> values;
  for (std::int64_t j = 0; j < polynomials.columns(); ++j)
    values.push_back(chart.fast.values.at(j));
  std::vector<std::uint8_t> stable(
      static_cast<std::size_t>(chart.slow.values.count * polynomials.columns()));
  for (std::int64_t row = 0; row < chart.slow.values.count; ++row) {
    const auto line = polynomials.line(row);
    std::uint8_t* cells = stable.data() + row * polynomials.columns();
    if (packs) {
      hurwitz_row<NumberPack, 6>(line.constant, line.slope, values, cells);
    } else {
      hurwitz_row<double, 6>(line.constant, line.slope, values, cells);
    }
  }
  return stable;
}

TEST(Pack, StoresItsMaskAsBytes) {
  constexpr std::size_t lanes = Lanes<NumberPack>::count;
  for (std::size_t pattern = 0; pattern < (std::size_t{1} << lanes); ++pattern) {
    double values[lanes];
    for (std::size_t lane = 0; lane < lanes; ++lane) values[lane] = (pattern >> lane) & 1U ? 1 : -1;
    std::uint8_t flags[lanes + 1];
    flags[lanes] = 77;
    Lanes<NumberPack>::store_flags(Lanes<NumberPack>::load(values) > NumberPack(0.0), flags);
    for (std::size_t lane = 0; lane < lanes; ++lane) EXPECT_EQ(flags[lane], (pattern >> lane) & 1U);
    EXPECT_EQ(flags[lanes], 77) << "one byte a lane and no more";
  }
}

TEST(SimdChart, RadiusOnPacksIsThatOnOneLane) {
  for (const double delay : {0.0, 0.0025, 0.005}) {
    const LoopChart chart = gain_chart(0.005, delay, 37, 53);
    const auto packs = simd::radius_chart(chart, 2), scalar = scalar_radius(chart);
    for (std::size_t k = 0; k < packs.size(); ++k) {
      EXPECT_NEAR(packs[k], scalar[k], 1e-12 * scalar[k]) << k;
    }
  }
}

TEST(SimdChart, TestsOnPacksAreThoseOnOneLaneAndThoseOfTheCrossings) {
  for (const double delay : {0.0, 0.0025, 0.005}) {
    const LoopChart chart = gain_chart(0.005, delay, 101, 203);
    const auto packs = tested(chart, true);
    EXPECT_EQ(packs, tested(chart, false));
    EXPECT_EQ(packs, simd::stability_chart(chart, 1));
  }
}

TEST(SimdChart, DoesNotDependOnTheNumberOfThreads) {
  const LoopChart chart = gain_chart(0.005, 0.005, 150, 60);
  EXPECT_EQ(simd::radius_chart(chart, 1), simd::radius_chart(chart, 3));
  EXPECT_EQ(simd::stability_chart(chart, 1), simd::stability_chart(chart, 3));
}

TEST(SimdChart, RadiusIsBelowOneWhereTheChartIsStable) {
  const LoopChart chart{{kollar2022_plant(), {0.005, 0.0}, {-557.0, -13.0}},
                        {Parameter::sampling_period, {0.0005, 0.03, 40}},
                        {Parameter::proportional_gain, {-1000.0, 200.0, 41}}};
  const auto radius = simd::radius_chart(chart);
  const auto stable = simd::stability_chart(chart);
  for (std::size_t k = 0; k < radius.size(); ++k) EXPECT_EQ(radius[k] < 1.0, stable[k] == 1) << k;
}

/// A million cells of random loops on packs against the conditions on a polynomial that is built
/// and tested in extended precision.
TEST(SimdChart, PacksAgreeWithExtendedPrecisionOnAMillionRandomCells) {
  test::Random random(20260405);
  std::int64_t cells = 0, differ = 0, close = 0;
  for (int draw = 0; draw < 1000; ++draw) {
    const auto plant = test::random_plant(random);
    const auto sampling = test::random_sampling(plant, random);
    const auto end = test::random_gains(plant, sampling.period, random);
    const LoopChart chart{
        {plant, sampling, {0.0, 0.0}},
        {Parameter::proportional_gain, {-std::abs(end.proportional), end.proportional / 2, 20}},
        {Parameter::differential_gain, {-std::abs(end.differential), end.differential / 3, 50}}};
    const auto stable = tested(chart, true);
    const auto q = in_half_plane(characteristic_polynomial(
        sampled_loop(converted<long double>(plant),
                     Sampling<long double>{sampling.period, sampling.processing_delay})));
    for (std::int64_t k = 0; k < 1000; ++k, ++cells) {
      const auto gains = chart.cell(k / 50, k % 50).gains;
      const bool expected =
          is_hurwitz<long double, 6>(q.at({gains.proportional, gains.differential}));
      if (expected == (stable[static_cast<std::size_t>(k)] == 1)) continue;
      ++differ;
      if (std::abs(test::growth(plant, sampling, gains).excess) <= 1e-9) ++close;
    }
  }
  EXPECT_EQ(cells, 1000000);
  EXPECT_EQ(differ, close) << "cells that differ further than 1e-9 from the boundary";
}

}  // namespace
}  // namespace holdfast
