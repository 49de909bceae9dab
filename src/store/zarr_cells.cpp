#include "output/grid/cell_writer.hpp"
#include "process/interrupt.hpp"
#include "store/stored_grid.hpp"

namespace holdfast::program {
namespace {

class ZarrCells final : public CellWriter {
 public:
  ZarrCells(const JobContext& context, const GridLayout& layout)
      : store_(StoreFolder::enter(*context.output, store_description(context, layout))),
        waiting_(store_.grid(), layout.columns.size()) {}

  void append(std::size_t cells, const std::vector<const double*>& columns) override {
    waiting_.append(cells, columns, [&](std::int64_t chunk, const ChunkValues& values) {
      throw_if_interrupted();
      store_.put(chunk, values);
    });
  }

  /// Every chunk has appeared by itself.
  void commit() override {}

 private:
  StoreFolder store_;
  WaitingCells waiting_;
};

}  // namespace

std::unique_ptr<CellWriter> zarr_cells(const JobContext& context, const GridLayout& layout) {
  return std::make_unique<ZarrCells>(context, layout);
}

}  // namespace holdfast::program
