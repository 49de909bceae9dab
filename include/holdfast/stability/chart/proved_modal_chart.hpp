#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "holdfast/stability/chart/chart.hpp"
#include "holdfast/stability/chart/circle_arcs.hpp"
#include "holdfast/stability/chart/proved_chart.hpp"
#include "holdfast/stability/response/enclosed_response.hpp"

namespace holdfast {

namespace detail {

/// Partition of indices into disjoint sets, which can be joined pairwise (union-find).
class JoinedSets {
 public:
  explicit JoinedSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t representative(std::size_t of) {
    while (parent_[of] != of) of = parent_[of] = parent_[parent_[of]];
    return of;
  }
  void join(std::size_t one, std::size_t other) {
    parent_[representative(one)] = representative(other);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// A side of a box: its constant coordinate and its range along the other axis.
struct BoxSide {
  double at, from, to;
  std::size_t box;
};

/// Joins any two boxes if a side of one box in `ends` overlaps a side of the other in `begins`.
inline void join_along(std::vector<BoxSide> ends, std::vector<BoxSide> begins, JoinedSets& sets) {
  const auto by_place = [](const BoxSide& a, const BoxSide& b) {
    return std::tie(a.at, a.from) < std::tie(b.at, b.from);
  };
  std::sort(ends.begin(), ends.end(), by_place);
  std::sort(begins.begin(), begins.end(), by_place);
  auto end = ends.begin();
  for (auto begin = begins.begin(); begin != begins.end() && end != ends.end();) {
    if (begin->at == end->at && begin->from < end->to && end->from < begin->to)
      sets.join(begin->box, end->box);
    if (std::tie(begin->at, begin->to) < std::tie(end->at, end->to))
      ++begin;
    else
      ++end;
  }
}

}  // namespace detail

/// Groups boxes of gains into regions: sets of boxes connected through common sides.
/// @param boxes  boxes that do not overlap; coordinates of common sides are identical doubles
/// @return for each box the index of its region's representative, one of the region's boxes
inline std::vector<std::size_t> joined_boxes(const std::vector<GainBox>& boxes) {
  std::vector<detail::BoxSide> left, right, lower, upper;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const auto [p0, p1, d0, d1] = boxes[k];
    left.push_back({p0, d0, d1, k});
    right.push_back({p1, d0, d1, k});
    lower.push_back({d0, p0, p1, k});
    upper.push_back({d1, p0, p1, k});
  }
  detail::JoinedSets sets(boxes.size());
  detail::join_along(std::move(right), std::move(left), sets);
  detail::join_along(std::move(upper), std::move(lower), sets);
  std::vector<std::size_t> regions(boxes.size());
  for (std::size_t k = 0; k < boxes.size(); ++k) regions[k] = sets.representative(k);
  return regions;
}

namespace detail {

/// A box of gains and, for each circle of `ModalChart`, the arcs on which a loop of the box may
/// have a root. `nullopt` marks a circle wider than |λ| = 1 that cannot prove the box unstable.
struct CrossedBox {
  GainBox gains;
  std::vector<std::optional<CircleArcs::Arcs>> arcs;
};

struct CellRange {
  const GainGrid& grid;
  std::int64_t p_from = 0, p_to = grid.proportional.count - 1;
  std::int64_t d_from = 0, d_to = grid.differential.count - 1;

  GainBox box() const {
    return {grid.proportional.at(p_from), grid.proportional.at(p_to), grid.differential.at(d_from),
            grid.differential.at(d_to)};
  }
  bool is_cell() const { return p_to - p_from == 1 && d_to - d_from == 1; }
  std::pair<CellRange, CellRange> halves() const {
    std::pair<CellRange, CellRange> both(*this, *this);
    if (p_to - p_from > d_to - d_from)
      both.first.p_to = both.second.p_from = (p_from + p_to) / 2;
    else
      both.first.d_to = both.second.d_from = (d_from + d_to) / 2;
    return both;
  }
};

/// Builder of the chart of a loop of any order. In a free box no loop has a root on |λ| = 1.
/// @tparam Watch  type of a function without arguments, which is called for each box
template <class Watch>
class ModalChart {
 public:
  ModalChart(const EnclosedResponse& response, const GainGrid& grid, const Watch& watch)
      : watch_(watch) {
    // A loop with a root outside a wider circle is unstable, even if roots cross |λ| = 1.
    for (const double radius : {1.0, 1.0003, 1.005}) circles_.emplace_back(response, radius);
    const CellRange all{grid};
    CrossedBox whole{all.box(), {}};
    for (const CircleArcs& circle : circles_) whole.arcs.emplace_back(circle.all());
    open_cells(all, whole);
  }

  /// Quarters undecided boxes until their area is at most `most_area` (N²·s/m²); see `quarter`.
  void refine(double most_area, std::size_t most_boxes) {
    quarter(
        open_, most_area, most_boxes,
        [this](const CrossedBox& box, const GainBox& part) { take(part_of(box, part)); },
        [this] { return unstable_.size() + free_.size(); });
  }

