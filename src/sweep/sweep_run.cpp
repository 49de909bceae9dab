#include "sweep/sweep_plan.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "case/model/conditioning.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/core/errors.hpp"
#include "io/file/own_folder.hpp"
#include "jobs/columns.hpp"
#include "kernels/instruction_set.hpp"
#include "output/table.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "store/stored_grid.hpp"
#include "store/work_store.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;

/// Whether the output is a named regular file or store, beside which a work folder can be kept.
bool has_named_output(const JobContext& context) {
  if (!context.output || *context.output == "-") return false;
  if (is_store_name(context.output)) return true;
  const std::string path = fs::absolute(*context.output).lexically_normal().string();
  if (path.rfind("/dev/", 0) == 0 || path.rfind("/proc/", 0) == 0) return false;
  std::error_code error;
  return !fs::exists(*context.output, error) || fs::is_regular_file(*context.output, error);
}

constexpr const char* passing_folder = "holdfast-sweep-";

/// Folder of the chunks: output, work store beside it (continued if interrupted), or temporary.
fs::path store_folder(const JobContext& context, bool named) {
  if (is_store_name(context.output)) return *context.output;
  if (named) return fs::path(context.output->string() + ".zarr");
  // Temporary folders of killed sweeps are never continued.
  for (const fs::path& left : passing_folders(passing_folder)) remove_left_work_store(left);
  return new_passing_folder(passing_folder);
}

constexpr std::int64_t no_cell = std::numeric_limits<std::int64_t>::max();

/// Numbers of cells that diverge, have no motion or are chaotic, and the first without motion.
struct FaultCounts {
  std::int64_t diverging = 0, without_motion = 0, chaotic = 0, first = no_cell;
};

/// Counter of the cells that diverge, have no motion or are chaotic. Thread-safe.
class SweepFaults {
 public:
  /// Counts cells. @param verdicts  verdicts of the same cells; empty if they were not requested
  void add(std::int64_t first_cell, const std::vector<double>& outcomes,
           const std::vector<double>& verdicts) {
    FaultCounts found;
    found.chaotic =
        std::count(verdicts.begin(), verdicts.end(), static_cast<double>(AttractorType::chaotic));
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      const auto outcome = static_cast<CellOutcome>(outcomes[i]);
      found.diverging += outcome == CellOutcome::diverges ? 1 : 0;
      if (has_motion(outcome)) continue;
      if (found.without_motion++ == 0) found.first = first_cell + static_cast<std::int64_t>(i);
    }
    add(found);
  }

  /// A warning of cells that diverge or have no motion; empty if there are none.
  std::string text(const SweepPlan& plan) const {
    std::string text;
    if (all_.diverging > 0) text = std::to_string(all_.diverging) + " diverge";
    if (all_.without_motion > 0)
      text += (text.empty() ? "" : ", ") + std::to_string(all_.without_motion) +
              " have no motion; reason of the first: " + fault_of_cell(plan, all_.first);
    return text.empty() ? text : "of " + std::to_string(plan.cells()) + " cells, " + text;
  }

  /// A warning of chaotic cells; empty if there are none.
  std::string chaos_text(const SweepPlan& plan) const {
    if (all_.chaotic == 0) return "";
    return "of " + std::to_string(plan.cells()) + " cells, " + std::to_string(all_.chaotic) +
           " are chaotic: their motions depend on rounding after some time, so each metric "
           "describes one of many possible motions";
  }

 private:
  void add(const FaultCounts& found) {
    const std::lock_guard<std::mutex> guard(mutex_);
    all_.diverging += found.diverging;
    all_.without_motion += found.without_motion;
    all_.chaotic += found.chaotic;
    all_.first = std::min(all_.first, found.first);
  }

  FaultCounts all_;
  std::mutex mutex_;
};

std::size_t column_of(const StoreDescription& store, SweepMetric metric) {
  const std::string& name = metric_column(metric).column.name;
  std::size_t place = 0;
  while (store.columns[place].column.name != name) ++place;
  return place;
}

