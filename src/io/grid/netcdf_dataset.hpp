#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "case/axes/grid.hpp"
#include "io/file/output.hpp"
#include "io/grid/netcdf_file.hpp"
#include "process/job_context.hpp"

namespace holdfast::program {

/// How many values of a column are written at a time: enough for the compression to pay and few
/// enough to keep in memory.
constexpr std::size_t values_in_block = std::size_t{1} << 16;

/// A chunk that is contiguous when cells are written in order, the last axis fastest: whole along
/// the last axes, one cell along the first ones, and of values_in_block values at most. Only along
/// the last axis it may be longer, up to `longest_line`.
NetcdfFile::Shape chunk_shape(const NetcdfFile::Shape& shape, std::size_t longest_line);

/// A job's result over a product grid as netCDF-4, after the CF conventions 1.10: each axis is a
/// dimension with a coordinate variable of its name, each column a variable over all dimensions.
/// The file's attributes hold version, job, options and the full case as TOML. It appears at
/// commit() or not at all; there only where the program is built with netCDF.
///
/// Columns first, then begin_values(), then the values. Throws WrongInput where the output is no
/// file, and what OutputFile and NetcdfFile throw.
class NetcdfDataset {
 public:
  using Number = NetcdfFile::Number;
  using Shape = NetcdfFile::Shape;

  /// @param axes  the first slowest, each with a value
  NetcdfDataset(const JobContext& context, std::vector<GridAxis> axes);

  /// How many values each axis has.
  const Shape& shape() const { return shape_; }

  /// Variables in chunks of that shape.
  Number add_reals(const Column& column, const Shape& chunk);
  Number add_integers(const Column& column, const Shape& chunk);
  /// @param words  what 0, 1, 2, … mean
  Number add_flags(const Column& column, const std::vector<std::string>& words, const Shape& chunk);
  /// Keeps no more of a variable's chunks in memory than that many bytes.
  void set_cache(Number variable, std::size_t bytes) { file_.set_cache(variable, bytes); }

  /// Ends the description and writes the values of the axes.
  void begin_values();

  /// @param values  as NetcdfFile::write() takes them
  void write(Number variable, const Shape& start, const Shape& count, const void* values) {
    file_.write(variable, start, count, values);
  }

  void commit();

 private:
  void describe_origin(const JobContext& context);
  void set_long_name(Number variable, const Column& column);
  void set_units(Number variable, const Column& column);
  Number described(Number variable, const Column& column, const Shape& chunk);
  void add_coordinate(const GridAxis& axis);
  void write_coordinate(Number variable, const GridAxis& axis);

  std::vector<GridAxis> axes_;
  Shape shape_;
  OutputFile output_;
  NetcdfFile file_;
  std::vector<Number> dimensions_;
  std::vector<Number> coordinates_;
};

}  // namespace holdfast::program
