#include "io/grid/cell_writer.hpp"
#include "io/grid/netcdf_library.hpp"

#ifdef HOLDFAST_HAS_NETCDF
#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <numeric>
#include <type_traits>
#include <utility>
#include <variant>

#include "case/case_file.hpp"
#include "io/file/metadata.hpp"
#include "io/file/output.hpp"
#include "io/grid/cell_blocks.hpp"
#include "io/grid/netcdf_file.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#endif

namespace holdfast::program {

#ifdef HOLDFAST_HAS_NETCDF

namespace {

using Shape = NetcdfFile::Shape;
using Number = NetcdfFile::Number;

/// The options as a JSON object, as in the metadata beside a CSV file.
std::string options_text(const JobContext& context) {
  const auto options = table_metadata(context, {}, "")["notes"][0]["holdfast"]["options"];
  return options.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

Shape shape_of(const std::vector<GridAxis>& axes) {
  Shape shape;
  for (const GridAxis& axis : axes) shape.push_back(axis.count());
  return shape;
}

const OutputFile& require_file(const OutputFile& output) {
  if (!output.is_file())
    throw WrongInput("cannot write " + output.target().string() + ": netCDF needs a regular file");
  return output;
}

/// A column's values in the cells that wait to be written, as its variable holds them.
struct WaitingValues {
  NetcdfFile::Number variable = 0;
  std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<signed char>> values;

  void append(const double* more, std::size_t count) {
    const auto convert = [&](auto& list) {
      using Value = typename std::decay_t<decltype(list)>::value_type;
      std::transform(more, more + count, std::back_inserter(list),
                     [](double value) { return static_cast<Value>(value); });
    };
    std::visit(convert, values);
  }

  /// From that one on.
  const void* from(std::size_t first) const {
    return std::visit([=](const auto& list) -> const void* { return list.data() + first; }, values);
  }
};

std::size_t cells_of(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

/// A chunk is read as a whole, and HDF5 has none of 4 GiB; only lines longer than this are cut.
constexpr std::size_t most_values_in_line = std::size_t{1} << 20;

class NetcdfCells : public CellWriter {
 public:
  NetcdfCells(const JobContext& context, const std::vector<GridAxis>& axes,
              const std::vector<CellColumn>& columns, CellPortions portions)
      : shape_(shape_of(axes)), output_(context.output), file_(require_file(output_)) {
    const bool lines = portions == CellPortions::lines;
    const Shape chunk = chunk_shape(shape_, lines ? most_values_in_line : values_in_block);
    if (lines) cells_of_portion_ = cells_of(shape_) / shape_[0] * chunk[0];
    describe_origin(context);
    for (const GridAxis& axis : axes)
      dimensions_.push_back(file_.add_dimension(axis.column.name, axis.count()));
    std::vector<Number> coordinates;
    for (const GridAxis& axis : axes) {
      const Number dimension = dimensions_[coordinates.size()];
      coordinates.push_back(file_.add_coordinate(axis.column.name, dimension));
      set_long_name(coordinates.back(), axis.column);
      file_.set_attribute(coordinates.back(), "units", udunits(axis.column.unit));
    }
    for (const CellColumn& column : columns) {
      columns_.push_back(add_column(column));
      file_.set_chunks(columns_.back().variable, chunk);
      // Cells come in order: the chunk that is not yet whole is all that will be needed again.
      if (!lines) file_.set_cache(columns_.back().variable, cells_of(chunk) * sizeof(double));
    }
    file_.begin_values();
    for (std::size_t i = 0; i < axes.size(); ++i) write_coordinate(coordinates[i], axes[i]);
  }

  void append(std::size_t cells, const std::vector<const double*>& columns) override {
    for (std::size_t done = 0; done < cells;) {
      const std::size_t taken = std::min(cells_of_portion_ - cells_waiting_, cells - done);
      for (std::size_t i = 0; i < columns_.size(); ++i)
        columns_[i].append(columns[i] + done, taken);
      cells_waiting_ += taken;
      done += taken;
      if (cells_waiting_ == cells_of_portion_) write_waiting();
    }
  }

  void commit() override {
    write_waiting();
    file_.close();
    output_.commit();
  }

 private:
  void describe_origin(const JobContext& context) {
    file_.set_attribute("Conventions", "CF-1.10");
    file_.set_attribute("title", "holdfast " + context.job);
    file_.set_attribute("source", std::string("holdfast ") + HOLDFAST_VERSION);
    file_.set_attribute("options", options_text(context));
    if (context.on_packs)
      file_.set_attribute("instructions", std::string(name_of(context.instructions)));
    file_.set_attribute("case", case_to_toml(context.case_data));
  }

  void set_long_name(Number variable, const Column& column) {
    if (!column.description.empty()) file_.set_attribute(variable, "long_name", column.description);
  }

  WaitingValues add_column(const CellColumn& cells) {
    const Column& column = cells.column;
    WaitingValues added;
    if (!cells.words.empty()) {
      added = {file_.add_flags(column.name, dimensions_, cells.words), std::vector<signed char>()};
    } else if (column.datatype == "integer") {
      added = {file_.add_integers(column.name, dimensions_), std::vector<std::int64_t>()};
    } else {
      added = {file_.add_reals(column.name, dimensions_), std::vector<double>()};
    }
    if (cells.words.empty()) file_.set_attribute(added.variable, "units", udunits(column.unit));
    set_long_name(added.variable, column);
    return added;
  }

  void write_coordinate(Number variable, const GridAxis& axis) {
    std::vector<double> part;
    for (std::size_t start = 0; start < axis.count(); start += part.size()) {
      part.resize(std::min(axis.count() - start, values_in_block));
      throw_if_interrupted();
      for (std::size_t i = 0; i < part.size(); ++i) part[i] = axis.at(start + i);
      file_.write(variable, {start}, {part.size()}, part.data());
    }
  }

  void write_waiting() {
    throw_if_interrupted();
    std::size_t first = 0;
    for (const CellBlock& block : cell_blocks(shape_, cells_written_, cells_waiting_)) {
      for (const WaitingValues& column : columns_)
        file_.write(column.variable, block.start, block.count, column.from(first));
      first += cells_of(block.count);
    }
    for (WaitingValues& column : columns_)
      std::visit([](auto& list) { list.clear(); }, column.values);
    cells_written_ += cells_waiting_;
    cells_waiting_ = 0;
  }

  Shape shape_;
  OutputFile output_;
  NetcdfFile file_;
  std::vector<Number> dimensions_;
  std::vector<WaitingValues> columns_;
  std::size_t cells_of_portion_ = values_in_block;
  std::size_t cells_written_ = 0;
  std::size_t cells_waiting_ = 0;
};

}  // namespace

std::unique_ptr<CellWriter> netcdf_cells(const JobContext& context,
                                         const std::vector<GridAxis>& axes,
                                         const std::vector<CellColumn>& columns,
                                         CellPortions portions) {
  return std::make_unique<NetcdfCells>(context, axes, columns, portions);
}

#else

std::unique_ptr<CellWriter> netcdf_cells(const JobContext&, const std::vector<GridAxis>&,
                                         const std::vector<CellColumn>&, CellPortions) {
  require_netcdf();
  return nullptr;
}

#endif

}  // namespace holdfast::program
