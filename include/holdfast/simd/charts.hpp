#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "holdfast/simd/pack.hpp"
#include "holdfast/simd/parallel_rows.hpp"
#include "holdfast/stability/chart/loop_chart_rows.hpp"

namespace holdfast::simd {

namespace detail {

/// Number of chart rows that a thread computes at a time.
inline constexpr std::int64_t rows_of_tile = 32;

/// Fills the cells of a chart. @tparam Rows  StabilityChartRows or RadiusChartRows
template <class Rows, class Cell>
void fill_chart(const LoopChart& chart, Cell* cells, int threads) {
  const std::int64_t columns = chart.fast.values.count;
  parallel_rows(chart.slow.values.count, rows_of_tile, threads, Rows(chart),
                [&](Rows& rows, std::int64_t first, std::int64_t count) {
                  rows.fill(first, count, cells + first * columns);
                });
}

inline std::size_t cells_of(const LoopChart& chart) {
  return static_cast<std::size_t>(chart.slow.values.count * chart.fast.values.count);
}

}  // namespace detail

/// Computes for every cell of a chart whether the loop is stable (1) or not (0).
///
///     const LoopChart chart{{kollar2022_plant(), {0.01, 0.01}, {}},
///                           {LoopParameter::proportional_gain, {-1000, 200, 1000}},
///                           {LoopParameter::differential_gain, {-40, 20, 1000}}};
///     const std::vector<std::uint8_t> stable = simd::stability_chart(chart);
///
/// @param chart    the loop and the two parameters that vary
/// @param stable   output: one entry for each cell, row by row; `chart.fast` varies along a row.
///                 Freshly allocated, unwritten memory is fastest: the operating system places each
///                 page near the processor of the thread that first writes to the page
/// @param threads  number of threads ≥ 1, or 0 for all cores; no effect on the result
/// @throws InvalidParameter where the chart is not admissible
inline void stability_chart(const LoopChart& chart, std::uint8_t* stable, int threads = 0) {
  detail::fill_chart<StabilityChartRows<Pack<double>>>(chart, stable, threads);
}

/// The stability chart as a vector of cells, row by row; `chart.fast` varies along a row. A cell is
/// 1 if the loop is stable, else 0. `threads` = 0 uses all cores.
inline std::vector<std::uint8_t> stability_chart(const LoopChart& chart, int threads = 0) {
  std::vector<std::uint8_t> stable(detail::cells_of(chart));
  stability_chart(chart, stable.data(), threads);
  return stable;
}

/// Computes the loop's spectral radius ρ in every cell of a chart, with absolute accuracy 1e−10.
/// @param chart    the loop and the two parameters that vary
/// @param radius   output: one entry for each cell, row by row; `chart.fast` varies along a row
/// @param threads  number of threads ≥ 1, or 0 for all cores; no effect on the result
/// @throws InvalidParameter where the chart is not admissible
inline void radius_chart(const LoopChart& chart, double* radius, int threads = 0) {
  if (has_processing_delay(chart)) {
    detail::fill_chart<RadiusChartRows<Pack<double>, 6>>(chart, radius, threads);
  } else {
    detail::fill_chart<RadiusChartRows<Pack<double>, 5>>(chart, radius, threads);
  }
}

/// The loop's spectral radius ρ in all cells of a chart, row by row. `threads` = 0 uses all cores.
inline std::vector<double> radius_chart(const LoopChart& chart, int threads = 0) {
  std::vector<double> radius(detail::cells_of(chart));
  radius_chart(chart, radius.data(), threads);
  return radius;
}

}  // namespace holdfast::simd
