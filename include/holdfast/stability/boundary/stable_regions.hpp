#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/math/stats/slab_quadrature.hpp"
#include "holdfast/stability/boundary/boundary_curves.hpp"
#include "holdfast/stability/boundary/boundary_features.hpp"
#include "holdfast/stability/boundary/boundary_point.hpp"
#include "holdfast/stability/boundary/root_pair_curve.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"

namespace holdfast {

/// Connected region of a window in the plane of P and D without any stability boundary inside. All
/// gains of the region therefore give the same number of unstable roots.
template <class Scalar>
struct GainRegion {
  int unstable_roots;      ///< number of roots with |λ| > 1 (continuous loop: Re s > 0); 0: stable
  Scalar area;             ///< area in the plane of P and D (N²·s/m²)
  PdGains<Scalar> inside;  ///< gains of a point inside the region, away from its boundary
  Interval<Scalar> proportional;  ///< least and largest P of the region (N/m)
  Interval<Scalar> differential;  ///< least and largest D of the region (N s/m)
  bool at_edge;  ///< whether the region touches the window's edge, and may continue outside
};

namespace detail {

/// Part of the boundary on which D is a function of P: an arc, or a line that is not vertical.
template <class Scalar>
struct BoundaryBranch {
  const RootPairCurve<Scalar>* curve;  ///< arc's curve, must outlive the branch; null for a line
  MonotoneArc<Scalar> arc;             ///< the arc, unless `curve` is null
  BoundaryLine<Scalar> line;           ///< the line, if `curve` is null

  bool passes(const Scalar& proportional_gain) const {
    return curve == nullptr || arc.passes(proportional_gain);
  }

  /// The D (N s/m) of the branch at P (N/m), or of the nearer end if an arc does not reach P.
  Scalar differential(const Scalar& proportional_gain) const {
    if (curve == nullptr) return line.differential_at(proportional_gain);
    return curve->crossing(proportional_gain, curve->square(arc, proportional_gain)).differential;
  }
};

/// Range of P in a window over which the same monotone branches cross the window in the same order.
template <class Scalar>
struct GainSlab {
  Scalar lower;                                  ///< lower end in P (N/m)
  Scalar upper;                                  ///< upper end in P (N/m)
  bool wall_below;                               ///< whether a vertical line is at P = `lower`
  std::vector<BoundaryBranch<Scalar>> branches;  ///< branches in the slab, ascending in D
};

/// Division of a window of the gain plane into slabs. Slabs end at every P where the boundary
/// changes its shape: at special points (`boundary_features`), vertical lines and the window's
/// edges. The cells of neighbouring slabs are joined into regions.
///
/// A curve of root pairs that is a line P = const would be missed; no plant has such a curve. With
/// P and D exchanged the undamped continuous loop would have one, the line D = 0.
template <class Scalar, int Degree>
class RegionBuilder {
 public:
  /// @param curves  boundary curves; must outlive this object
  /// @param window  valid window of P (N/m) and D (N s/m), not checked here (`validate`)
  RegionBuilder(const BoundaryCurves<Scalar, Degree>& curves, const GainWindow& window)
      : curves_(curves), window_(window) {
    for (const auto& arc : curves_.pairs().arcs()) branches_.push_back({&curves_.pairs(), arc, {}});
    for (const auto& line : curves_.lines())
      if (!line.is_vertical()) branches_.push_back({nullptr, {}, line});
    cut();
    std::size_t previous = 0;
    for (const GainSlab<Scalar>& slab : slabs_) {
      const std::size_t first = cells_.size();
      add_cells(slab);
      if (!slab.wall_below) join(previous, first);
      previous = first;
    }
  }

  /// The slabs of the window, ascending in P and without gaps between them.
  const std::vector<GainSlab<Scalar>>& slabs() const { return slabs_; }

  std::vector<GainRegion<Scalar>> regions() {
    std::vector<GainRegion<Scalar>> result;
    for (std::size_t k = 0; k < cells_.size(); ++k) {
      if (root_of(k) != k) absorb(cells_[root_of(k)], cells_[k]);
    }
    for (std::size_t k = 0; k < cells_.size(); ++k) {
      const GainRegion<Scalar>& region = cells_[k].region;
      const bool is_round_off = !(region.area > Scalar(negligible_ * window_.area()));
      if (root_of(k) == k && region.unstable_roots >= 0 && !is_round_off) result.push_back(region);
    }
    std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) {
      return std::pair(a.unstable_roots, -a.area) < std::pair(b.unstable_roots, -b.area);
    });
    return result;
  }

