#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "case/axes/grid.hpp"
#include "process/job_context.hpp"

namespace holdfast::program {

/// A job's result over two axes: a netCDF-4 file when the output's name ends in `.nc`, else the
/// same bytes as a Table with the columns slow axis, fast axis, values. It appears at commit() or
/// not at all.
///
///     GridTable table(context, {{"proportional_gain", "N/m", "P"}, {-600.0, 0.0, 41}},
///                     {{"differential_gain", "N.s/m", "D"}, {-20.0, 0.0, 31}},
///                     {{{"stable", "", "1: stable, 0: not", "integer"}, "unstable stable"},
///                      {{"amplitude_m", "m", "steady amplitude"}}});
///     table.append_row({stable.data(), amplitudes.data()});   // 41 times, 31 values each
///     table.commit();
///
/// Throws std::logic_error for a row that does not fit the columns, for one row too many and for a
/// commit() before the last; NoAnswer where netCDF is asked for and missing; Interrupted; and what
/// OutputFile throws. A path that cannot be written is refused before anything is computed.
class GridTable {
 public:
  GridTable(const JobContext& context, const GridAxis& slow, const GridAxis& fast,
            const std::vector<GridColumn>& columns);

  /// The next row of the slow axis; one entry a column, each pointing to as many values as the fast
  /// axis has.
  void append_row(const std::vector<GridValues>& columns);

  void commit();

 private:
  std::size_t rows_ = 0;
  std::size_t rows_done_ = 0;
  std::vector<GridColumn> columns_;
  std::unique_ptr<GridWriter> writer_;
};

}  // namespace holdfast::program
