#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/stability/boundary/arc_crossing.hpp"
#include "holdfast/stability/boundary/boundary_curves.hpp"
#include "holdfast/stability/boundary/boundary_point.hpp"

namespace holdfast::detail {

/// Points along the curve of root pairs within a range of P, as far apart as a picture allows.
///
/// The curve is cut where it enters or leaves the range, at its poles and where P or D is
/// stationary, so that both gains are monotone between cuts and no branch is missed. Each piece is
/// halved in ln Y until its quarter points lie on the chord to 1/1000 (of the range in P, of the
/// gain itself in D, since a picture's range of D is not known here) and the chord spans no more
/// than 1/50 of the range. At a pole the curve leaves the range at one end and comes back at the
/// other.
template <class Scalar, int Degree>
class CurveTracer {
 public:
  /// @param curves  must outlive this object
  CurveTracer(const BoundaryCurves<Scalar, Degree>& curves, const ProportionalRange& range)
      : curves_(curves), range_(range) {}

  /// Appends the points of min < Y < max, in ascending order.
  void trace(const Interval<Scalar>& squares, std::vector<BoundaryPoint<Scalar>>& points) const {
    const std::vector<Knot> knots = cuts(squares);
    Scalar last(-1);
    for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
      const Knot &start = knots[k], &end = knots[k + 1];
      if (!in_range(at(std::sqrt(start.square) * std::sqrt(end.square)))) continue;
      if (start.square > last) append(start, points);
      refine(start, end, deepest_, points);
      append(end, points);
      last = end.square;
    }
  }

 private:
  static constexpr int deepest_ = 24;

  struct Knot {
    Scalar square;
    PdGains<Scalar> gains;  // not finite at a pole
  };

  Knot at(const Scalar& square) const { return {square, curves_.pairs().gains(square)}; }

  bool in_range(const Knot& knot) const {
    return knot.gains.proportional >= Scalar(range_.lower) &&
           knot.gains.proportional <= Scalar(range_.upper);
  }

  std::vector<Knot> cuts(const Interval<Scalar>& squares) const {
    constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
    const RootPairCurve<Scalar>& curve = curves_.pairs();
    std::vector<Knot> knots = {at(squares.lower), at(squares.upper)};
    for (const Scalar& pole : curve.poles()) knots.push_back({pole, {infinity, infinity}});
    for (const Scalar& square : curve.proportional_extremes()) knots.push_back(at(square));
    for (const Scalar& square : curve.differential_extremes()) knots.push_back(at(square));
    for (const MonotoneArc<Scalar>& arc : curve.arcs()) {
      for (const Scalar end : {Scalar(range_.lower), Scalar(range_.upper)}) {
        if (!arc.passes(end)) continue;
        const ArcCrossing<Scalar> crossing(curve, arc);
        knots.push_back({crossing.square(end), {end, crossing.differential(end)}});
      }
    }
    const auto outside = [&squares](const Knot& knot) {
      return !(knot.square >= squares.lower && knot.square <= squares.upper);
    };
    knots.erase(std::remove_if(knots.begin(), knots.end(), outside), knots.end());
    std::sort(knots.begin(), knots.end(),
              [](const Knot& a, const Knot& b) { return a.square < b.square; });
    return knots;
  }

  void refine(const Knot& start, const Knot& end, int depth,
              std::vector<BoundaryPoint<Scalar>>& points) const {
    const Knot middle = at(std::sqrt(start.square) * std::sqrt(end.square));
    if (depth == 0 || !worth_splitting(start, middle, end)) return;
    refine(start, middle, depth - 1, points);
    append(middle, points);
    refine(middle, end, depth - 1, points);
  }

  bool worth_splitting(const Knot& start, const Knot& middle, const Knot& end) const {
    // Beside a pole at which P is finite D grows without end.
    if (!(end.square - start.square > Scalar(1e-6) * end.square)) return false;
    const Scalar step = std::abs(end.gains.proportional - start.gains.proportional);
    if (!(step <= Scalar(0.02) * width())) return true;
    const Knot first = at(std::sqrt(start.square) * std::sqrt(middle.square));
    const Knot third = at(std::sqrt(middle.square) * std::sqrt(end.square));
    for (const Knot* knot : {&first, &middle, &third}) {
      if (!(distance(knot->gains, start.gains, end.gains) <= Scalar(0.001))) return true;
    }
    return false;
  }

  Scalar width() const { return Scalar(range_.upper) - Scalar(range_.lower); }

  /// Distance of the point from the chord, P in units of the range and D of its own size.
  Scalar distance(const PdGains<Scalar>& point, const PdGains<Scalar>& start,
                  const PdGains<Scalar>& end) const {
    const Scalar size = std::abs(start.differential) + std::abs(end.differential);
    const auto p = [&](const PdGains<Scalar>& gains) {
      return (gains.proportional - start.proportional) / width();
    };
    const auto d = [&](const PdGains<Scalar>& gains) {
      return size > Scalar(0) ? (gains.differential - start.differential) / size : Scalar(0);
    };
    const Scalar length = std::hypot(p(end), d(end));
    if (!(length > Scalar(0))) return std::hypot(p(point), d(point));
    return std::abs(p(end) * d(point) - d(end) * p(point)) / length;
  }

  /// Round-off must not push a point out of the range, nor leave two of them at one angle, as about
  /// a pole that a zero all but cancels.
  void append(const Knot& knot, std::vector<BoundaryPoint<Scalar>>& points) const {
    if (!std::isfinite(knot.gains.proportional) || !std::isfinite(knot.gains.differential)) return;
    const Scalar angle = curves_.angle(knot.square);
    const bool first = points.empty() || points.back().curve != curves_.pair_kind();
    if (!first && !(points.back().angle < angle)) return;
    const Scalar p =
        std::clamp(knot.gains.proportional, Scalar(range_.lower), Scalar(range_.upper));
    points.push_back({curves_.pair_kind(), angle, {p, knot.gains.differential}});
  }

  const BoundaryCurves<Scalar, Degree>& curves_;
  ProportionalRange range_;
};

}  // namespace holdfast::detail