 private:
  struct Event {
    Scalar proportional;
    bool is_wall;
  };

  void add_event(const PdGains<Scalar>& gains, bool is_wall = false) {
    if (window_.contains(gains)) events_.push_back({gains.proportional, is_wall});
  }

  /// Adds each P at which the boundary crosses the line D = `differential` (N s/m).
  void add_edge(const Scalar& differential) {
    const RootPairCurve<Scalar>& pairs = curves_.pairs();
    for (const Scalar& square :
         positive_roots(pairs.differential_numerator() - differential * pairs.denominator())) {
      add_event({pairs.gains(square).proportional, differential});
    }
    for (const auto& line : curves_.lines()) {
      add_event({line.proportional_at(differential), differential});
    }
  }

  void find_events() {
    events_ = {{Scalar(window_.proportional.lower), false},
               {Scalar(window_.proportional.upper), false}};
    for (const auto& feature : FeatureFinder<Scalar, Degree>(curves_).find())
      add_event(feature.gains);
    add_edge(Scalar(window_.differential.lower));
    add_edge(Scalar(window_.differential.upper));
    const Scalar bottom(window_.differential.lower);
    for (const auto& line : curves_.lines())
      if (line.is_vertical()) add_event({line.proportional_at(bottom), bottom}, true);
    std::sort(events_.begin(), events_.end(),
              [](const Event& a, const Event& b) { return a.proportional < b.proportional; });
  }

  /// Cuts the window into slabs; cuts closer together than 1e−12 of its width count as one.
  void cut() {
    find_events();
    const Scalar closest = Scalar(1e-12 * window_.width());
    Event start = events_.front();
    start.proportional = Scalar(window_.proportional.lower);
    for (const Event& event : events_) {
      const Scalar end = std::min(event.proportional, Scalar(window_.proportional.upper));
      if (end - start.proportional > closest) {
        slabs_.push_back(slab(start, end));
        start = {end, false};
      }
      start.is_wall = start.is_wall || event.is_wall;
    }
    slabs_.back().upper = Scalar(window_.proportional.upper);
  }

  GainSlab<Scalar> slab(const Event& start, const Scalar& end) const {
    const Scalar middle = start.proportional + (end - start.proportional) / Scalar(2);
    std::vector<std::pair<Scalar, std::size_t>> inside;
    for (std::size_t k = 0; k < branches_.size(); ++k) {
      if (!branches_[k].passes(middle)) continue;
      const Scalar d = branches_[k].differential(middle);
      if (d > Scalar(window_.differential.lower) && d < Scalar(window_.differential.upper))
        inside.emplace_back(d, k);
    }
    std::sort(inside.begin(), inside.end());
    GainSlab<Scalar> result{start.proportional, end, start.is_wall, {}};
    for (const auto& [d, k] : inside) result.branches.push_back(branches_[k]);
    return result;
  }

  using Levels = std::vector<Scalar>;
  static constexpr double negligible_ = 1e-12;  // of the window

  /// Part of a region in one slab. Cells of a region form a tree; its root describes the region.
  struct Cell {
    std::size_t parent;
    GainRegion<Scalar> region;
    Interval<Scalar> left, right;  // in D, at the slab's two ends
    Scalar largest;                // area of the cell whose middle is `region.inside`
  };

  /// The D of the window's lower edge, of each branch at P, and of the upper edge, ascending.
  Levels levels(const GainSlab<Scalar>& slab, const Scalar& proportional_gain) const {
    const Scalar top(window_.differential.upper);
    Levels result = {Scalar(window_.differential.lower)};
    for (const auto& branch : slab.branches) {
      const Scalar d = branch.differential(proportional_gain);
      result.push_back(std::clamp(d, result.back(), top));
    }
    result.push_back(top);
    return result;
  }

  Levels areas(const GainSlab<Scalar>& slab) const {
    const auto heights = [&](const Scalar& p) {
      Levels result = levels(slab, p);
      std::adjacent_difference(result.begin(), result.end(), result.begin());
      result.erase(result.begin());
      return result;
    };
    const Scalar tolerance(1e-13 * window_.area());
    return SlabQuadrature<Scalar, decltype(heights)>(heights, tolerance)
        .integrate(slab.lower, slab.upper);
  }

