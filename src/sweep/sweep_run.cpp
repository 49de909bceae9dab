#include "sweep/sweep_plan.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "case/model/held_force.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/core/errors.hpp"
#include "io/text/table.hpp"
#include "jobs/charts/row_blocks.hpp"
#include "jobs/columns.hpp"
#include "kernels/instruction_set.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/group/mpi_launch.hpp"
#include "process/group/process_group.hpp"
#include "process/interrupt.hpp"
#include "process/progress.hpp"
#include "process/system_words.hpp"
#include "process/worker_threads.hpp"
#include "sweep/tiles/tile_file.hpp"
#include "sweep/tiles/tile_plan_file.hpp"
#include "sweep/tiles/tile_store.hpp"
#include "sweep/tiles/work_folder.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;

/// The instruction set of the tiles, on which their last digits depend, in their plan.
constexpr const char* instructions_entry = "--instructions";

/// Whether the result goes to a file of that name, beside which a work folder can lie.
bool has_named_output(const JobContext& context) {
  if (!context.output || *context.output == "-") return false;
  const std::string path = fs::absolute(*context.output).lexically_normal().string();
  if (path.rfind("/dev/", 0) == 0 || path.rfind("/proc/", 0) == 0) return false;
  std::error_code error;
  return !fs::exists(*context.output, error) || fs::is_regular_file(*context.output, error);
}

constexpr const char* passing_folder = "holdfast-sweep-";

/// What was left by sweeps for one run alone that were killed: nobody goes on with their tiles.
void remove_left_work_folders() {
  std::error_code error;
  fs::directory_iterator entry(fs::temp_directory_path(error), error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error))
    if (entry->path().filename().string().rfind(passing_folder, 0) == 0)
      remove_work_folder(entry->path());
}

/// Beside a named output, where an interrupted sweep is gone on with; else one for this run alone.
fs::path work_folder(const JobContext& context, bool named) {
  if (named) return fs::path(context.output->string() + ".tiles");
  remove_left_work_folders();
  std::string name = (fs::temp_directory_path() / passing_folder).string() + "XXXXXX";
  if (mkdtemp(name.data()) == nullptr)
    throw OutputError("cannot make the folder " + name + ": " + system_words(errno));
  return name;
}

/// What the tiles are parts of: the plan, computed by this program.
TilePlan tile_plan_of(const SweepPlan& plan) {
  TilePlan tiles = plan.tile_plan();
  tiles.entries.emplace(instructions_entry, name_of(plan.context().instructions));
  return tiles;
}

/// The instruction set of the tiles in a folder; empty where there are none or nothing says it.
std::string recorded_instructions(const fs::path& folder) {
  const std::optional<TilePlan> plan = plan_of_work_folder(folder);
  if (!plan || plan->entries.count(instructions_entry) == 0) return "";
  return plan->entries.at(instructions_entry);
}

/// What the faults of all tiles together are.
struct SweepFaults {
  std::int64_t diverging = 0;
  std::int64_t without_motion = 0;
  std::string first;

  void add(const TileResult& tile) {
    diverging += tile.diverging;
    without_motion += tile.without_motion;
    if (first.empty()) first = tile.first_fault;
  }

  std::string warning(std::int64_t cells) const {
    std::string text;
    if (diverging > 0) text = std::to_string(diverging) + " diverge";
    if (without_motion > 0)
      text += (text.empty() ? "" : ", ") + std::to_string(without_motion) +
              " have no motion, the first because: " + first;
    return text.empty() ? text : "of " + std::to_string(cells) + " cells " + text;
  }
};

/// The warning of the force as it is held, of the corner of a sweep where that matters most.
std::string held_force_warning_of(const SweepPlan& plan) {
  if (!plan.wants(SweepMetric::ratio_to_uncontrolled) && !plan.wants(SweepMetric::attenuates))
    return "";
  const std::vector<GridAxis>& axes = plan.layout().axes;
  const std::size_t ends = std::min<std::size_t>(axes.size(), 6);  // of which both are looked at
  std::string warning;
  double largest = 0.0;
  for (std::size_t corner = 0; corner < (std::size_t{1} << ends); ++corner) {
    std::int64_t cell = 0;
    for (std::size_t k = 0; k < axes.size(); ++k) {
      const auto count = static_cast<std::int64_t>(axes[k].count());
      cell = cell * count + ((corner >> k & 1U) != 0 ? count - 1 : 0);
    }
    try {
      const Case the_case = plan.case_of(cell);
      const double period = the_case.control.sampling_period;
      const double frequency = excitation_of(the_case).frequency;
      const double difference = std::abs(held_share(the_case, period, frequency) - 1.0);
      if (!(difference > largest)) continue;
      largest = difference;
      warning = held_force_warning(the_case, "ratios are to the true force's");
    } catch (const Refusal&) {  // not admissible, and told as the outcome of its cell
    } catch (const InvalidParameter&) {
    }
  }
  return warning;
}

/// One sweep in one of the processes that work on it.
class SweepRun {
 public:
  SweepRun(const JobContext& context, const SweepOptions& options)
      : plan_(context, options), named_(has_named_output(context)), group_(join_process_group()) {}

  void run() {
    threads_ = worker_threads(context().threads, *group_);
    agree_on_instructions();
    make_collective_call(*group_, [this] { begin(); });
    make_collective_call(*group_, [this] { join(); });
    try {
      make_collective_call(*group_, [this] { compute_tiles(); });
      end_progress();
      make_collective_call(*group_, [this] { assemble(); });
    } catch (...) {
      leave_tiles();
      throw;
    }
  }

