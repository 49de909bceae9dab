#include "io/grid/cell_writer.hpp"
#include "io/grid/netcdf_library.hpp"

#ifdef HOLDFAST_HAS_NETCDF
#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <numeric>
#include <type_traits>
#include <variant>

#include "io/file/output.hpp"
#include "io/grid/chunk_grid.hpp"
#include "io/grid/grid_attributes.hpp"
#include "io/grid/netcdf_file.hpp"
#include "process/interrupt.hpp"
#endif

namespace holdfast::program {

#ifdef HOLDFAST_HAS_NETCDF

namespace {

using Shape = NetcdfFile::Shape;
using Number = NetcdfFile::Number;
using Type = NetcdfFile::Type;

std::size_t product_of(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

/// A column's values in the cells that wait to be written, as its variable holds them.
struct WaitingValues {
  Number variable = 0;
  std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<signed char>> values;

  void append(const double* more, std::size_t count) {
    const auto convert = [&](auto& list) {
      using Value = typename std::decay_t<decltype(list)>::value_type;
      std::transform(more, more + count, std::back_inserter(list),
                     [](double value) { return static_cast<Value>(value); });
    };
    std::visit(convert, values);
  }
};

class NetcdfCells final : public CellWriter {
 public:
  NetcdfCells(const JobContext& context, const GridLayout& layout)
      : axes_(layout.axes), output_(context.output), file_(output_) {
    describe(NetcdfFile::whole_file, origin_attributes(context));
    Shape shape;
    for (const GridAxis& axis : axes_) {
      shape.push_back(axis.count());
      dimensions_.push_back(file_.add_dimension(axis.column.name, axis.count()));
    }
    chunk_ = chunk_shape(shape, values_in_chunk);
    std::vector<Number> coordinates;
    for (const GridAxis& axis : axes_)
      coordinates.push_back(add_coordinate(axis, coordinates.size()));
    for (const CellColumn& column : layout.columns) {
      columns_.push_back(add_column(column));
      file_.set_chunks(columns_.back().variable, chunk_);
    }
    file_.begin_values();
    for (std::size_t i = 0; i < axes_.size(); ++i) write_coordinate(coordinates[i], axes_[i]);
    begin_box();
  }

  void append(std::size_t cells, const std::vector<const double*>& columns) override {
    for (std::size_t done = 0; done < cells;) {
      const std::size_t taken = std::min(product_of(count_) - cells_waiting_, cells - done);
      for (std::size_t i = 0; i < columns_.size(); ++i)
        columns_[i].append(columns[i] + done, taken);
      cells_waiting_ += taken;
      done += taken;
      if (cells_waiting_ == product_of(count_)) write_box();
    }
  }

  void commit() override {
    std::vector<Number> variables;
    for (const WaitingValues& column : columns_) variables.push_back(column.variable);
    Shape last;
    for (const GridAxis& axis : axes_) last.push_back(axis.count() - 1);
    file_.finish(variables, last);
    output_.commit();
  }

 private:
  void describe(Number variable, const Attributes& attributes) const {
    for (const auto& [name, text] : attributes) file_.set_attribute(variable, name.c_str(), text);
  }

  Number add_coordinate(const GridAxis& axis, std::size_t place) const {
    // A coordinate misses no value (CF 2.5.1).
    const Number number =
        file_.add_variable(axis.column.name, Type::real, {dimensions_[place]}, false);
    describe(number, axis_attributes(axis.column));
    return number;
  }

  WaitingValues add_column(const CellColumn& cells) const {
    const Column& column = cells.column;
    WaitingValues added;
    if (!cells.words.empty()) {
      added.variable = file_.add_variable(column.name, Type::byte, dimensions_, false);
      added.values = std::vector<signed char>();
      std::vector<signed char> numbers(cells.words.size());
      std::iota(numbers.begin(), numbers.end(), static_cast<signed char>(0));
      file_.set_attribute(added.variable, "flag_values", numbers);
    } else if (column.datatype == "integer") {
      added.variable = file_.add_variable(column.name, Type::integer, dimensions_, false);
      added.values = std::vector<std::int64_t>();
    } else {
      added.variable = file_.add_variable(column.name, Type::real, dimensions_, true);
    }
    describe(added.variable, column_attributes(cells));
    return added;
  }

  void write_coordinate(Number variable, const GridAxis& axis) const {
    std::vector<double> part;
    for (std::size_t start = 0; start < axis.count(); start += part.size()) {
      part.resize(std::min(axis.count() - start, values_in_chunk));
      throw_if_interrupted();
      for (std::size_t i = 0; i < part.size(); ++i) part[i] = axis.at(start + i);
      file_.write(variable, {start}, {part.size()}, part.data());
    }
  }

  /// The next cells of the grid that make a chunk, or what of one there is at its end.
  void begin_box() {
    start_.resize(axes_.size());
    count_.resize(axes_.size());
    for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
      start_[axis] = index_along(axes_, axis, cells_written_);
      count_[axis] = std::min(chunk_[axis], axes_[axis].count() - start_[axis]);
    }
  }

  void write_box() {
    throw_if_interrupted();
    for (WaitingValues& column : columns_) {
      const auto write = [&](auto& list) {
        file_.write(column.variable, start_, count_, list.data());
        list.clear();
      };
      std::visit(write, column.values);
    }
    cells_written_ += cells_waiting_;
    cells_waiting_ = 0;
    begin_box();
  }

  std::vector<GridAxis> axes_;
  OutputFile output_;
  NetcdfFile file_;
  std::vector<Number> dimensions_;
  std::vector<WaitingValues> columns_;
  Shape chunk_;
  Shape start_, count_;  // of the chunk that is being filled
  std::size_t cells_written_ = 0;
  std::size_t cells_waiting_ = 0;
};

}  // namespace

std::unique_ptr<CellWriter> netcdf_cells(const JobContext& context, const GridLayout& layout) {
  return std::make_unique<NetcdfCells>(context, layout);
}

#else

std::unique_ptr<CellWriter> netcdf_cells(const JobContext&, const GridLayout&) {
  require_netcdf();
  return nullptr;
}

#endif

}  // namespace holdfast::program
