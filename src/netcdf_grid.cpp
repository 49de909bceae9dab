#include "netcdf_grid.hpp"

#include "netcdf_library.hpp"

#ifdef HOLDFAST_HAS_NETCDF
#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "case_file.hpp"
#include "errors.hpp"
#include "interrupt.hpp"
#include "metadata.hpp"
#include "netcdf_file.hpp"
#endif

namespace holdfast::program {

#ifdef HOLDFAST_HAS_NETCDF

namespace {

using Number = NetcdfFile::Number;

/// Enough for the compression to pay and few enough to keep in memory.
constexpr std::size_t values_in_block = std::size_t{1} << 16;
/// A chunk is read as a whole, and HDF5 has none of 4 GiB; only rows longer than this are cut.
constexpr std::size_t most_values_in_chunk = std::size_t{1} << 20;

/// The options as a JSON object, as in the metadata beside a CSV file.
std::string options_text(const JobContext& context) {
  const auto options = table_metadata(context, {}, "")["notes"][0]["holdfast"]["options"];
  return options.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

const OutputFile& require_file(const OutputFile& output) {
  if (!output.is_file())
    throw WrongInput("cannot write " + output.target().string() + ": netCDF needs a regular file");
  return output;
}

/// A column's values in the rows that wait to be written; of the two lists one is in use.
struct Block {
  Number variable = 0;
  std::vector<signed char> flags;
  std::vector<double> reals;

  void append(const GridValues& row, std::size_t count) {
    if (const auto* values = std::get_if<const double*>(&row)) {
      reals.insert(reals.end(), *values, *values + count);
      return;
    }
    const std::uint8_t* values_of_row = std::get<const std::uint8_t*>(row);
    for (std::size_t i = 0; i < count; ++i) flags.push_back(values_of_row[i] != 0 ? 1 : 0);
  }
  const void* values() const {
    if (reals.empty()) return flags.data();
    return reals.data();
  }
  void clear() {
    flags.clear();
    reals.clear();
  }
};

class NetcdfGrid : public GridWriter {
 public:
  NetcdfGrid(const JobContext& context, GridLayout layout)
      : layout_(std::move(layout)), output_(context.output), file_(require_file(output_)) {
    const std::size_t values_in_row = std::max(layout_.fast.count(), std::size_t{1});
    rows_in_block_ = std::max(values_in_block / values_in_row, std::size_t{1});
    describe_origin(context);
    const Number slow = file_.add_dimension(layout_.slow.column.name, layout_.slow.count());
    const Number fast = file_.add_dimension(layout_.fast.column.name, layout_.fast.count());
    const Number slow_values = add_coordinate(layout_.slow, slow);
    const Number fast_values = add_coordinate(layout_.fast, fast);
    for (const GridColumn& column : layout_.columns) add_column(column, {slow, fast});
    file_.begin_values();
    write_coordinate(slow_values, layout_.slow);
    write_coordinate(fast_values, layout_.fast);
  }

  void append_row(const std::vector<GridValues>& row) override {
    for (std::size_t i = 0; i < row.size(); ++i) blocks_[i].append(row[i], layout_.fast.count());
    if (++rows_waiting_ == rows_in_block_) write_block();
  }

  void commit() override {
    write_block();
    file_.close();
    output_.commit();
  }

 private:
  void describe_origin(const JobContext& context) {
    file_.set_attribute("Conventions", "CF-1.10");
    file_.set_attribute("title", "holdfast " + context.job);
    file_.set_attribute("source", std::string("holdfast ") + HOLDFAST_VERSION);
    file_.set_attribute("options", options_text(context));
    file_.set_attribute("case", case_to_toml(context.case_data));
  }

  void set_long_name(Number variable, const Column& column) {
    if (!column.description.empty()) file_.set_attribute(variable, "long_name", column.description);
  }

  Number add_coordinate(const GridAxis& axis, Number dimension) {
    const Number variable = file_.add_reals(axis.column.name, {dimension});
    set_long_name(variable, axis.column);
    file_.set_attribute(variable, "units", udunits(axis.column.unit));
    return variable;
  }

  void add_column(const GridColumn& column, const std::vector<Number>& dimensions) {
    const std::string& name = column.column.name;
    Block block;
    if (column.holds_flags()) {
      block.variable = file_.add_flags(name, dimensions, column.flag_meanings);
    } else {
      block.variable = file_.add_reals(name, dimensions);
      file_.set_attribute(block.variable, "units", udunits(column.column.unit));
    }
    set_long_name(block.variable, column.column);
    const std::size_t rows = std::min(rows_in_block_, layout_.slow.count());
    file_.set_chunks(block.variable, {rows, std::min(layout_.fast.count(), most_values_in_chunk)});
    blocks_.push_back(std::move(block));
  }

  void write_coordinate(Number variable, const GridAxis& axis) {
    std::vector<double> part;
    for (std::size_t start = 0; start < axis.count(); start += part.size()) {
      part.resize(std::min(axis.count() - start, values_in_block));
      for (std::size_t i = 0; i < part.size(); ++i) part[i] = axis.at(start + i);
      file_.write(variable, {start}, {part.size()}, part.data());
    }
  }

  void write_block() {
    throw_if_interrupted();
    for (Block& block : blocks_) {
      file_.write(block.variable, {rows_written_, 0}, {rows_waiting_, layout_.fast.count()},
                  block.values());
      block.clear();
    }
    rows_written_ += rows_waiting_;
    rows_waiting_ = 0;
  }

  GridLayout layout_;
  OutputFile output_;
  NetcdfFile file_;
  std::vector<Block> blocks_;
  std::size_t rows_in_block_ = 1;
  std::size_t rows_waiting_ = 0;
  std::size_t rows_written_ = 0;
};

}  // namespace

std::unique_ptr<GridWriter> netcdf_grid(const JobContext& context, GridLayout layout) {
  return std::make_unique<NetcdfGrid>(context, std::move(layout));
}

#else

std::unique_ptr<GridWriter> netcdf_grid(const JobContext&, GridLayout) {
  require_netcdf();
  return nullptr;
}

#endif

}  // namespace holdfast::program
