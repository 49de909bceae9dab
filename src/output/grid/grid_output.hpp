#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "case/axes/axis.hpp"
#include "case/job_context.hpp"

namespace holdfast::program {

class CellWriter;

/// A column of a grid, with one value per cell. Values are passed as doubles; by datatype they are
///  - "double": any numbers;
///  - "integer": whole numbers within ±2⁵³, or indices of words, which CSV shows as numbers;
///  - "string": the indices 0, 1, 2, … of the words.
struct CellColumn {
  Column column;
  /// Words of the indices 0, 1, 2, …, without blanks, at most 128: "periodic", "chaotic".
  std::vector<std::string> words = {};
};

/// Layout of the result over a grid: axes, the first slowest, and columns with a value per cell.
struct GridLayout {
  std::vector<GridAxis> axes;  // at least one
  std::vector<CellColumn> columns;

  /// Number of cells, the product of the axes' counts. Throws WrongInput if it exceeds 2⁶³ − 1.
  std::int64_t cells() const;
};

/// A job's result over any number of axes, written in order in bounded memory. By the output's name
/// it is a netCDF-4 file (`.nc`) with a dimension per axis, a Zarr store (`.zarr`), or else a CSV
/// table with a column per axis and metadata beside it. A file appears at commit() or not at all.
///
///     GridOutput output(context, {{{{"backlash.width", "m", "r0"}, Axis{0, 0.003, 61}},
///                                  {{"excitation.frequency", "Hz", "f"}, LogAxis{1, 100, 41}}},
///                                 {{{"steady_peak", "m", "largest |z1|"}, {}},
///                                  {{"verdict", "", "kind of motion", "string"},
///                                   {"periodic", "chaotic"}}}});
///     output.append(2501, {peaks.data(), verdicts.data()});   // or in any portions
///     output.commit();
///
/// Throws std::logic_error for a layout without axes or with invalid words, for more cells than the
/// layout has, values that do not fit their column, and commit() before the last cell; NoAnswer if
/// netCDF is requested and missing; OutputError for an axis name that netCDF refuses; Interrupted;
/// and the exceptions of GridLayout::cells() and OutputFile. A path that cannot be written is
/// refused before the computation.
class GridOutput {
 public:
  GridOutput(const JobContext& context, const GridLayout& layout);
  ~GridOutput();
  GridOutput(const GridOutput&) = delete;
  GridOutput& operator=(const GridOutput&) = delete;

  /// Appends the next `cells` cells; `columns` has a pointer to `cells` values for each column.
  void append(std::int64_t cells, const std::vector<const double*>& columns);

  void commit();

 private:
  std::vector<CellColumn> columns_;
  std::int64_t cells_;
  std::int64_t cells_done_ = 0;
  std::unique_ptr<CellWriter> writer_;
};

}  // namespace holdfast::program
