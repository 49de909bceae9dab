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

#include "io/grid/cell_blocks.hpp"
#include "io/grid/netcdf_dataset.hpp"
#include "process/interrupt.hpp"
#endif

namespace holdfast::program {

#ifdef HOLDFAST_HAS_NETCDF

namespace {

using Shape = NetcdfDataset::Shape;

/// A column's values in the cells that wait to be written, as its variable holds them.
class WaitingValues {
 public:
  WaitingValues(NetcdfDataset& dataset, const CellColumn& column, const Shape& chunk) {
    if (!column.words.empty()) {
      variable_ = dataset.add_flags(column.column, column.words, chunk);
      values_ = std::vector<signed char>();
    } else if (column.column.datatype == "integer") {
      variable_ = dataset.add_integers(column.column, chunk);
      values_ = std::vector<std::int64_t>();
    } else {
      variable_ = dataset.add_reals(column.column, chunk);
      values_ = std::vector<double>();
    }
  }

  NetcdfDataset::Number variable() const { return variable_; }

  void append(const double* values, std::size_t count) {
    const auto convert = [&](auto& list) {
      using Value = typename std::decay_t<decltype(list)>::value_type;
      std::transform(values, values + count, std::back_inserter(list),
                     [](double value) { return static_cast<Value>(value); });
    };
    std::visit(convert, values_);
  }

  /// From that one on.
  const void* from(std::size_t first) const {
    return std::visit([=](const auto& list) -> const void* { return list.data() + first; },
                      values_);
  }

  void clear() {
    std::visit([](auto& list) { list.clear(); }, values_);
  }

 private:
  NetcdfDataset::Number variable_ = 0;
  std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<signed char>> values_;
};

std::size_t cells_of(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

/// A chunk is read as a whole, and HDF5 has none of 4 GiB; only lines longer than this are cut.
constexpr std::size_t most_values_in_line = std::size_t{1} << 20;

class NetcdfCells : public CellWriter {
 public:
  NetcdfCells(const JobContext& context, std::vector<GridAxis> axes,
              const std::vector<CellColumn>& columns, CellPortions portions)
      : dataset_(context, std::move(axes)) {
    const bool lines = portions == CellPortions::lines;
    const Shape& shape = dataset_.shape();
    const Shape chunk = chunk_shape(shape, lines ? most_values_in_line : values_in_block);
    if (lines) cells_of_portion_ = cells_of(shape) / shape[0] * chunk[0];
    for (const CellColumn& column : columns) {
      columns_.emplace_back(dataset_, column, chunk);
      // Cells come in order: the chunk that is not yet whole is all that will be needed again.
      if (!lines) dataset_.set_cache(columns_.back().variable(), cells_of(chunk) * sizeof(double));
    }
    dataset_.begin_values();
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
    dataset_.commit();
  }

 private:
  void write_waiting() {
    throw_if_interrupted();
    std::size_t first = 0;
    for (const CellBlock& block : cell_blocks(dataset_.shape(), cells_written_, cells_waiting_)) {
      for (const WaitingValues& column : columns_)
        dataset_.write(column.variable(), block.start, block.count, column.from(first));
      first += cells_of(block.count);
    }
    for (WaitingValues& column : columns_) column.clear();
    cells_written_ += cells_waiting_;
    cells_waiting_ = 0;
  }

  NetcdfDataset dataset_;
  std::vector<WaitingValues> columns_;
  std::size_t cells_of_portion_ = values_in_block;
  std::size_t cells_written_ = 0;
  std::size_t cells_waiting_ = 0;
};

}  // namespace

std::unique_ptr<CellWriter> netcdf_cells(const JobContext& context, std::vector<GridAxis> axes,
                                         const std::vector<CellColumn>& columns,
                                         CellPortions portions) {
  return std::make_unique<NetcdfCells>(context, std::move(axes), columns, portions);
}

#else

std::unique_ptr<CellWriter> netcdf_cells(const JobContext&, std::vector<GridAxis>,
                                         const std::vector<CellColumn>&, CellPortions) {
  require_netcdf();
  return nullptr;
}

#endif

}  // namespace holdfast::program
