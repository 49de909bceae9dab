#include "io/grid/netcdf_grid.hpp"

#include "io/grid/netcdf_library.hpp"

#ifdef HOLDFAST_HAS_NETCDF
#include <cstdint>
#include <string>
#include <utility>

#include "io/grid/netcdf_dataset.hpp"
#include "io/text/text.hpp"
#include "process/interrupt.hpp"
#endif

namespace holdfast::program {

#ifdef HOLDFAST_HAS_NETCDF

namespace {

/// A chunk is read as a whole, and HDF5 has none of 4 GiB; only rows longer than this are cut.
constexpr std::size_t most_values_in_row = std::size_t{1} << 20;

/// A column's values in the rows that wait to be written; of the two lists one is in use.
struct Block {
  NetcdfDataset::Number variable = 0;
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
      : layout_(std::move(layout)),
        dataset_(context, {layout_.slow, layout_.fast}),
        chunk_(chunk_shape(dataset_.shape(), most_values_in_row)) {
    for (const GridColumn& column : layout_.columns) add_column(column);
    dataset_.begin_values();
  }

  void append_row(const std::vector<GridValues>& row) override {
    for (std::size_t i = 0; i < row.size(); ++i) blocks_[i].append(row[i], layout_.fast.count());
    if (++rows_waiting_ == chunk_[0]) write_block();
  }

  void commit() override {
    write_block();
    dataset_.commit();
  }

 private:
  void add_column(const GridColumn& column) {
    Block block;
    if (column.holds_flags()) {
      const auto words = split(column.flag_meanings, ' ');
      block.variable = dataset_.add_flags(column.column, {words.begin(), words.end()}, chunk_);
    } else {
      block.variable = dataset_.add_reals(column.column, chunk_);
    }
    blocks_.push_back(std::move(block));
  }

  void write_block() {
    throw_if_interrupted();
    for (Block& block : blocks_) {
      dataset_.write(block.variable, {rows_written_, 0}, {rows_waiting_, layout_.fast.count()},
                     block.values());
      block.clear();
    }
    rows_written_ += rows_waiting_;
    rows_waiting_ = 0;
  }

  GridLayout layout_;
  NetcdfDataset dataset_;
  NetcdfDataset::Shape chunk_;
  std::vector<Block> blocks_;
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
