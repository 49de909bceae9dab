#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "holdfast/stability/chart/chart.hpp"
#include "holdfast/stability/chart/circle_arcs.hpp"
#include "holdfast/stability/chart/joined_boxes.hpp"
#include "holdfast/stability/chart/proved_chart.hpp"

namespace holdfast {

namespace detail {

/// A box and the arcs of the circle on which a loop of it may have a root.
struct CrossedBox {
  GainBox gains;
  CircleArcs::Arcs arcs;
};

/// Cells of a grid with indices from … to in P and in D.
struct CellRange {
  std::int64_t p_from, p_to, d_from, d_to;

  GainBox box(const GainGrid& grid) const {
    return {grid.proportional.at(p_from), grid.proportional.at(p_to),
            grid.differential.at(d_from), grid.differential.at(d_to)};
  }
  bool is_cell() const { return p_to - p_from == 1 && d_to - d_from == 1; }
  /// The two halves across the longer side.
  std::pair<CellRange, CellRange> halves() const {
    std::pair<CellRange, CellRange> both(*this, *this);
    if (p_to - p_from > d_to - d_from)
      both.first.p_to = both.second.p_from = (p_from + p_to) / 2;
    else
      both.first.d_to = both.second.d_from = (d_from + d_to) / 2;
    return both;
  }
};

/// The chart of a loop of any order in the making.
class ModalChart {
 public:
  ModalChart(CircleArcs& circle, const GainGrid& grid) : circle_(circle), grid_(grid) {
    open_cells({0, grid.proportional.count - 1, 0, grid.differential.count - 1}, circle.all());
  }

  /// Of the boxes that are crossed.
  double open_area() const {
    double sum = 0.0;
    for (const CrossedBox& box : open_) sum += box.gains.area();
    return sum;
  }
  /// Of all boxes.
  std::size_t size() const { return open_.size() + free_.size(); }
  std::size_t open_size() const { return open_.size(); }

  /// Quarters the crossed boxes.
  /// @param watch  called for each
  /// @return whether there was one that could be
  template <class Watch>
  bool refine(const Watch& watch) {
    std::vector<CrossedBox> before;
    before.swap(open_);
    bool refined = false;
    for (CrossedBox& box : before) {
      watch();
      const auto quarters = quarters_of(box.gains);
      refined = refined || !quarters.empty();
      if (quarters.empty()) open_.push_back(std::move(box));
      for (const GainBox& quarter : quarters) take(quarter, circle_.meeting(quarter, box.arcs));
    }
    return refined;
  }

  /// Counts the roots of each region.
  template <class Watch>
  ProvedChart finished(const Watch& watch) {
    ProvedChart chart;
    const std::vector<std::size_t> regions = joined_boxes(free_);
    std::vector<std::size_t> largest(free_.size(), free_.size());  // box of each region
    for (std::size_t k = 0; k < free_.size(); ++k) {
      std::size_t& best = largest[regions[k]];
      if (best == free_.size() || free_[k].area() > free_[best].area()) best = k;
    }
    std::vector<ProvedStability> verdicts(free_.size(), ProvedStability::undecided);
    for (std::size_t k = 0; k < free_.size(); ++k) {
      if (largest[k] == free_.size()) continue;
      watch();
      verdicts[k] = verdict_of(free_[largest[k]]);
    }
    for (std::size_t k = 0; k < free_.size(); ++k)
      chart.boxes.push_back({free_[k], verdicts[regions[k]]});
    for (const CrossedBox& box : open_)
      chart.boxes.push_back({box.gains, ProvedStability::undecided});
    sort_boxes(chart);
    return chart;
  }

 private:
  void open_cells(const CellRange& range, const CircleArcs::Arcs& among) {
    auto arcs = circle_.meeting(range.box(grid_), among);
    if (range.is_cell()) return take(range.box(grid_), std::move(arcs));
    const auto [first, second] = range.halves();
    open_cells(first, arcs);
    open_cells(second, arcs);
  }

  void take(const GainBox& box, CircleArcs::Arcs arcs) {
    if (arcs.empty())
      free_.push_back(box);
    else
      open_.push_back({box, std::move(arcs)});
  }

  ProvedStability verdict_of(const GainBox& box) {
    const auto outside = circle_.roots_outside(
        {Enclosure(box.proportional_from, box.proportional_to).middle(),
         Enclosure(box.differential_from, box.differential_to).middle()});
    if (!outside) return ProvedStability::undecided;
    return *outside == 0 ? ProvedStability::stable : ProvedStability::unstable;
  }

  CircleArcs& circle_;
  const GainGrid& grid_;
  std::vector<CrossedBox> open_;
  std::vector<GainBox> free_;
};

}  // namespace detail

/// Proves the cells of a chart of a loop of any order. A box of gains of which no arc of the unit
/// circle has a root is free; others are quartered until their area is no more than a share. The
/// number of roots outside is the same in all free boxes that are joined, and is counted once for
/// each region (`CircleArcs::roots_outside`).
/// @param circle      of the loop, r = 1
/// @param grid        its cells lie between the points; both axes ascend, with at least 2 points
/// @param undecided   the share, 0 ≤ … < 1
/// @param most_boxes  with more the rest is left undecided
/// @param watch       called again and again; what it throws ends the work
/// @throws InvalidParameter for others
template <class Watch>
ProvedChart proved_chart(CircleArcs& circle, const GainGrid& grid, double undecided,
                         std::size_t most_boxes, const Watch& watch) {
  detail::validate_proved(grid, undecided);
  detail::ModalChart chart(circle, grid);
  const double whole = detail::CellRange{0, grid.proportional.count - 1, 0,
                                         grid.differential.count - 1}
                           .box(grid)
                           .area();
  while (chart.open_area() > undecided * whole && chart.size() + 3 * chart.open_size() < most_boxes)
    if (!chart.refine(watch)) break;
  return chart.finished(watch);
}

}  // namespace holdfast
