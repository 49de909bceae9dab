#include "sweep_run.hpp"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "errors.hpp"
#include "exit.hpp"
#include "interrupt.hpp"
#include "mpi_launch.hpp"
#include "process_group.hpp"
#include "progress.hpp"
#include "row_blocks.hpp"
#include "sweep_cells.hpp"
#include "system_words.hpp"
#include "table.hpp"
#include "text.hpp"
#include "tile_result.hpp"
#include "work_folder.hpp"
#include "work_folder_plan.hpp"
#include "worker_threads.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;

/// Whether the result goes to a file of that name, beside which a work folder can lie.
bool has_named_output(const JobContext& context) {
  if (!context.output || *context.output == "-") return false;
  std::error_code error;
  return !fs::exists(*context.output, error) || fs::is_regular_file(*context.output, error);
}

/// Beside a named output, where an interrupted sweep is gone on with; else one for this run alone.
fs::path work_folder(const JobContext& context) {
  if (has_named_output(context)) return fs::path(context.output->string() + ".tiles");
  std::string name = (fs::temp_directory_path() / "holdfast-sweep-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw OutputError("cannot make the folder " + name + ": " + system_words(errno));
  return name;
}

/// A step that every process does; the fault of one ends all, each with its own message or the
/// first one's.
void do_together(ProcessGroup& group, const std::function<void()>& step) {
  std::exception_ptr own;
  std::string message;
  try {
    step();
  } catch (const std::exception& fault) {
    own = std::current_exception();
    message = fault.what();
  }
  const std::vector<std::string> faults = group.exchange(message);
  if (own) std::rethrow_exception(own);
  for (std::size_t rank = 0; rank < faults.size(); ++rank)
    if (!faults[rank].empty())
      throw NoAnswer("process " + std::to_string(rank) + " gave up: " + faults[rank]);
}

/// What the tiles are parts of: the plan, computed by this program.
TilePlan tile_plan_of(const SweepPlan& plan) {
  TilePlan tiles = plan.tile_plan();
  tiles.entries.emplace_back("instruction set", arithmetic());
  return tiles;
}

/// What the faults of all tiles together are.
struct SweepFaults {
  std::int64_t diverging = 0;
  std::int64_t invalid = 0;
  std::string first;

  void add(const TileResult& tile) {
    diverging += tile.diverging;
    invalid += tile.invalid;
    if (first.empty()) first = tile.first_fault;
  }

  std::string warning(std::int64_t cells) const {
    std::string text;
    if (diverging > 0) text = std::to_string(diverging) + " diverge";
    if (invalid > 0)
      text += (text.empty() ? "" : ", ") + std::to_string(invalid) +
              " are not admissible, the first because: " + first;
    return text.empty() ? text : "of " + std::to_string(cells) + " cells " + text;
  }
};

/// One sweep in one of the processes that work on it.
class SweepRun {
 public:
  SweepRun(const JobContext& context, const SweepQuestion& question)
      : context_(context), plan_(context, question), group_(join_process_group()) {}

  void run() {
    if (group_->size() > 1 && !has_named_output(context_))
      throw WrongInput(
          "--output: a sweep on several processes needs a file, beside which they "
          "share their tiles");
    threads_ = worker_threads(context_.threads, *group_);
    do_together(*group_, [this] { begin(); });
    do_together(*group_, [this] { join(); });
    try {
      do_together(*group_, [this] { compute_tiles(); });
      do_together(*group_, [this] { assemble(); });
    } catch (...) {
      leave_tiles();
      throw;
    }
  }

 private:
  bool is_first() const { return group_->rank() == 0; }

  void begin() {
    if (is_first()) {
      output_.emplace(context_, plan_.layout());
      store_ = TileStore::open(work_folder(context_), tile_plan_of(plan_), plan_.question().resume);
    }
  }

  void join() {
    if (!is_first()) store_ = TileStore::join(work_folder(context_), tile_plan_of(plan_));
  }

  void compute_tiles() {
    Progress progress(static_cast<std::uint64_t>(plan_.cells()), "sweep, cells",
                      is_first() && progress_wanted(context_));
    std::atomic<bool> stop{false};
    parallel_rows(threads_, 1, threads_, 0, [&](int&, std::int64_t, std::int64_t) {
      try {
        work(progress, stop);
      } catch (...) {
        stop = true;  // for the other threads
        throw;
      }
    });
  }

  /// What one thread does: the next tile, until there is none.
  void work(Progress& progress, const std::atomic<bool>& stop) {
    while (!stop) {
      throw_if_interrupted();
      const std::int64_t tile = group_->take_ticket();
      if (tile >= plan_.tiles()) return;
      const auto cells = static_cast<std::uint64_t>(plan_.cells_of(tile));
      ++own_tickets_;
      if (store_->has(tile)) {
        progress.skip(cells);
        continue;
      }
      const TileResult result = compute_tile(plan_, tile);
      store_->put(tile, tile_bytes(result));
      show(progress, cells, static_cast<std::uint64_t>(result.samples));
    }
  }

  void show(Progress& progress, std::uint64_t cells, std::uint64_t samples) {
    if (is_first() && group_->size() > 1) {
      const std::int64_t elsewhere =
          std::min(group_->tickets_taken(), plan_.tiles()) - own_tickets_.load();
      progress.set_elsewhere(static_cast<std::uint64_t>(std::max<std::int64_t>(elsewhere, 0)) *
                             static_cast<std::uint64_t>(plan_.cells_of(0)));
    }
    progress.advance(cells, samples);
  }

  /// Puts the tiles together in their order, one at a time.
  void assemble() {
    if (!is_first()) return;
    SweepFaults faults;
    const std::size_t columns = plan_.metrics().size();
    std::vector<const double*> values(columns);
    for (std::int64_t tile = 0; tile < plan_.tiles(); ++tile) {
      throw_if_interrupted();
      const TileResult result = tile_of_bytes(store_->get(tile), plan_.cells_of(tile), columns);
      for (std::size_t k = 0; k < columns; ++k) values[k] = result.column(k);
      output_->append(result.cells, values);
      faults.add(result);
    }
    output_->commit();
    store_->remove();
    report_warning(faults.warning(plan_.cells()), context_.quiet);
  }

  /// After a fault: says how to go on, or removes what cannot be gone on with.
  void leave_tiles() noexcept {
    if (!is_first() || !store_) return;
    try {
      if (!has_named_output(context_)) {
        store_->remove();
      } else {
        const std::int64_t kept = contents_of_work_folder(store_->folder()).tiles;
        report_error(finished_tiles(kept) + " of " + std::to_string(plan_.tiles()) +
                     " are kept in " + store_->folder().string() +
                     "; the same command with --resume goes on");
      }
    } catch (...) {
      // The fault that brought us here is the one to be told.
    }
  }

  JobContext context_;
  SweepPlan plan_;
  std::unique_ptr<ProcessGroup> group_;
  int threads_ = 1;                    // of this process
  std::optional<SweepOutput> output_;  // of the first process
  std::optional<TileStore> store_;
  std::atomic<std::int64_t> own_tickets_{0};
};

}  // namespace