  /// The number of unstable roots; −1 for a cell whose height in D is only round-off.
  int count_roots(const PdGains<Scalar>& gains, const Scalar& height) const {
    if (!(height > Scalar(negligible_ * window_.height()))) return -1;
    return unstable_roots(curves_.polynomial().at(gains));
  }

  void add_cells(const GainSlab<Scalar>& slab) {
    const Scalar p = slab.lower + (slab.upper - slab.lower) / Scalar(2);
    const Levels left = levels(slab, slab.lower), middle = levels(slab, p);
    const Levels right = levels(slab, slab.upper), area = areas(slab);
    const bool at_side = slab.lower == Scalar(window_.proportional.lower) ||
                         slab.upper == Scalar(window_.proportional.upper);
    for (std::size_t k = 0; k < area.size(); ++k) {
      const Scalar height = middle[k + 1] - middle[k];
      const PdGains<Scalar> inside{p, middle[k] + height / Scalar(2)};
      const GainRegion<Scalar> region{
          count_roots(inside, height),
          area[k],
          inside,
          {slab.lower, slab.upper},
          {std::min(left[k], right[k]), std::max(left[k + 1], right[k + 1])},
          at_side || k == 0 || k + 1 == area.size()};
      cells_.push_back(
          {cells_.size(), region, {left[k], left[k + 1]}, {right[k], right[k + 1]}, area[k]});
    }
  }

  /// Joins cells of neighbouring slabs into one region if they share a part of their common edge.
  void join(std::size_t previous, std::size_t first) {
    const Scalar slack(1e-9 * window_.height());
    for (std::size_t i = previous; i < first; ++i) {
      for (std::size_t j = first; j < cells_.size(); ++j) {
        const Cell &a = cells_[i], &b = cells_[j];
        const Scalar shared =
            std::min(a.right.upper, b.left.upper) - std::max(a.right.lower, b.left.lower);
        const bool same = a.region.unstable_roots == b.region.unstable_roots;
        if (same && shared > slack) cells_[root_of(j)].parent = root_of(i);
      }
    }
  }

  std::size_t root_of(std::size_t cell) const {
    while (cells_[cell].parent != cell) cell = cells_[cell].parent;
    return cell;
  }

  static void absorb(Cell& whole, const Cell& part) {
    const auto widen = [](Interval<Scalar>& interval, const Interval<Scalar>& other) {
      interval = {std::min(interval.lower, other.lower), std::max(interval.upper, other.upper)};
    };
    if (part.region.area > whole.largest) {
      whole.largest = part.region.area;
      whole.region.inside = part.region.inside;
    }
    whole.region.area += part.region.area;
    widen(whole.region.proportional, part.region.proportional);
    widen(whole.region.differential, part.region.differential);
    whole.region.at_edge = whole.region.at_edge || part.region.at_edge;
  }

  const BoundaryCurves<Scalar, Degree>& curves_;
  GainWindow window_;
  std::vector<BoundaryBranch<Scalar>> branches_;
  std::vector<Event> events_;
  std::vector<GainSlab<Scalar>> slabs_;
  std::vector<Cell> cells_;
};

}  // namespace detail

/// The regions into which the stability boundary divides a window of gains, with their areas.
/// The window is divided into slabs, ranges of P with the same boundary curves D₁(P) < D₂(P) < …
/// Two neighbouring curves (or window edges) enclose a cell of area ∫ (D_{k+1} − D_k) dP.
/// The unstable roots are counted at the middle of each cell. Cells of neighbouring slabs form one
/// region if their common edge exceeds 1e−9 of the window's height and is not on the boundary.
/// Areas are accurate to 1e−10 of the window's area; regions below 1e−12 of it are left out.
/// @param polynomial  `characteristic_polynomial` of the sampled or the continuous loop
/// @param window      window of P (N/m) and D (N s/m), its edges included
/// @return regions by ascending number of unstable roots and, for equal numbers, descending area
/// @throws InvalidParameter unless the window's ranges are finite and not empty
template <class Scalar, int Degree>
std::vector<GainRegion<Scalar>> gain_regions(const AffinePolynomial<Scalar, Degree>& polynomial,
                                             const GainWindow& window) {
  validate(polynomial);
  validate(window);
  const BoundaryCurves<Scalar, Degree> curves(polynomial);
  return detail::RegionBuilder<Scalar, Degree>(curves, window).regions();
}

}  // namespace holdfast