/// The held-force warning for the corner of the sweep with the largest effect; empty if negligible.
std::string held_force_warning_of(const SweepPlan& plan) {
  if (!plan.wants(SweepMetric::ratio_to_uncontrolled) && !plan.wants(SweepMetric::attenuates))
    return "";
  const std::vector<GridAxis>& axes = plan.layout().axes;
  const std::size_t ends = std::min<std::size_t>(axes.size(), 6);  // axes tried at both ends
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
      warning = held_force_warning(
          the_case,
          "ratios are relative to the vibration without control under the continuous force");
    } catch (const Refusal&) {  // not admissible: the outcome of its cell
    } catch (const InvalidParameter&) {
    }
  }
  return warning;
}

/// A warning that --best-gain ignores play; "" if no cell has play.
std::string best_gain_warning(const SweepPlan& plan) {
  const auto& backlash = plan.context().case_data.backlash;
  const std::vector<GridAxis>& axes = plan.layout().axes;
  const bool varies = std::any_of(axes.begin(), axes.end(), [](const GridAxis& axis) {
    return axis.column.name.rfind("backlash.", 0) == 0;
  });
  if (!plan.options().best_gain || !(varies || (backlash.width > 0.0 && backlash.law != "none")))
    return "";
  return "--best-gain chooses D for the loop without play, but the metrics are those of the motion "
         "with play: another D may be better";
}

/// The part of the store given by K/N; all of it for an empty text.
StorePart part_of(const SweepPlan& plan, const std::string& text) {
  if (text.empty()) return {};
  const std::size_t bar = text.find('/');
  const double number = parse_number(text.substr(0, bar)).value_or(0.0);
  const double of = bar == std::string::npos ? 0.0 : parse_number(text.substr(bar + 1)).value_or(0);
  const bool whole = number == std::floor(number) && of == std::floor(of);
  const auto chunks = static_cast<double>(plan.grid().chunks());
  if (!whole || number < 1.0 || number > of || of > chunks)
    throw WrongInput("--part " + text + ": expected K/N with 1 <= K <= N, N at most the " +
                     format_number(chunks) + " chunks of the store");
  if (!is_store_name(plan.context().output))
    throw WrongInput("--part needs a store: give --output NAME.zarr");
  return {static_cast<std::int64_t>(number), static_cast<std::int64_t>(of)};
}

/// A value of a metric, and the number of the member that has it.
using MemberValue = std::pair<double, std::size_t>;

/// Writes, for each numeric metric, mean, extremes and the 5, 50 and 95 % quantiles over the
/// members (nearest rank), with the members that have the least and the largest value.
void write_quantiles(const SweepPlan& plan, const StoreFolder& store) {
  Table table(plan.context(), columns_of("sweep of a family"));
  const std::size_t outcome = column_of(store.description(), SweepMetric::outcome);
  for (std::size_t k = 0; k < plan.metrics().size(); ++k) {
    const Column& column = metric_column(plan.metrics()[k]).column;
    if (column.datatype == "string") continue;
    std::vector<MemberValue> values;
    double sum = 0.0;
    for (std::int64_t chunk = 0, cell = 0; chunk < plan.grid().chunks(); ++chunk) {
      const auto stored = store.read_column(k, chunk);
      const auto outcomes = store.read_column(outcome, chunk);
      if (!stored || !outcomes) refuse_chunk(store, chunk);
      for (std::size_t i = 0; i < stored->size(); ++i, ++cell) {
        const double value = (*stored)[i];
        // A whole number of a member without motion is stored as 0, which is not its value.
        if (std::isnan(value) || !has_motion(static_cast<CellOutcome>((*outcomes)[i]))) continue;
        values.emplace_back(value, static_cast<std::size_t>(cell));
        sum += value;
      }
    }
    if (values.empty()) continue;
    std::sort(values.begin(), values.end());
    const auto at_share = [&](double share) {
      const double rank = std::ceil(share * static_cast<double>(values.size()));
      return values[static_cast<std::size_t>(std::max(rank, 1.0)) - 1].first;
    };
    table.row(column.name, column.unit, static_cast<std::int64_t>(values.size()),
              sum / static_cast<double>(values.size()), values.front().first, at_share(0.05),
              at_share(0.5), at_share(0.95), values.back().first,
              plan.members()[values.front().second].text(),
              plan.members()[values.back().second].text());
  }
  table.commit();
}

/// One run of a sweep, which other processes may share.
class SweepRun {
 public:
  SweepRun(const JobContext& context, const SweepOptions& options)
      : plan_(context, options),
        part_(part_of(plan_, options.part)),
        named_(options.members == 0 && has_named_output(context)) {
    if (is_of_family() && is_store_name(context.output))
      throw WrongInput("--family writes a table of quantiles: give an --output that ends in .csv");
  }

