#include "jobs/orbit/motion_cells.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include "case/axes/axis.hpp"
#include "case/case_keys.hpp"
#include "case/model/loop_of_case.hpp"
#include "holdfast/phase_space/motion_map.hpp"
#include "jobs/columns.hpp"
#include "output/grid/grid_output.hpp"
#include "output/row_blocks.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

MapShape shape_of(const KeyGrid& grid) {
  return {static_cast<std::size_t>(grid.slow.axis.count),
          static_cast<std::size_t>(grid.fast.axis.count)};
}

/// Case of a cell; nullopt where it is not admissible.
std::optional<Case> case_of_cell(const Case& the_case, const KeyGrid& grid, std::size_t cell) {
  Case there = the_case;
  const auto at = static_cast<std::int64_t>(cell);
  set_case_value(there, grid.slow.key, grid.slow.axis.at(at / grid.fast.axis.count));
  set_case_value(there, grid.fast.key, grid.fast.axis.at(at % grid.fast.axis.count));
  if (!first_fault(there).message.empty()) return std::nullopt;
  return there;
}

template <class LoopOf>
std::vector<MapCell> cells_by(const JobContext& context, const KeyGrid& grid,
                              const MotionCellsQuestion& question, const LoopOf& loop_of) {
  using Loop = std::decay_t<decltype(loop_of(context.case_data))>;
  const auto loop_at = [&](std::size_t cell) -> std::optional<Loop> {
    const auto there = case_of_cell(context.case_data, grid, cell);
    if (!there) return std::nullopt;
    return loop_of(*there);
  };
  MotionMapOptions options;
  options.limits = {question.largest_period, 0, throw_if_interrupted};
  options.more_starts = question.more_starts;
  return motion_map(loop_at, shape_of(grid), initial_state_of(context.case_data), tiles_on(context),
                    options);
}

/// Whether all cells follow the paper's model, as judged from the four corners of the grid.
bool all_of_the_paper(const Case& the_case, const KeyGrid& grid, Switching switching) {
  const std::size_t last = shape_of(grid).cells() - 1, across = shape_of(grid).columns - 1;
  for (const std::size_t cell : {std::size_t{0}, across, last - across, last}) {
    const auto there = case_of_cell(the_case, grid, cell);
    if (there && !is_sampled(motion_kind_of(*there, switching))) return false;
  }
  return true;
}

/// Index of the outcome in the words of the column.
double outcome_number(const MapCell& cell) {
  constexpr std::array<OrbitOutcome, 8> order = {
      OrbitOutcome::certified,      OrbitOutcome::approaching,    OrbitOutcome::on_surface,
      OrbitOutcome::diverges,       OrbitOutcome::incommensurate, OrbitOutcome::none_found,
      OrbitOutcome::not_reproduced, OrbitOutcome::neutral};
  return static_cast<double>(std::find(order.begin(), order.end(), cell.outcome) - order.begin());
}

/// Smallest and largest value of a number over the motions of a cell.
template <class Number>
std::pair<double, double> extremes(const MapCell& cell, const Number& number) {
  if (cell.motions.empty()) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none};
  }
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const MappedMotion& motion : cell.motions) {
    least = std::min(least, number(motion));
    most = std::max(most, number(motion));
  }
  return {least, most};
}

void write_cells(const JobContext& context, const KeyGrid& grid,
                 const std::vector<MapCell>& cells) {
  GridOutput output(context,
                    {{grid_axis(grid.slow), grid_axis(grid.fast)}, cell_columns_of("motion map")});
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (const MapCell& cell : cells) {
    const MappedMotion* const start = cell.from_start();
    const auto periods = extremes(
        cell, [](const auto& motion) { return static_cast<double>(motion.forcing_periods); });
    const auto amplitudes = extremes(cell, [](const auto& motion) { return motion.amplitude; });
    const std::array<double, 10> row = {
        outcome_number(cell),
        start != nullptr ? static_cast<double>(start->forcing_periods) : 0.0,
        start != nullptr ? start->period : none,
        start != nullptr ? start->amplitude : none,
        start != nullptr ? start->border_share : none,
        static_cast<double>(cell.motions.size()),
        cell.motions.empty() ? 0.0 : periods.first,
        cell.motions.empty() ? 0.0 : periods.second,
        amplitudes.first,
        amplitudes.second};
    std::vector<const double*> columns;
    columns.reserve(row.size());
    for (const double& value : row) columns.push_back(&value);
    output.append(1, columns);
  }
  output.commit();
}

}  // namespace

void write_motion_cells(const JobContext& context, const MotionCellsQuestion& question) {
  const Case& the_case = context.case_data;
  const KeyGrid grid =
      key_grid("--map", question.axes,
               "--map backlash.width=0.0005:0.002:31 --map control.sampling_period=0.001:0.012:12",
               1'000'000, [&](const std::string& text) {
                 KeyAxis axis = parse_key_axis("--map", text);
                 case_value(the_case, axis.key);  // throws where there is no such number
                 require_admissible("--map " + text, axis.key, axis.axis.min, axis.axis.max);
                 return axis;
               });
  const Switching switching = question.switching;
  const std::vector<MapCell> cells =
      all_of_the_paper(the_case, grid, switching)
          ? cells_by(context, grid, question,
                     [](const Case& there) { return ideal_loop_of(there); })
          : cells_by(context, grid, question,
                     [&](const Case& there) { return implemented_loop_of(there, switching); });
  write_cells(context, grid, cells);
}

}  // namespace holdfast::program
