#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/chart/chart.hpp"
#include "holdfast/stability/chart/loop_chart.hpp"
#include "holdfast/stability/response/response.hpp"
#include "io/grid/grid_output.hpp"
#include "process/job_context.hpp"

namespace holdfast::program {

/// The axes of a chart over P and D.
std::vector<GridAxis> gain_axes(const GainGrid& grid);

/// The chart of the sampled loop of a case on two masses over P, the slow axis, and D.
LoopChart chart_over_gains(const Case& the_case, const GainGrid& grid);

/// Some rows of a chart in memory: flags, then as many columns of numbers as the chart has.
class ChartBlock {
 public:
  /// Throws WrongInput for longer rows than are held in memory.
  ChartBlock(std::int64_t columns, std::size_t number_columns, std::int64_t rows);

  std::uint8_t* flags(std::int64_t row) { return flags_.data() + start(row); }
  double* numbers(std::size_t column, std::int64_t row) {
    return numbers_[column].data() + start(row);
  }
  /// The first rows, column after column, the flags as numbers.
  std::vector<std::vector<double>> values(std::int64_t rows) const;

 private:
  std::size_t start(std::int64_t row) const { return static_cast<std::size_t>(row) * columns_; }

  std::size_t columns_;
  std::vector<std::uint8_t> flags_;
  std::vector<std::vector<double>> numbers_;
};

/// A chart that is computed row by row.
struct ChartRows {
  std::int64_t rows;
  std::int64_t columns;        ///< values in a row
  std::size_t number_columns;  ///< beside the flags
  /// Computes rows first … first + count − 1 into the block from its row `offset` on. Each tile
  /// of rows has a copy of its own.
  std::function<void(std::int64_t first, std::int64_t count, std::int64_t offset, ChartBlock&)>
      fill;
};

/// Computes a chart on the threads that the job was given and writes it; progress goes to standard
/// error. A store appears chunk by chunk, and those that are there are not computed again.
/// Throws Interrupted, InvalidParameter, and what GridOutput and fill_store() throw.
void write_chart(const JobContext& context, const GridLayout& layout, const ChartRows& chart);

// The charts; each holds on to the case of its context.

/// Columns: stable and, with `radius`, the spectral radius of the sampled loop.
ChartRows sampled_chart(const JobContext& context, const LoopChart& chart, bool radius);

/// The same of a modal case.
ChartRows modal_chart(const JobContext& context, const GainGrid& grid, bool radius);

/// Columns: stable and, with `abscissa`, the spectral abscissa (1/s) of the continuous loop.
ChartRows continuous_chart(const TwoMass<double>& plant, const GainGrid& grid, bool abscissa);

/// Columns: stable, amplitude (m) and its ratio to that without control; nan where unstable. On any
/// plant of the case.
ChartRows response_chart(const JobContext& context, const SteadyResponse<double>& response,
                         double force_amplitude, const GainGrid& grid);

}  // namespace holdfast::program
