#include <algorithm>
#include <string_view>

#include "io/grid/cell_writer.hpp"
#include "io/grid/netcdf_library.hpp"
#include "io/text/text.hpp"

#ifdef HOLDFAST_HAS_NETCDF
#include <cstdint>
#include <functional>
#include <iterator>
#include <numeric>
#include <type_traits>
#include <variant>

#include "case/case_file.hpp"
#include "io/file/metadata.hpp"
#include "io/file/output.hpp"
#include "io/grid/netcdf_file.hpp"
#include "io/text/filled.hpp"
#include "process/interrupt.hpp"
#endif

namespace holdfast::program {

std::string udunits(const std::string& unit) {
  std::string text;
  bool divided = false;
  for (const std::string_view quotient : split(unit, '/')) {
    for (const std::string_view factor : split(quotient, '.')) {
      if (factor.empty() || factor == "1") continue;
      const bool has_power = factor.find_first_of("0123456789") != std::string_view::npos;
      const std::size_t letters = std::min(factor.find_first_of("0123456789"), factor.size());
      text += (text.empty() ? "" : " ") + std::string(factor.substr(0, letters));
      if (divided) text += '-';
      if (has_power) text += factor.substr(letters);
      if (divided && !has_power) text += '1';
    }
    divided = true;
  }
  return text.empty() ? "1" : text;
}

std::vector<std::size_t> chunk_shape(const std::vector<std::size_t>& shape) {
  std::vector<std::size_t> chunk(shape.size(), 1);
  std::size_t values = 1;
  for (std::size_t axis = shape.size(); axis-- > 0 && values < values_in_chunk;) {
    chunk[axis] = std::min(shape[axis], values_in_chunk / values);
    values *= shape[axis];
  }
  return chunk;
}

#ifdef HOLDFAST_HAS_NETCDF

namespace {

using Shape = NetcdfFile::Shape;
using Number = NetcdfFile::Number;
using Type = NetcdfFile::Type;

/// The options as a JSON object, as in the metadata beside a CSV file.
std::string options_text(const JobContext& context) {
  const auto options = table_metadata(context, {}, "")["notes"][0]["holdfast"]["options"];
  return options.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

/// What made the file, as CF asks for it (2.6.2), without a date: the same question gives the same
/// bytes.
std::string history_of(const JobContext& context) {
  std::string text = std::string("holdfast ") + HOLDFAST_VERSION + ": holdfast " + context.job;
  const auto append = [&text](const std::string& option, const std::string& value) {
    text += " " + option;
    if (value != "true") text += " '" + replaced(value, "'", "'\\''") + "'";  // else a flag
  };
  if (context.case_source.text) append("--case", context.case_source.name);
  for (const std::string& override : context.case_source.overrides) append("--set", override);
  for (const auto& [option, value] : context.options) append(option, value);
  return text;
}

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
    describe_origin(context);
    Shape shape;
    for (const GridAxis& axis : axes_) {
      shape.push_back(axis.count());
      dimensions_.push_back(file_.add_dimension(axis.column.name, axis.count()));
    }
    chunk_ = chunk_shape(shape);
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
  void describe_origin(const JobContext& context) const {
    file_.set_attribute(NetcdfFile::whole_file, "Conventions", "CF-1.10");
    file_.set_attribute(NetcdfFile::whole_file, "title", "holdfast " + context.job);
    file_.set_attribute(NetcdfFile::whole_file, "source",
                        std::string("holdfast ") + HOLDFAST_VERSION);
    file_.set_attribute(NetcdfFile::whole_file, "history", history_of(context));
    file_.set_attribute(NetcdfFile::whole_file, "options", options_text(context));
    if (context.on_packs)
      file_.set_attribute(NetcdfFile::whole_file, "instructions",
                          std::string(name_of(context.instructions)));
    file_.set_attribute(NetcdfFile::whole_file, "case", case_to_toml(context.case_data));
  }

  Number add_coordinate(const GridAxis& axis, std::size_t place) const {
    // A coordinate misses no value (CF 2.5.1).
    const Column& column = axis.column;
    const Number number = file_.add_variable(column.name, Type::real, {dimensions_[place]}, false);
    set_long_name(number, column);
    file_.set_attribute(number, "units", udunits(column.unit));
    if (cf_name(column.name) != column.name) file_.set_attribute(number, "key", column.name);
    return number;
  }

  void set_long_name(Number variable, const Column& column) const {
    if (!column.description.empty()) file_.set_attribute(variable, "long_name", column.description);
  }

  WaitingValues add_column(const CellColumn& cells) const {
    const Column& column = cells.column;
    WaitingValues added;
    if (!cells.words.empty()) {
      added.variable = file_.add_variable(column.name, Type::byte, dimensions_, false);
      added.values = std::vector<signed char>();
      describe_words(added.variable, cells.words);
    } else if (column.datatype == "integer") {
      added.variable = file_.add_variable(column.name, Type::integer, dimensions_, false);
      added.values = std::vector<std::int64_t>();
    } else {
      added.variable = file_.add_variable(column.name, Type::real, dimensions_, true);
    }
    if (cells.words.empty()) file_.set_attribute(added.variable, "units", udunits(column.unit));
    set_long_name(added.variable, column);
    return added;
  }

  void describe_words(Number variable, const std::vector<std::string>& words) const {
    std::vector<signed char> values(words.size());
    std::iota(values.begin(), values.end(), static_cast<signed char>(0));
    file_.set_attribute(variable, "flag_values", values);
    std::string meanings;
    for (const std::string& word : words) meanings += (meanings.empty() ? "" : " ") + word;
    file_.set_attribute(variable, "flag_meanings", meanings);
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