  /// The finished chart. Roots outside the unit circle are counted once per region of free boxes.
  ProvedChart finished() {
    ProvedChart chart;
    for (const GainBox& box : unstable_) chart.boxes.push_back({box, ProvedStability::unstable});
    for (const CrossedBox& box : open_)
      chart.boxes.push_back({box.gains, ProvedStability::undecided});
    const std::vector<std::size_t> regions = joined_boxes(free_);
    const std::vector<ProvedStability> verdicts = verdicts_on(regions);
    for (std::size_t k = 0; k < free_.size(); ++k)
      chart.boxes.push_back({free_[k], verdicts[regions[k]]});
    sort_boxes(chart);
    return chart;
  }

 private:
  /// Halves a range to single cells, stored as free of roots on |λ| = 1, unstable or undecided.
  void open_cells(const CellRange& range, const CrossedBox& around) {
    CrossedBox box = part_of(around, range.box());
    if (range.is_cell()) return take(std::move(box));
    const auto [first, second] = range.halves();
    open_cells(first, box);
    open_cells(second, box);
  }

  /// A part of a box, with the arcs on which a loop of this part may have a root.
  CrossedBox part_of(const CrossedBox& box, const GainBox& part) {
    watch_();
    CrossedBox result{part, {}};
    for (std::size_t j = 0; j < circles_.size(); ++j) {
      result.arcs.emplace_back();
      if (box.arcs[j]) result.arcs[j] = circles_[j].meeting(part, *box.arcs[j]);
    }
    return result;
  }

  void take(CrossedBox box) {
    if (box.arcs.front()->empty()) return free_.push_back(box.gains);
    for (std::size_t j = 1; j < circles_.size(); ++j) {
      if (!box.arcs[j] || !box.arcs[j]->empty()) continue;
      const auto outside = circles_[j].roots_outside(middle_of(box.gains));
      if (outside && *outside > 0) return unstable_.push_back(box.gains);
      box.arcs[j].reset();
    }
    open_.push_back(std::move(box));
  }

  /// The verdict on each region, at the index of its representative box (`joined_boxes`).
  std::vector<ProvedStability> verdicts_on(const std::vector<std::size_t>& regions) {
    std::vector<std::optional<GainBox>> largest(free_.size());
    for (std::size_t k = 0; k < free_.size(); ++k) {
      auto& box = largest[regions[k]];
      if (!box || free_[k].area() > box->area()) box = free_[k];
    }
    std::vector<ProvedStability> verdicts(free_.size(), ProvedStability::undecided);
    for (std::size_t k = 0; k < free_.size(); ++k) {
      if (!largest[k]) continue;
      watch_();
      const auto outside = circles_.front().roots_outside(middle_of(*largest[k]));
      if (outside)
        verdicts[k] = *outside == 0 ? ProvedStability::stable : ProvedStability::unstable;
    }
    return verdicts;
  }

  const Watch& watch_;
  std::vector<CircleArcs> circles_;  // the unit circle first
  std::vector<CrossedBox> open_;
  std::vector<GainBox> free_, unstable_;
};

}  // namespace detail

/// Computes a chart of proved stability for a loop of any order. Boxes of gains proved to give no
/// root on the unit circle are grouped into connected regions. All loops of a region have the same
/// number of roots outside, which is counted once (`CircleArcs::roots_outside`). Any other box is
/// proved unstable if all its loops have roots outside a wider circle and none on that circle.
/// Other boxes are quartered until they make up at most the fraction `undecided` of the area.
/// @param response    enclosed response of the loop
/// @param grid        grid points, at least 2 on each ascending axis; cells lie between the points
/// @param undecided   accepted undecided fraction of the area, 0 … 1
/// @param watch       function called without arguments before each box is examined, for example to
///                    report progress; an exception from it ends the computation
/// @param most_boxes  largest number of boxes; quartering stops before it might be exceeded
/// @return chart; all undecided if an eigenvalue e^{sτ} of the plant may be on the unit circle
/// @throws InvalidParameter where the grid or the share is not admissible
template <class Watch>
ProvedChart proved_chart(const EnclosedResponse& response, const GainGrid& grid, double undecided,
                         const Watch& watch, std::size_t most_boxes = std::size_t{1} << 22) {
  detail::validate_proved(grid, undecided);
  if (!response.poles_outside(1.0)) {
    ProvedChart chart;
    for (const GainBox& cell : detail::cells_of(grid))
      chart.boxes.push_back({cell, ProvedStability::undecided});
    return chart;
  }
  detail::ModalChart<Watch> chart(response, grid, watch);
  chart.refine(undecided * detail::CellRange{grid}.box().area(), most_boxes);
  return chart.finished();
}

}  // namespace holdfast
