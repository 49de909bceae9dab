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

/// Options of the job `sweep`.
struct SweepOptions {
  std::vector<std::string> axes;     // KEY=AXIS, the first slowest
  std::vector<std::string> metrics;  // names; empty: usual_metrics()
  double duration = 20.0;            // s
  std::int64_t largest_period =
      OrbitLimits{}.largest_period;  // samples, of the search for an orbit
  Switching switching = Switching::sampled;
  bool best_gain = false;        // whether each cell has the D of least steady amplitude
  std::int64_t chunk_cells = 0;  // most cells of a chunk; 0: chosen from the plan
  bool resume = false;
  std::string part;                 // K/N: the K-th of N parts of a store; empty: all
  bool instructions_given = false;  // whether --instructions was given
  int members = 0;                  // members of the case's family that replace axes; 0: axes
};

/// Plan of a sweep: its cells and their chunks in a store. Cells are the points of a grid over keys
/// of a case, numbered with the first axis slowest, or members of the case's family. The memory
/// needed grows with the number of members, but not with that of grid cells.
///
/// The constructor throws WrongInput for missing or inadmissible axes, an unknown metric, and more
/// than 2⁵³ cells. A value that its key does not admit is no error: its cells are invalid.
class SweepPlan {
 public:
  SweepPlan(const JobContext& context, const SweepOptions& options);

  std::int64_t cells() const { return layout_.cells(); }
  const ChunkGrid& grid() const { return grid_; }

  const GridLayout& layout() const { return layout_; }
  const std::vector<SweepMetric>& metrics() const { return metrics_; }
  bool wants(SweepMetric metric) const;
  const SweepOptions& options() const { return options_; }

  /// The given context; the plant of its case is reduced, unless an axis changes the reduction.
  const JobContext& context() const { return context_; }

  /// Selects another SIMD instruction set for all later cells.
  void use(InstructionSet set) { context_.instructions = set; }

  /// The case of a cell. Throws WrongInput; NoAnswer if its plant cannot be reduced. Thread-safe.
  Case case_of(std::int64_t cell) const;
  const std::vector<FamilyMember>& members() const { return members_; }
  double axis_value(std::size_t axis, std::int64_t cell) const;

  /// Number of samples of the controlled motions of all cells; a cell with an inadmissible sampling
  /// period has none. An estimate if the axis of sampling periods has over a million values.
  double samples() const { return samples_; }

  /// The description of the store of the cells, with the requested metrics and the outcome.
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
  std::vector<std::size_t> shaping_axes_;  // axes that change the reduction of the plant
  /// Cache of cases with reduced plants, by the values on these axes; null without such axes.
  std::shared_ptr<Memo<std::vector<std::string>, std::shared_future<Case>>> reduced_cases_;
  double samples_ = 0.0;
  ChunkGrid grid_;
};

/// Computes `count` consecutive cells from `first`: the columns of the plan's store(). A cell that
/// diverges or is not admissible has values too. Results do not depend on neighbouring cells; their
/// last digits depend on the instruction set of the plan's context. Throws Interrupted.
ChunkResult compute_cells(const SweepPlan& plan, std::int64_t first, std::int64_t count);

/// Computes a cell and returns the reason if it has no computable motion; else "".
std::string fault_of_cell(const SweepPlan& plan, std::int64_t cell);

/// Computes a sweep and writes it. Each chunk is stored once computed: in the output, if that is a
/// `.zarr`, else in a work store beside the output, from which the table or netCDF file is made at
/// the end. Several processes can fill one `.zarr` together.
///
/// Throws WrongInput, NoAnswer and OutputError as SweepPlan, GridOutput and StoreFolder do, and
/// Interrupted. If the kept chunks can be continued, standard error says so.
void write_sweep(const JobContext& context, const SweepOptions& options);

/// Writes the size of a sweep to standard output without computing it: axes, cells, chunks, cells
/// of a chunk, samples and bytes of the cells. Of several processes only the first one writes.
void write_sweep_size(const JobContext& context, const SweepOptions& options);

}  // namespace holdfast::program
