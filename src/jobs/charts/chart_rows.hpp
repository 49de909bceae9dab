#pragma once

#include <cstdint>

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

/// Where the cells of a chart go in memory, P slowest.
struct ChartCells {
  std::uint8_t* stable;  ///< 1 where the loop is
  double* radius;        ///< the spectral radius; null: not asked
};

/// How it is computed; its cells do not depend on the threads.
struct ChartWork {
  int threads = 0;  ///< 0: all
  InstructionSet instructions = InstructionSet::baseline;
};

/// The cells of the job `stability` over P and D, of any plant of a case, without a table.
/// Throws Interrupted, and what the chart's plant does.
void fill_chart(const Case& the_case, const GainGrid& grid, const ChartCells& cells,
                const ChartWork& work);

/// Each computes a chart on the threads that the job was given and appends its cells to the output
/// in order, a block of rows in memory at a time; progress goes to standard error. They do not
/// commit. Throw Interrupted, InvalidParameter, and what GridOutput throws.

/// Columns: stable and, with `radius`, the spectral radius of the sampled loop.
void append_sampled_chart(const JobContext& context, const LoopChart& chart, bool radius,
                          GridOutput& output);

/// The same of a modal case.
void append_modal_chart(const JobContext& context, const GainGrid& grid, bool radius,
                        GridOutput& output);

/// Columns: stable and, with `abscissa`, the spectral abscissa (1/s) of the continuous loop.
void append_continuous_chart(const JobContext& context, const TwoMass<double>& plant,
                             const GainGrid& grid, bool abscissa, GridOutput& output);

/// Columns: stable, amplitude (m) and its ratio to that without control; nan where unstable. On any
/// plant of the case.
void append_response_chart(const JobContext& context, const SteadyResponse<double>& response,
                           double force_amplitude, const GainGrid& grid, GridOutput& output);

}  // namespace holdfast::program
