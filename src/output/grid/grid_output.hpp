#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "case/axes/axis.hpp"
#include "case/job_context.hpp"

namespace holdfast::program {

class CellWriter;

/// Column of a grid, one value for every cell. Its values are handed over as doubles; by the
/// datatype of the column they are
///  - "double": written as they are;
///  - "integer": whole, within ±2⁵³; with words 0, 1, 2, … for them, which only netCDF tells;
///  - "string": 0, 1, 2, … for the words.
struct CellColumn {
  Column column;
  /// Without blanks, at most 128: "periodic", "chaotic".
  std::vector<std::string> words = {};
};

/// Layout of the result over a grid: a product of axes, the first slowest.
struct GridLayout {
  std::vector<GridAxis> axes;  // at least one
  std::vector<CellColumn> columns;

  /// Product of the axes' counts. Throws WrongInput for 2⁶³ and more.
  std::int64_t cells() const;
};

/// A job's result over any number of axes, written in order in bounded memory: a netCDF-4 file with
/// a dimension for each axis when the output's name ends in `.nc`, else a CSV table with a column
/// for each axis and its metadata beside it. It appears at commit() or not at all.
///
///     GridOutput output(context, {{{{"backlash.width", "m", "r0"}, Axis{0, 0.003, 61}},
///                                  {{"excitation.frequency", "Hz", "f"}, LogAxis{1, 100, 41}}},
///                                 {{{"steady_peak", "m", "largest |z1|"}, {}},
///                                  {{"verdict", "", "kind of motion", "string"},
///                                   {"periodic", "chaotic"}}}});
///     output.append(2501, {peaks.data(), verdicts.data()});   // or in any portions
///     output.commit();
///
/// Throws std::logic_error for a layout without axes or with words that CellColumn does not allow,
/// for more cells than the layout has, values that are not such as their column says, and a
/// commit() before the last cell; NoAnswer where netCDF is asked for and missing; OutputError for
/// an axis name that netCDF does not take; Interrupted; and what GridLayout::cells() and OutputFile
/// throw. A path that cannot be written is refused before anything is computed.
class GridOutput {
 public:
  GridOutput(const JobContext& context, const GridLayout& layout);
  ~GridOutput();
  GridOutput(const GridOutput&) = delete;
  GridOutput& operator=(const GridOutput&) = delete;

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
