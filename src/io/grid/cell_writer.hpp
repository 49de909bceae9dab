#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "case/axes/grid.hpp"
#include "process/job_context.hpp"

namespace holdfast::program {

/// What a column tells of every cell of a grid. Its values are handed over as doubles; by the
/// datatype of the column they are
///  - "double": written as they are;
///  - "integer": whole, within ±2⁵³; with words 0, 1, 2, … for them, which only netCDF tells;
///  - "string": 0, 1, 2, … for the words.
struct CellColumn {
  Column column;
  /// Without blanks, at most 128: "periodic", "chaotic".
  std::vector<std::string> words = {};
};

/// One way in which the cells of a grid become a file, in ascending order, the first axis slowest,
/// in bounded memory: with values that are such as their columns say, and never more than there
/// are. The file appears at commit() or not at all.
class CellWriter {
 public:
  virtual ~CellWriter() = default;
  CellWriter(const CellWriter&) = delete;
  CellWriter& operator=(const CellWriter&) = delete;
  CellWriter(CellWriter&&) = delete;
  CellWriter& operator=(CellWriter&&) = delete;

  /// The next cells; one entry a column.
  virtual void append(std::size_t cells, const std::vector<const double*>& columns) = 0;
  virtual void commit() = 0;

 protected:
  CellWriter() = default;
};

/// How cells are handed over: in any portions, or in whole lines of the last axis.
enum class CellPortions { any, lines };

/// A netCDF-4 file when the output's name ends in `.nc`, else a CSV table with its metadata: the
/// bytes of a Table with a column for each axis, then the columns, at less cost.
///
/// NetCDF is written after the CF conventions 1.10, readable as it is by xarray and ncdump: the
/// axes are dimensions with coordinate variables of their names, the columns variables over all of
/// them: doubles, integers of 64 bits, and for words bytes with their meanings. The file's
/// attributes hold version, job, options and the full case as TOML; there is no metadata file
/// beside it. Cells are written 2^16 at a time, or a line where that
/// is more and lines are handed over, in chunks of so many at most that are contiguous in their
/// order, so that each chunk is compressed once; memory holds a chunk and a portion of every
/// column, for any grid.
///
/// Throws NoAnswer where netCDF is asked for and missing, WrongInput where its output is no file,
/// and what OutputFile, NetcdfFile and Table throw.
std::unique_ptr<CellWriter> cell_writer(const JobContext& context, std::vector<GridAxis> axes,
                                        const std::vector<CellColumn>& columns,
                                        CellPortions portions);

/// Its two kinds.
std::unique_ptr<CellWriter> csv_cells(const JobContext& context, std::vector<GridAxis> axes,
                                      const std::vector<CellColumn>& columns);
std::unique_ptr<CellWriter> netcdf_cells(const JobContext& context,
                                         const std::vector<GridAxis>& axes,
                                         const std::vector<CellColumn>& columns,
                                         CellPortions portions);

}  // namespace holdfast::program