 private:
  const JobContext& context() const { return plan_.context(); }
  bool is_first() const { return group_->rank() == 0; }

  /// All processes compute alike: with the set that was asked for, else with that of the tiles
  /// which are gone on with where all have it, else with the smallest of theirs.
  void agree_on_instructions() {
    const bool looks = is_first() && named_ && plan_.options().resume;
    const std::string recorded =
        looks ? recorded_instructions(work_folder(context(), named_)) : std::string();
    const auto texts =
        group_->exchange(std::string(name_of(context().instructions)) + " " + recorded);
    if (plan_.options().instructions_given) return;
    InstructionSet smallest = context().instructions;
    for (const std::string& text : texts)
      smallest = std::min(smallest, instruction_set_named(text.substr(0, text.find(' '))));
    const std::string of_tiles = texts.front().substr(texts.front().find(' ') + 1);
    for (const InstructionSet set : available_instruction_sets())
      if (set <= smallest && name_of(set) == of_tiles) return plan_.use(set);
    plan_.use(smallest);
  }

  void begin() {
    if (!is_first()) return;
    open_output();
    // What can be written is known now; a process that is killed shall leave nothing of it.
    if (named_) output_.reset();
    const fs::path folder = work_folder(context(), named_);
    store_ = TileStore::open(folder, tile_plan_of(plan_), plan_.options().resume);
    tiles_found_ = contents_of_work_folder(folder).tiles;
  }

  void open_output() {
    if (!output_) output_.emplace(context(), plan_.layout());
  }

  void join() {
    if (!is_first()) store_ = TileStore::join(work_folder(context(), named_), tile_plan_of(plan_));
  }

  void compute_tiles() {
    progress_.emplace(static_cast<std::uint64_t>(plan_.cells()), "sweep, cells",
                      is_first() && progress_wanted(context()));
    progress_->skip(cells_in(tiles_found_));
    std::atomic<bool> stop{false};
    parallel_rows(threads_, 1, threads_, 0, [&](int&, std::int64_t, std::int64_t) {
      try {
        work(stop);
      } catch (...) {
        if (!stop.exchange(true)) give_up_tiles();
        throw;
      }
    });
  }

  /// The other processes need not go on.
  void give_up_tiles() noexcept {
    try {
      group_->skip_tickets(plan_.tiles());
    } catch (...) {
      // They go on in vain; the fault that brought us here is the one to be told.
    }
  }

  /// What one thread does: the next tile, until there is none.
  void work(const std::atomic<bool>& stop) {
    while (!stop) {
      throw_if_interrupted();
      const std::int64_t tile = group_->take_ticket();
      if (tile >= plan_.tiles()) return;
      if (store_->has(tile)) continue;
      const TileResult result = compute_tile(plan_, tile);
      store_->put(tile, tile_bytes(result));
      ++tiles_computed_;
      show_others();
      progress_->advance(static_cast<std::uint64_t>(result.cells),
                         static_cast<std::uint64_t>(result.samples));
    }
  }

  /// Those handed out that were neither found nor computed here: the others have or compute them.
  void show_others() {
    if (!is_first() || group_->size() == 1) return;
    const std::int64_t taken = std::min(group_->tickets_taken(), plan_.tiles());
    progress_->set_elsewhere(cells_in(taken - std::min(taken, tiles_found_) - tiles_computed_));
  }

  /// All is computed.
  void end_progress() {
    progress_->set_elsewhere(cells_in(plan_.tiles() - tiles_found_ - tiles_computed_));
    progress_.reset();
  }

  std::uint64_t cells_in(std::int64_t tiles) const {
    return static_cast<std::uint64_t>(
        std::clamp(tiles * plan_.cells_of(0), std::int64_t{0}, plan_.cells()));
  }

  /// Puts the tiles together in their order, one at a time.
  void assemble() {
    if (!is_first()) return;
    SweepFaults faults;
    open_output();
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
    report_warning(faults.warning(plan_.cells()), context().quiet);
    report_warning(held_force_warning_of(plan_), context().quiet);
  }

  /// After a fault: says how to go on, or removes what cannot be gone on with.
  void leave_tiles() noexcept {
    if (!is_first() || !store_) return;
    try {
      if (!named_) {
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

  SweepPlan plan_;
  bool named_;  // the output is a file, and the work folder stays beside it for --resume
  std::unique_ptr<ProcessGroup> group_;
  int threads_ = 1;  // of this process
  std::optional<GridOutput> output_;
  std::optional<TileStore> store_;
  std::optional<Progress> progress_;
  std::int64_t tiles_found_ = 0;  // by the first process, of an earlier run
  std::atomic<std::int64_t> tiles_computed_{0};
};

}  // namespace

void write_sweep(const JobContext& context, const SweepOptions& options) {
  if (options.resume && !has_named_output(context))
    throw WrongInput("--resume needs --output, the file whose tiles are left");
  if (mpi_launch().size > 1 && !has_named_output(context))
    throw WrongInput(
        "--output: a sweep on several processes needs a file, beside which they share their tiles");
  SweepRun(context, options).run();
}

void write_sweep_size(const JobContext& context, const SweepOptions& options) {
  const SweepPlan plan(context, options);
  if (mpi_launch().rank > 0) return;
  JobContext to_screen = plan.context();
  to_screen.output.reset();  // the file is for the result
  Table table(to_screen, columns_of("sweep size"));
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
