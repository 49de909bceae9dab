#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "case/job_context.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/chart/chart.hpp"
#include "holdfast/stability/chart/loop_chart.hpp"
#include "holdfast/stability/response/response.hpp"
#include "output/grid/grid_output.hpp"

namespace holdfast::program {

/// The axes of a chart over P and D.
std::vector<GridAxis> gain_axes(const GainGrid& grid);

/// Memory into which a chart is written: stability flags, and the chart's columns of numbers.
struct ChartMemory {
  std::size_t columns;  ///< number of values in a row
  std::uint8_t* first_flags;
  std::vector<double*> first_numbers;

  std::uint8_t* flags(std::int64_t row) const { return first_flags + start(row); }
  double* numbers(std::size_t column, std::int64_t row) const {
    return first_numbers[column] + start(row);
  }
  std::size_t start(std::int64_t row) const { return static_cast<std::size_t>(row) * columns; }
};

/// A chart that is computed row by row.
struct ChartRows {
  std::int64_t rows;
  std::int64_t columns;        ///< number of values in a row
  std::size_t number_columns;  ///< number of columns besides the flags
  /// Computes rows first … first + count − 1 and writes them to the memory from row `offset` on.
  /// Each tile of rows uses its own copy of this function.
  std::function<void(std::int64_t first, std::int64_t count, std::int64_t offset,
                     const ChartMemory&)>
      fill;
};

/// Computes a chart on the job's threads and writes it; shows progress on standard error. A Zarr
/// store is written chunk by chunk; chunks already present are not computed again.
/// Throws Interrupted, InvalidParameter, and what GridOutput and fill_store() throw.
void write_chart(const JobContext& context, const GridLayout& layout, const ChartRows& chart);

/// Computes a chart into the caller's memory; reports progress only to the job's host. Throws
/// Interrupted, InvalidParameter.
void fill_chart(const ChartRows& chart, const ChartMemory& memory, int threads);

// Charts for write_chart() and fill_chart().

/// Chart of a sampled loop; columns: stable and, with `radius`, the spectral radius.
ChartRows sampled_chart(const LoopChart& chart, bool radius, InstructionSet instructions);

/// Stability chart over P and D of a case's loop, for any plant; columns as in sampled_chart().
ChartRows stability_chart_of(const Case& the_case, const GainGrid& grid, bool radius,
                             InstructionSet instructions);

/// Chart of a continuous loop; columns: stable and, with `abscissa`, the spectral abscissa (1/s).
ChartRows continuous_chart(const TwoMass<double>& plant, const GainGrid& grid, bool abscissa);

/// Chart of the steady response; columns: stable, steady amplitude (m) of z1, and its ratio to that
/// without control. Both numbers are NaN where the loop is unstable. For any plant of the case.
ChartRows response_chart(const JobContext& context, const SteadyResponse<double>& response,
                         double force_amplitude, const GainGrid& grid);

}  // namespace holdfast::program
