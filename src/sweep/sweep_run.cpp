#include "sweep/sweep_plan.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "case/model/held_force.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/core/errors.hpp"
#include "io/text/table.hpp"
#include "jobs/columns.hpp"
#include "kernels/instruction_set.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/group/mpi_launch.hpp"
#include "process/group/process_group.hpp"
#include "process/interrupt.hpp"
#include "process/system_words.hpp"
#include "process/worker_threads.hpp"
#include "store/stored_grid.hpp"
#include "store/work_store.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;

/// Whether the result goes to a file of that name, beside which a work folder can lie.
bool has_named_output(const JobContext& context) {
  if (!context.output || *context.output == "-") return false;
  if (is_store_name(context.output)) return true;
  const std::string path = fs::absolute(*context.output).lexically_normal().string();
  if (path.rfind("/dev/", 0) == 0 || path.rfind("/proc/", 0) == 0) return false;
  std::error_code error;
  return !fs::exists(*context.output, error) || fs::is_regular_file(*context.output, error);
}

constexpr const char* passing_folder = "holdfast-sweep-";

/// What was left by sweeps for one run alone that were killed: nobody goes on with them.
void remove_left_work_stores() {
  std::error_code error;
  fs::directory_iterator entry(fs::temp_directory_path(error), error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error))
    if (entry->path().filename().string().rfind(passing_folder, 0) == 0)
      remove_left_work_store(entry->path());
}

/// The output itself, or the work store beside it, where an interrupted sweep is gone on with; else
/// one for this run alone.
fs::path store_folder(const JobContext& context, bool named) {
  if (is_store_name(context.output)) return *context.output;
  if (named) return fs::path(context.output->string() + ".zarr");
  remove_left_work_stores();
  std::string name = (fs::temp_directory_path() / passing_folder).string() + "XXXXXX";
  if (mkdtemp(name.data()) == nullptr)
    throw OutputError("cannot make the folder " + name + ": " + system_words(errno));
  return name;
}

/// The instruction set on which the last digits in a store depend; empty where there is none.
std::string recorded_instructions(const fs::path& folder) {
  const std::optional<StoreDescription> there = store_in(folder);
  if (!there || there->plan.count("--instructions") == 0) return "";
  return there->plan.at("--instructions");
}

