#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/math/poly/positive_roots.hpp"
#include "holdfast/stability/boundary/arc_crossing.hpp"
#include "holdfast/stability/boundary/boundary_curves.hpp"
#include "holdfast/stability/boundary/boundary_features.hpp"
#include "holdfast/stability/boundary/boundary_point.hpp"

namespace holdfast {

/// A stretch of the boundary on which D is a function of P: an arc or a line that is not vertical.
template <class Scalar>
class BoundaryBranch {
 public:
  /// An arc, of a curve that must outlive the branch.
  explicit BoundaryBranch(const ArcCrossing<Scalar>& arc) : arc_(arc) {}
  /// A line that is not vertical.
  explicit BoundaryBranch(const BoundaryLine<Scalar>& line) : line_(line) {}

  /// True where the branch has a D at P (N/m): within the arc; a line has one everywhere.
  bool passes(const Scalar& proportional_gain) const {
    return !arc_ || arc_->arc().passes(proportional_gain);
  }

  /// D (N s/m) at P (N/m); at the nearer end of an arc that does not reach P.
  Scalar differential(const Scalar& proportional_gain) const {
    return arc_ ? arc_->differential(proportional_gain) : line_.differential_at(proportional_gain);
  }

 private:
  std::optional<ArcCrossing<Scalar>> arc_;
  BoundaryLine<Scalar> line_{};
};

/// A range of P within a window over which the boundary keeps its shape: the same branches cross
/// the window, in the same order, each of them monotone.
template <class Scalar>
struct GainSlab {
  Scalar lower;     ///< P (N/m)
  Scalar upper;     ///< P (N/m)
  bool wall_below;  ///< a vertical line of the boundary is at `lower`
  std::vector<const BoundaryBranch<Scalar>*> branches;  ///< ascending in D
};

/// A window of the gain plane cut into slabs at every P where the boundary changes shape: its
/// special points (`boundary_features`), vertical lines, and where it passes the window's edges.
///
/// A curve of root pairs that is itself the line P = const would not be seen. No loop of a plant
/// has one; the undamped continuous loop has with its two gains exchanged.
template <class Scalar, int Degree>
class GainDecomposition {
 public:
  /// @param curves  must outlive this object
  /// @param window  P (N/m) and D (N s/m), within its ranges (`validate`), not checked here
  GainDecomposition(const BoundaryCurves<Scalar, Degree>& curves, const GainWindow& window)
      : curves_(curves), window_(window) {
    for (const auto& arc : curves_.pairs().arcs()) {
      branches_.emplace_back(ArcCrossing<Scalar>(curves_.pairs(), arc));
    }
    for (const auto& line : curves_.lines()) {
      if (!line.is_vertical()) branches_.emplace_back(line);
    }
    cut();
  }
  // Slabs point to the branches of their own object.
  GainDecomposition(const GainDecomposition&) = delete;
  GainDecomposition(GainDecomposition&&) = delete;
  GainDecomposition& operator=(const GainDecomposition&) = delete;
  GainDecomposition& operator=(GainDecomposition&&) = delete;
  ~GainDecomposition() = default;

  /// Ascending in P, without gaps.
  const std::vector<GainSlab<Scalar>>& slabs() const { return slabs_; }

 private:
  struct Event {
    Scalar proportional;
    bool is_wall;
  };

  void add_event(const PdGains<Scalar>& gains) {
    if (window_.contains(gains)) events_.push_back({gains.proportional, false});
  }

  /// Where the boundary passes D = `differential` (N s/m).
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
    for (const auto& feature : detail::FeatureFinder<Scalar, Degree>(curves_).find()) {
      add_event(feature.gains);
    }
    add_edge(Scalar(window_.differential.lower));
    add_edge(Scalar(window_.differential.upper));
    for (const auto& line : curves_.lines()) {
      const Scalar p = line.proportional_at(Scalar(0));
      if (line.is_vertical() &&
          window_.contains(PdGains<Scalar>{p, Scalar(window_.differential.lower)})) {
        events_.push_back({p, true});
      }
    }
    std::sort(events_.begin(), events_.end(),
              [](const Event& a, const Event& b) { return a.proportional < b.proportional; });
  }

  /// Events closer than 1e−12 of the window are one.
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
    std::vector<std::pair<Scalar, const BoundaryBranch<Scalar>*>> inside;
    for (const auto& branch : branches_) {
      if (!branch.passes(middle)) continue;
      const Scalar d = branch.differential(middle);
      const bool crosses =
          d > Scalar(window_.differential.lower) && d < Scalar(window_.differential.upper);
      if (crosses) inside.emplace_back(d, &branch);
    }
    std::sort(inside.begin(), inside.end());
    GainSlab<Scalar> result{start.proportional, end, start.is_wall, {}};
    for (const auto& [d, branch] : inside) result.branches.push_back(branch);
    return result;
  }

  const BoundaryCurves<Scalar, Degree>& curves_;
  GainWindow window_;
  std::vector<BoundaryBranch<Scalar>> branches_;
  std::vector<Event> events_;
  std::vector<GainSlab<Scalar>> slabs_;
};

}  // namespace holdfast
