#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "case/case_keys.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "process/job_context.hpp"
#include "sweep/reduced_cases.hpp"
#include "sweep/sweep_metric.hpp"
#include "sweep/tiles/tile_store.hpp"

namespace holdfast::program {

/// What the job `sweep` was asked.
struct SweepOptions {
  std::vector<std::string> axes;     // KEY=AXIS, the first slowest
  std::vector<std::string> metrics;  // by name; none: usual_metrics()
  double duration = 20.0;            // s
  std::int64_t largest_period =
      OrbitLimits{}.largest_period;  // samples, of the search for an orbit
  Switching switching = Switching::sampled;
  bool best_gain = false;       // D of each cell is that of least steady amplitude
  std::int64_t tile_cells = 0;  // cells of a tile; 0: chosen from the plan
  bool resume = false;
  bool instructions_given = false;  // --instructions was: they are not to be chosen
};

/// The cells of a sweep: the product of any number of axes over keys of a case, numbered with the
/// first axis slowest, in tiles of equally many. Nothing in it grows with the number of cells.
///
/// Throws WrongInput from the constructor for axes that are not admissible or are none, for an
/// unknown metric, and for more than 2⁵³ cells; a value that its key does not admit is no fault of
/// the plan but the outcome of its cells.
class SweepPlan {
 public:
  SweepPlan(const JobContext& context, const SweepOptions& options);

  std::int64_t cells() const { return layout_.cells(); }
  std::int64_t tiles() const { return (cells() + tile_cells_ - 1) / tile_cells_; }
  std::int64_t first_cell(std::int64_t tile) const { return tile * tile_cells_; }
  std::int64_t cells_of(std::int64_t tile) const;

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

  /// Samples of the motions of all cells, those without control not counted; cells that are not
  /// admissible count as none. To a few digits where the sampling periods are more than a million.
  double samples() const { return samples_; }

  /// What the bytes of a tile depend on.
  TilePlan tile_plan() const;

 private:
  void settle_case();
  double counted_samples() const;
  std::int64_t chosen_tile_cells() const;
  double axis_value(std::size_t axis, std::int64_t cell) const;

  JobContext context_;
  SweepOptions options_;
  std::vector<SweepMetric> metrics_;
  GridLayout layout_;
  std::vector<std::size_t> shaping_axes_;  // those that change what the plant is reduced from
  std::shared_ptr<const ReducedCases> reduced_cases_;  // where there are such axes
  double samples_ = 0.0;
  std::int64_t tile_cells_ = 1;
};

/// Computes the cells of one tile; a cell that diverges or is not admissible is a value among the
/// others. What a cell gets does not depend on its neighbours; its last digits do on the
/// instruction set of the plan's context. Throws Interrupted.
TileResult compute_tile(const SweepPlan& plan, std::int64_t tile);

/// Computes a sweep and writes it: tiles are handed out to the threads of all processes, kept in a
/// work folder beside the output as they finish, and put together at the end.
///
/// Throws WrongInput for what SweepPlan, GridOutput and TileStore refuse, NoAnswer and OutputError
/// as they do, Interrupted; where tiles are left for --resume, standard error says so.
void write_sweep(const JobContext& context, const SweepOptions& options);

/// Writes to standard output how large a sweep would be, and computes nothing: axes, cells, tiles,
/// samples, bytes of the tiles. Of several processes the first one writes.
void write_sweep_size(const JobContext& context, const SweepOptions& options);

}  // namespace holdfast::program
