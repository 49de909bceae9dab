#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "case/case_keys.hpp"
#include "case/job_context.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "jobs/family/family.hpp"
#include "process/memo.hpp"
#include "store/fill_store.hpp"
#include "store/store_description.hpp"
#include "sweep/sweep_metric.hpp"

namespace holdfast::program {

/// Question to the job `sweep`.
struct SweepOptions {
  std::vector<std::string> axes;     // KEY=AXIS, the first slowest
  std::vector<std::string> metrics;  // by name; none: usual_metrics()
  double duration = 20.0;            // s
  std::int64_t largest_period =
      OrbitLimits{}.largest_period;  // samples, of the search for an orbit
  Switching switching = Switching::sampled;
  bool best_gain = false;        // D of each cell is that of least steady amplitude
  std::int64_t chunk_cells = 0;  // most cells of a chunk; 0: chosen from the plan
  bool resume = false;
  std::string part;                 // K/N: the K-th of N parts of a store; empty: all
  bool instructions_given = false;  // --instructions was: they are not to be chosen
  int members = 0;                  // of the case's family, in place of axes; 0: axes
};

/// The cells of a sweep: the product of any number of axes over keys of a case, numbered with the
/// first axis slowest, in the chunks of a store; or members of the case's family. Nothing in it
/// grows with the number of cells, the members apart.
///
/// Throws WrongInput from the constructor for axes that are not admissible or are none, for an
/// unknown metric, and for more than 2⁵³ cells; a value that its key does not admit is no fault of
/// the plan but the outcome of its cells.
class SweepPlan {
 public:
  SweepPlan(const JobContext& context, const SweepOptions& options);

  std::int64_t cells() const { return layout_.cells(); }
  const ChunkGrid& grid() const { return grid_; }

  const GridLayout& layout() const { return layout_; }
  const std::vector<SweepMetric>& metrics() const { return metrics_; }
  bool wants(SweepMetric metric) const;
  const SweepOptions& options() const { return options_; }

  /// The context that was given, its case's plant reduced where no axis shapes that.
  const JobContext& context() const { return context_; }

  /// Computes on the packs of another instruction set from now on.
  void use(InstructionSet set) { context_.instructions = set; }

  /// The case of a cell. Throws WrongInput, or NoAnswer where its plant cannot be reduced. Any
  /// thread may ask.
  Case case_of(std::int64_t cell) const;
  const std::vector<FamilyMember>& members() const { return members_; }
  /// Its value on an axis.
  double axis_value(std::size_t axis, std::int64_t cell) const;

  /// Samples of the motions of all cells, those without control not counted; cells that are not
  /// admissible count as none. To a few digits where the sampling periods are more than a million.
  double samples() const { return samples_; }

  /// The store of the cells: the metrics that were asked for and, if it is not one of them, the
  /// outcome.
  StoreDescription store() const;

 private:
  void settle_case();
  Case reduced_case(const std::vector<std::string>& overrides) const;
  void require_loops() const;
  double counted_samples() const;
  double chosen_chunk_cells() const;
  StorePlan store_plan() const;

  JobContext context_;
  SweepOptions options_;
  std::vector<SweepMetric> metrics_;
  std::vector<FamilyMember> members_;
  GridLayout layout_;
  std::vector<std::size_t> shaping_axes_;  // those that change what the plant is reduced from
  /// The case by their values, its plant reduced; where there are such axes. A reduction takes some
  /// tenths of a second, and many cells share theirs.
  std::shared_ptr<Memo<std::vector<std::string>, std::shared_future<Case>>> reduced_cases_;
  double samples_ = 0.0;
  ChunkGrid grid_;
};

/// Computes cells in a run, the columns of the plan's store(); a cell that diverges or is not
/// admissible is a value among the others. What a cell gets does not depend on its neighbours; its
/// last digits do on the instruction set of the plan's context. Throws Interrupted.
ChunkResult compute_cells(const SweepPlan& plan, std::int64_t first, std::int64_t count);

/// Why a cell has no motion, or one that cannot be followed; empty where neither is so. Computes
/// it.
std::string fault_of_cell(const SweepPlan& plan, std::int64_t cell);

/// Computes a sweep and writes it. Its cells are a store from the first chunk on, the output itself
/// where that is a `.zarr`; else a work store beside the output, of which table or netCDF file are
/// made at the end. Any number of processes fill a `.zarr` together.
///
/// Throws WrongInput for what SweepPlan, GridOutput and StoreFolder refuse, NoAnswer and
/// OutputError as they do, Interrupted; where chunks are left to be gone on with, standard error
/// says so.
void write_sweep(const JobContext& context, const SweepOptions& options);

/// Writes to standard output how large a sweep would be, and computes nothing: axes, cells, chunks,
/// samples, bytes of the cells. Of several processes the first one writes.
void write_sweep_size(const JobContext& context, const SweepOptions& options);

}  // namespace holdfast::program