void write_sweep(const JobContext& context, const SweepQuestion& question) {
  if (question.resume && !has_named_output(context))
    throw WrongInput("--resume needs --output, the file whose tiles are left");
  if (mpi_launch().size > 1 && !has_named_output(context))
    throw WrongInput(
        "--output: a sweep on several processes needs a file, beside which they share their tiles");
  SweepRun(context, question).run();
}

void write_sweep_size(const JobContext& context, const SweepQuestion& question) {
  const SweepPlan plan(context, question);
  JobContext to_screen = context;
  to_screen.output.reset();  // the file is for the result
  Table table(to_screen, {{"quantity", "", "what the row tells", "string"},
                          {"value", "", "in the unit of the row"},
                          {"unit", "", "SI; empty without dimension", "string"}});
  const auto cells = static_cast<double>(plan.cells());
  const auto numbers_of_cell = static_cast<double>(plan.metrics().size());
  table.row("axes", static_cast<double>(plan.layout().axes.size()), "");
  table.row("cells", cells, "");
  table.row("tiles", static_cast<double>(plan.tiles()), "");
  table.row("cells_of_tile", static_cast<double>(plan.cells_of(0)), "");
  table.row("samples", plan.samples(), "");
  table.row("tile_bytes", cells * numbers_of_cell * sizeof(double), "B");
  table.commit();
}

}  // namespace holdfast::program
