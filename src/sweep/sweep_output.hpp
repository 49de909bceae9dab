#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "case/axes/grid.hpp"
#include "io/grid/cell_writer.hpp"
#include "process/job_context.hpp"

namespace holdfast::program {

/// What the result of a sweep is made of: a product grid of axes, the first slowest.
struct SweepLayout {
  std::vector<GridAxis> axes;  // at least one
  std::vector<CellColumn> columns;

  /// Product of the axes' counts. Throws WrongInput for 2⁶³ and more.
  std::int64_t cells() const;
};

/// A job's result over any number of axes, written in order in bounded memory: a netCDF-4 file with
/// a dimension for each axis when the output's name ends in `.nc`, else a CSV table with a column
/// for each axis and its metadata beside it. It appears at commit() or not at all.
///
///     SweepOutput output(context, {{{{"backlash.width", "m", "r0"}, Axis{0, 0.003, 61}},
///                                   {{"excitation.frequency", "Hz", "f"}, LogAxis{1, 100, 41}}},
///                                  {{{"steady_peak", "m", "largest |z1|"}, {}},
///                                   {{"verdict", "", "kind of motion", "string"},
///                                    {"periodic", "chaotic"}}}});
///     output.append(2501, {peaks.data(), verdicts.data()});   // or in any portions
///     output.commit();
///
/// Throws std::logic_error for a layout without axes or with words that CellColumn does not allow,
/// for more cells than the layout has, values that are not such as their column says, and a
/// commit() before the last cell; NoAnswer where netCDF is asked for and missing; Interrupted; and
/// what SweepLayout::cells(), OutputFile and, for an axis name that netCDF does not take,
/// NetcdfFile throw. A path that cannot be written is refused before anything is computed.
class SweepOutput {
 public:
  SweepOutput(const JobContext& context, SweepLayout layout);

  /// The next `cells` cells; one entry a column, each pointing to as many values.
  void append(std::int64_t cells, const std::vector<const double*>& columns);

  void commit();

 private:
  std::vector<CellColumn> columns_;
  std::int64_t cells_;
  std::int64_t cells_done_ = 0;
  std::unique_ptr<CellWriter> writer_;
};

}  // namespace holdfast::program
