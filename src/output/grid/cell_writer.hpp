#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "output/grid/grid_output.hpp"

namespace holdfast::program {

/// One way in which the cells of a grid become a file, in ascending order, the first axis slowest,
/// in bounded memory: with values that are such as their columns say, and never more than there
/// are. The file appears at commit() or not at all.
class CellWriter {
 public:
  virtual ~CellWriter() = default;
  CellWriter(const CellWriter&) = delete;
  CellWriter& operator=(const CellWriter&) = delete;

  /// The next cells; one entry a column.
  virtual void append(std::size_t cells, const std::vector<const double*>& columns) = 0;
  virtual void commit() = 0;

 protected:
  CellWriter() = default;
};

/// The bytes of a Table with a column for each axis, then the columns, at less cost.
/// Throws what Table throws.
std::unique_ptr<CellWriter> csv_cells(const JobContext& context, const GridLayout& layout);

/// NetCDF-4 after the CF conventions 1.10, readable as it is by xarray and ncdump: the axes are
/// dimensions with coordinate variables of their names, in which a dot becomes an underscore (the
/// attribute `key` keeps it), the columns variables over all of them: doubles, integers of 64 bits,
/// and for words bytes with their meanings. The file's attributes hold version, job, options and
/// the full case as TOML; there is no metadata file beside it. Cells are written a chunk_shape() at
/// a time, so that each is compressed once; memory holds one chunk of every column, for any grid.
///
/// Throws NoAnswer where the library is missing, WrongInput where the output is no file,
/// OutputError where a call of the library fails, and what OutputFile throws.
std::unique_ptr<CellWriter> netcdf_cells(const JobContext& context, const GridLayout& layout);

/// A Zarr store as StoreFolder has it, a chunk_shape() at a time; cells of a store that is there
/// already are written over.
///
/// Throws what StoreFolder::enter() and put() throw.
std::unique_ptr<CellWriter> zarr_cells(const JobContext& context, const GridLayout& layout);

/// Whether the tables of a job go to the host of its thread: where it has one, and no --output.
bool is_received(const JobContext& context);

/// Cells that become a table of the host's, which there must be.
std::unique_ptr<CellWriter> memory_cells(const JobContext& context, const GridLayout& layout);

}  // namespace holdfast::program
