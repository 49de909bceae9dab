#include "store/stored_grid.hpp"

#include <string>
#include <utility>
#include <vector>

#include "case/model/own/own_parts.hpp"
#include "output/grid/cell_writer.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

StorePlan plan_of(const JobContext& context) {
  StorePlan plan = {{"version", computed_by(context)}, {"job", context.job}};
  std::map<std::string, int> given;
  for (const auto& [name, text] : context.options) {
    const int number = ++given[name];
    plan.emplace(number == 1 ? name : name + " " + std::to_string(number), text);
  }
  if (context.on_packs) plan.emplace("--instructions", name_of(context.instructions));
  append_case(plan, context.case_data);
  return plan;
}

}  // namespace

StoreDescription store_description(const JobContext& context, const GridLayout& layout,
                                   std::size_t most) {
  if (has_own_plant(context.case_data))
    throw WrongInput(
        "--output: a store records its case, which cannot include a plant of your own: write .nc "
        "or .csv");
  StoreDescription store;
  store.origin = context;
  store.axes = layout.axes;
  store.columns = layout.columns;
  store.table_columns = layout.columns.size();
  for (const GridAxis& axis : layout.axes) store.grid.shape.push_back(axis.count());
  store.grid.chunk = chunk_shape(store.grid.shape, most);
  store.plan = plan_of(context);
  return store;
}

void refuse_chunk(const StoreFolder& store, std::int64_t chunk) {
  throw NoAnswer("the chunk file " + store.file_of(chunk).string() + " is " +
                 (store.has(chunk) ? "damaged" : "missing") +
                 ": repeat the command that made the store, with --resume if it has that option");
}

namespace {

/// The values of a chunk.
ChunkValues whole_chunk(const StoreFolder& store, std::int64_t chunk) {
  auto values = store.read(chunk);
  if (!values) refuse_chunk(store, chunk);
  return std::move(*values);
}

/// Writer of cells as the chunks of a Zarr store.
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

  /// Without effect: every chunk has appeared when it was full.
  void commit() override {}

 private:
  StoreFolder store_;
  WaitingCells waiting_;
};

}  // namespace

void append_stored(const StoreFolder& store, GridOutput& output) {
  std::vector<const double*> columns(store.description().table_columns);
  for (std::int64_t chunk = 0; chunk < store.grid().chunks(); ++chunk) {
    throw_if_interrupted();
    const ChunkValues values = whole_chunk(store, chunk);
    for (std::size_t k = 0; k < columns.size(); ++k) columns[k] = values[k].data();
    output.append(store.grid().cells_of(chunk), columns);
  }
}

void convert_store(const JobContext& context, const std::filesystem::path& folder) {
  const StoreFolder store = StoreFolder::open(folder);
  const StoreDescription& description = store.description();
  JobContext of_job = description.origin;
  of_job.output = context.output;
  of_job.quiet = context.quiet;
  of_job.yes = context.yes;
  GridLayout layout{description.axes, description.columns};
  layout.columns.resize(description.table_columns);
  GridOutput output(of_job, layout);
  append_stored(store, output);
  output.commit();
}

std::unique_ptr<CellWriter> zarr_cells(const JobContext& context, const GridLayout& layout) {
  return std::make_unique<ZarrCells>(context, layout);
}

}  // namespace holdfast::program