  void run() {
    choose_instructions();
    begin();
    try {
      fill();
      conclude();
    } catch (...) {
      leave();
      throw;
    }
  }

 private:
  const JobContext& context() const { return plan_.context(); }
  bool is_of_family() const { return !plan_.members().empty(); }
  bool is_to_stay() const { return is_store_name(context().output); }
  const StoreFolder& store() const { return work_ ? work_->store() : *store_; }

  /// Selects the requested instruction set, else that of the continued store if available.
  void choose_instructions() {
    if (plan_.options().instructions_given || !named_ || !(plan_.options().resume || is_to_stay()))
      return;
    const auto there = store_in(store_folder(context(), named_));
    if (!there || there->plan.count("--instructions") == 0) return;
    for (const InstructionSet set : available_instruction_sets())
      if (set <= context().instructions && name_of(set) == there->plan.at("--instructions"))
        return plan_.use(set);
  }

  void begin() {
    if (is_to_stay()) {
      store_ = StoreFolder::enter(*context().output, plan_.store());
      return;
    }
    if (!is_of_family()) output_.emplace(context(), plan_.layout());
    // The output is known to be writable. Closed, it leaves no part if the process is killed.
    if (named_) output_.reset();
    const fs::path folder = store_folder(context(), named_);
    try {
      work_.emplace(folder, plan_.store(), plan_.options().resume);
    } catch (...) {
      std::error_code ignored;
      if (!named_) fs::remove(folder, ignored);
      throw;
    }
  }

  void fill() {
    const ChunkGrid& grid = plan_.grid();
    const std::size_t outcome = column_of(store().description(), SweepMetric::outcome);
    const bool judges = plan_.wants(SweepMetric::verdict);
    const std::size_t verdict =
        judges ? column_of(store().description(), SweepMetric::verdict) : outcome;
    const auto compute = [&, outcome, verdict, judges](std::int64_t chunk) {
      ChunkResult result = compute_cells(plan_, grid.first_cell(chunk), grid.cells_of(chunk));
      faults_.add(grid.first_cell(chunk), result.values[outcome],
                  judges ? result.values[verdict] : std::vector<double>());
      return result;
    };
    const auto found = [&, outcome, verdict, judges](std::int64_t chunk) {
      const auto outcomes = store().read_column(outcome, chunk);
      const auto verdicts = judges ? store().read_column(verdict, chunk) : std::vector<double>();
      if (!outcomes || !verdicts) refuse_chunk(store(), chunk);
      faults_.add(grid.first_cell(chunk), *outcomes, *verdicts);
    };
    fill_store(context(), store(), {"sweep, cells", compute, found, plan_.options().resume, part_});
  }

  void conclude() {
    if (part_.of > 1) return;  // other parts may not be computed yet
    if (is_of_family()) {
      write_quantiles(plan_, store());
      work_->remove();
    } else if (work_) {
      if (!output_) output_.emplace(context(), plan_.layout());
      append_stored(store(), *output_);
      output_->commit();
      work_->remove();
    }
    report_warning(faults_.text(plan_), context().quiet);
    report_warning(faults_.chaos_text(plan_), context().quiet);
    report_warning(best_gain_warning(plan_), context().quiet);
    report_warning(held_force_warning_of(plan_), context().quiet);
  }

  /// After a fault: reports how to continue, or removes a store that cannot be continued.
  void leave() noexcept {
    if (named_)
      return report_kept_chunks(store(), std::string("repeat the same command") +
                                             (work_ ? " with --resume" : "") + " to continue");
    try {
      work_->remove();
    } catch (...) {
      // The next sweep removes it.
    }
  }

  SweepPlan plan_;
  StorePart part_;
  bool named_;  // the output has a name; its work store is kept for --resume
  std::optional<GridOutput> output_;
  std::optional<StoreFolder> store_;  // the output, if it is a store
  std::optional<WorkStore> work_;
  SweepFaults faults_;
};

}  // namespace

void write_sweep(const JobContext& context, const SweepOptions& options) {
  if (options.resume && !has_named_output(context))
    throw WrongInput("--resume continues an earlier run: give the same --output as that run");
  SweepRun(context, options).run();
}

void write_sweep_size(const JobContext& context, const SweepOptions& options) {
  const SweepPlan plan(context, options);
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