/// What is wrong with the cells of a store, for a warning; empty where nothing is.
std::string faults_of(const SweepPlan& plan, const StoreFolder& store) {
  const auto& columns = store.description().columns;
  const auto outcome = static_cast<std::size_t>(
      std::find_if(columns.begin(), columns.end(),
                   [](const CellColumn& cells) {
                     return cells.column.name == metric_column(SweepMetric::outcome).column.name;
                   }) -
      columns.begin());
  std::int64_t diverging = 0, without_motion = 0, first = 0;
  for (std::int64_t chunk = 0; chunk < store.grid().chunks(); ++chunk) {
    throw_if_interrupted();
    const std::vector<double> outcomes = whole_chunk(store, chunk)[outcome];
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      const auto of_cell = static_cast<CellOutcome>(outcomes[i]);
      diverging += of_cell == CellOutcome::diverges ? 1 : 0;
      if (has_motion(of_cell)) continue;
      if (without_motion++ == 0)
        first = store.grid().first_cell(chunk) + static_cast<std::int64_t>(i);
    }
  }
  std::string text;
  if (diverging > 0) text = std::to_string(diverging) + " diverge";
  if (without_motion > 0)
    text += (text.empty() ? "" : ", ") + std::to_string(without_motion) +
            " have no motion, the first because: " + fault_of_cell(plan, first);
  return text.empty() ? text : "of " + std::to_string(plan.cells()) + " cells " + text;
}

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
    const int threads = worker_threads(context().threads, *group_);
    agree_on_instructions();
    make_collective_call(*group_, [this] { begin(); });
    make_collective_call(*group_, [this] { join(); });
    try {
      make_collective_call(*group_, [&] { fill(threads); });
      make_collective_call(*group_, [this] { conclude(); });
    } catch (...) {
      leave();
      throw;
    }
  }

 private:
  const JobContext& context() const { return plan_.context(); }
  bool is_first() const { return group_->rank() == 0; }
  bool is_to_stay() const { return is_store_name(context().output); }
  const StoreFolder& store() const { return work_ ? work_->store() : *store_; }

  /// All processes compute alike: with the set that was asked for, else with that of the store
  /// which is gone on with where all have it, else with the smallest of theirs.
  void agree_on_instructions() {
    const bool looks = is_first() && named_ && (plan_.options().resume || is_to_stay());
    const std::string recorded =
        looks ? recorded_instructions(store_folder(context(), named_)) : std::string();
    const auto texts =
        group_->exchange(std::string(name_of(context().instructions)) + " " + recorded);
    if (plan_.options().instructions_given) return;
    InstructionSet smallest = context().instructions;
    for (const std::string& text : texts)
      smallest = std::min(smallest, instruction_set_named(text.substr(0, text.find(' '))));
    const std::string of_store = texts.front().substr(texts.front().find(' ') + 1);
    for (const InstructionSet set : available_instruction_sets())
      if (set <= smallest && name_of(set) == of_store) return plan_.use(set);
    plan_.use(smallest);
  }

  void begin() {
    if (!is_first()) return;
    if (is_to_stay()) {
      store_ = StoreFolder::enter(*context().output, plan_.store());
      return;
    }
    output_.emplace(context(), plan_.layout());
    // What can be written is known now; a process that is killed shall leave nothing of it.
    if (named_) output_.reset();
    const fs::path folder = store_folder(context(), named_);
    try {
      work_.emplace(folder, plan_.store(), plan_.options().resume);
    } catch (...) {
      std::error_code ignored;
      if (!named_) fs::remove_all(folder, ignored);
      throw;
    }
  }

  void join() {
    if (is_first()) return;
    const fs::path folder = store_folder(context(), named_);
    if (!store_in(folder))
      throw WrongInput("no store in " + folder.string() +
                       "; all processes need a file system that they share");
    store_ = StoreFolder::enter(folder, plan_.store());
  }

  void fill(int threads) {
    const ChunkGrid& grid = plan_.grid();
    const auto compute = [this, &grid](std::int64_t chunk) {
      return compute_cells(plan_, grid.first_cell(chunk), grid.cells_of(chunk));
    };
    fill_store(context(), store(), *group_, threads,
               {"sweep, cells", compute, plan_.options().resume});
  }

  void conclude() {
    if (!is_first()) return;
    const std::string faults = faults_of(plan_, store());
    if (work_) {
      if (!output_) output_.emplace(context(), plan_.layout());
      append_stored(store(), *output_);
      output_->commit();
      work_->remove();
    }
    report_warning(faults, context().quiet);
    report_warning(held_force_warning_of(plan_), context().quiet);
  }

  /// After a fault: says how to go on, or removes what cannot be gone on with.
  void leave() noexcept {
    if (!is_first()) return;
    if (!named_) return remove_work_store();
    report_kept_chunks(
        store(), std::string("the same command") + (work_ ? " with --resume" : "") + " goes on");
  }

  void remove_work_store() noexcept {
    try {
      work_->remove();
    } catch (...) {
      // It stays until another sweep finds it.
    }
  }

  SweepPlan plan_;
  bool named_;  // the output is a file, and the work store stays beside it for --resume
  std::unique_ptr<ProcessGroup> group_;
  std::optional<GridOutput> output_;
  std::optional<StoreFolder> store_;  // one that stays, or that the first process has made
  std::optional<WorkStore> work_;
};

}  // namespace

void write_sweep(const JobContext& context, const SweepOptions& options) {
  if (options.resume && !has_named_output(context))
    throw WrongInput("--resume needs --output, the file beside which chunks are left");
  if (mpi_launch().size > 1 && !has_named_output(context))
    throw WrongInput(
        "--output: a sweep on several processes needs a file, beside which they share their "
        "chunks");
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
  table.row("chunks", static_cast<double>(plan.grid().chunks()), "");
  table.row("cells_of_chunk", static_cast<double>(plan.grid().cells_of_file()), "");
  table.row("samples", plan.samples(), "");
  table.row("cell_bytes", cells * numbers_of_cell * sizeof(double), "B");
  table.commit();
}

}  // namespace holdfast::program
