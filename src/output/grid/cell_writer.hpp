#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "output/grid/grid_output.hpp"

namespace holdfast::program {

/// Writer of the cells of a grid in ascending order, the first axis slowest, in bounded memory. The
/// caller passes values that fit their columns, and no more cells than the grid has. A file appears
/// at commit() or not at all; chunks of a Zarr store appear one by one.
class CellWriter {
 public:
  virtual ~CellWriter() = default;
  CellWriter(const CellWriter&) = delete;
  CellWriter& operator=(const CellWriter&) = delete;

  /// Appends the next `cells` cells; `columns` has a pointer to the values of each column.
  virtual void append(std::size_t cells, const std::vector<const double*>& columns) = 0;
  virtual void commit() = 0;

 protected:
  CellWriter() = default;
};

/// A CSV writer with the same bytes as a Table that has the axes as first columns, but faster.
/// Throws the exceptions of Table.
std::unique_ptr<CellWriter> csv_cells(const JobContext& context, const GridLayout& layout);

/// A writer of a netCDF-4 file after the CF conventions 1.10, readable by xarray and ncdump. Axes
/// are dimensions with coordinate variables of their names; a dot becomes an underscore, and the
/// attribute `key` keeps the original name. Columns are variables over all axes: doubles, integers
/// of 64 bits, or bytes with meanings for words. The file's attributes have version, job, options
/// and the full case as TOML; there is no metadata file. Cells are written one chunk_shape() at a
/// time and compressed once; memory holds one chunk of every column.
///
/// Throws NoAnswer if the library is missing, WrongInput if the output is not a regular file,
/// OutputError if a call of the library fails, and the exceptions of OutputFile.
std::unique_ptr<CellWriter> netcdf_cells(const JobContext& context, const GridLayout& layout);

/// A writer of a Zarr store (StoreFolder), chunk by chunk. Cells of an existing store are
/// overwritten.
///
/// Throws the exceptions of StoreFolder::enter() and put().
std::unique_ptr<CellWriter> zarr_cells(const JobContext& context, const GridLayout& layout);

/// Whether a job's tables go to the JobHost of its thread: it has one, and --output is not given.
bool is_received(const JobContext& context);

/// A writer to a table of the thread's JobHost, which must exist.
std::unique_ptr<CellWriter> memory_cells(const JobContext& context, const GridLayout& layout);

}  // namespace holdfast::program
