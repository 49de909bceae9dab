#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "case/axes/grid.hpp"
#include "io/grid/cell_writer.hpp"
#include "process/job_context.hpp"

namespace holdfast::program {

/// The values of one column along the fast axis, as many as that has: flags (0 or not) or reals.
using GridValues = std::variant<const std::uint8_t*, const double*>;

/// A job's result over two axes: a netCDF-4 file when the output's name ends in `.nc`, else the
/// same bytes as a Table with the columns slow axis, fast axis, values. It appears at commit() or
/// not at all. A column with words, of what 0 and 1 mean, holds flags; the others hold real
/// numbers.
///
///     GridTable table(context, {{"proportional_gain", "N/m", "P"}, {-600.0, 0.0, 41}},
///                     {{"differential_gain", "N.s/m", "D"}, {-20.0, 0.0, 31}},
///                     {{{"stable", "", "1: stable, 0: not", "integer"}, {"unstable", "stable"}},
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
            const std::vector<CellColumn>& columns);

  /// The next row of the slow axis; one entry a column, each pointing to as many values as the fast
  /// axis has.
  void append_row(const std::vector<GridValues>& columns);

  void commit();

 private:
  std::size_t rows_ = 0;
  std::size_t rows_done_ = 0;
  std::size_t cells_of_row_ = 0;
  std::vector<CellColumn> columns_;
  std::vector<std::vector<double>> flags_;  // of a row, column by column
  std::unique_ptr<CellWriter> writer_;
};

}  // namespace holdfast::program
