#include <algorithm>
#include <utility>
#include <vector>

#include "io/grid/cell_writer.hpp"
#include "kernels/instruction_set.hpp"
#include "process/interrupt.hpp"
#include "store/stored_grid.hpp"

namespace holdfast::program {
namespace {

/// Cells that come in order, kept until a chunk is full.
class ZarrCells final : public CellWriter {
 public:
  ZarrCells(const JobContext& context, const GridLayout& layout)
      : store_(StoreFolder::enter(*context.output, store_description(context, layout))),
        waiting_(layout.columns.size()) {}

  void append(std::size_t cells, const std::vector<const double*>& columns) override {
    for (std::size_t done = 0; done < cells;) {
      const auto wanted = static_cast<std::size_t>(store_.grid().cells_of(chunk_));
      const std::size_t taken = std::min(wanted - waiting_.front().size(), cells - done);
      for (std::size_t k = 0; k < columns.size(); ++k)
        waiting_[k].insert(waiting_[k].end(), columns[k] + done, columns[k] + done + taken);
      done += taken;
      if (waiting_.front().size() == wanted) put();
    }
  }

  /// Every chunk has appeared by itself.
  void commit() override {}

 private:
  void put() {
    throw_if_interrupted();
    store_.put(chunk_, waiting_);
    for (std::vector<double>& column : waiting_) column.clear();
    // Behind the last one there is none to be asked for.
    if (chunk_ + 1 < store_.grid().chunks()) ++chunk_;
  }

  StoreFolder store_;
  ChunkValues waiting_;
  std::int64_t chunk_ = 0;
};

}  // namespace

std::unique_ptr<CellWriter> zarr_cells(const JobContext& context, const GridLayout& layout) {
  return std::make_unique<ZarrCells>(context, layout);
}

}  // namespace holdfast::program
