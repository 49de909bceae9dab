#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/stability/boundary/boundary_curves.hpp"
#include "holdfast/stability/boundary/boundary_point.hpp"
#include "holdfast/stability/boundary/root_pair_curve.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"

namespace holdfast {

namespace detail {

/// Point of a curve of gains with a root pair on the stability boundary: parameter, P and D.
template <class Scalar>
struct CurvePlace {
  Scalar parameter;
  PdGains<Scalar> gains;  // not finite at a pole
};

/// Tracer of the curve of gains with a root pair on the stability boundary, over a range of P. Each
/// piece of the curve is halved until its chord spans at most 1/50 of the range, and three inner
/// points have a scaled `distance` ≤ 0.001 from the chord. Pieces outside the range are left out.
/// @tparam Curve  `BoundaryCurves` or `CircleBoundary`, with functions `gains`, `between` and
///                `angle` of the curve's parameter, and `pair_kind`
template <class Scalar, class Curve>
class CurveTracer {
 public:
  using Place = CurvePlace<Scalar>;
  using Points = std::vector<BoundaryPoint<Scalar>>;

  /// @param curve    curve to trace within the range of P; must outlive this object
  /// @param deepest  largest number of successive halvings of a piece
  CurveTracer(const Curve& curve, const Interval<double>& range, int deepest)
      : curve_(curve), range_(range), deepest_(deepest) {}

  Place at(const Scalar& parameter) const { return {parameter, curve_.gains(parameter)}; }

  /// Appends the curve's points between the given places (ascending), as far as P is in range.
  void trace(const std::vector<Place>& places, Points& points) const {
    for (std::size_t k = 0; k + 1 < places.size(); ++k) {
      append(places[k], points);
      refine(places[k], places[k + 1], deepest_, points);
      append(places[k + 1], points);
    }
  }

 private:
  /// Whether P of a place is in the range, with a slack of 10⁻¹² of the width for round-off.
  bool in_range(const Place& place) const {
    const Scalar slack = Scalar(1e-12) * width();
    return place.gains.proportional >= Scalar(range_.lower) - slack &&
           place.gains.proportional <= Scalar(range_.upper) + slack;
  }

  void refine(const Place& start, const Place& end, int depth, Points& points) const {
    const Place middle = at(curve_.between(start.parameter, end.parameter));
    const int inside = int(in_range(start)) + int(in_range(middle)) + int(in_range(end));
    if (depth == 0 || inside == 0 || !worth_splitting(start, middle, end)) return;
    refine(start, middle, depth - 1, points);
    append(middle, points);
    refine(middle, end, depth - 1, points);
  }

  bool worth_splitting(const Place& start, const Place& middle, const Place& end) const {
    // Beside a pole at which P is finite, D grows without bound.
    if (!(end.parameter - start.parameter > Scalar(1e-6) * end.parameter)) return false;
    const Scalar step = std::abs(end.gains.proportional - start.gains.proportional);
    if (!(step <= Scalar(0.02) * width())) return true;
    const Place first = at(curve_.between(start.parameter, middle.parameter));
    const Place third = at(curve_.between(middle.parameter, end.parameter));
    for (const Place* place : {&first, &middle, &third}) {
      if (!(distance(place->gains, start.gains, end.gains) <= Scalar(0.001))) return true;
    }
    return false;
  }

  Scalar width() const { return Scalar(range_.upper) - Scalar(range_.lower); }

  /// The distance of a point from a chord: P in units of the range's width, D of Σ |D| at its ends.
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

  void append(const Place& place, Points& points) const {
    if (!std::isfinite(place.gains.differential) || !in_range(place)) return;
    const Scalar angle = curve_.angle(place.parameter);
    const bool first = points.empty() || points.back().curve != curve_.pair_kind();
    if (!first && !(points.back().angle < angle)) return;
    const Scalar p =
        std::clamp(place.gains.proportional, Scalar(range_.lower), Scalar(range_.upper));
    points.push_back({curve_.pair_kind(), angle, {p, place.gains.differential}});
  }

  const Curve& curve_;
  Interval<double> range_;
  int deepest_;
};

/// Points that divide the curve into parts with monotone P and D, by ascending Y (`RootPairCurve`):
/// poles, stationary points of P or D, points with P at an end of its range, and the least and the
/// largest Y. These are 10⁻¹² and 10¹² (sampled loop: 10¹²/unit², where θ = π − 2·10⁻⁶).
template <class Scalar, int Degree>
std::vector<CurvePlace<Scalar>> curve_cuts(const BoundaryCurves<Scalar, Degree>& curves,
                                           const Interval<double>& range) {
  constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  const RootPairCurve<Scalar>& curve = curves.pairs();
  const Scalar largest = curves.sampled ? Scalar(1e6) / curve.unit() : Scalar(1e6);
  const Interval<Scalar> squares{Scalar(1e-12), largest * largest};
  std::vector<CurvePlace<Scalar>> cuts;
  for (const Scalar& pole : curve.poles()) cuts.push_back({pole, {infinity, infinity}});
  for (const auto& turns : {std::vector<Scalar>{squares.lower, squares.upper},
                            curve.proportional_extremes(), curve.differential_extremes()})
    for (const Scalar& square : turns) cuts.push_back({square, curve.gains(square)});
  for (const MonotoneArc<Scalar>& arc : curve.arcs()) {
    for (const Scalar end : {Scalar(range.lower), Scalar(range.upper)}) {
      if (!arc.passes(end)) continue;
      const Scalar square = curve.square(arc, end);
      cuts.push_back({square, {end, curve.crossing(end, square).differential}});
    }
  }
  const auto outside = [&squares](const auto& cut) {
    return !(cut.parameter >= squares.lower && cut.parameter <= squares.upper);
  };
  cuts.erase(std::remove_if(cuts.begin(), cuts.end(), outside), cuts.end());
  std::sort(cuts.begin(), cuts.end(),
            [](const auto& a, const auto& b) { return a.parameter < b.parameter; });
  return cuts;
}

}  // namespace detail

/// Points of the stability boundary in the plane of P and D, for a range of P.
///
/// The sampled loop (degree 5) has two straight lines, with the root λ = +1 or −1, and a curve with
/// root pairs e^{±iθ}. The continuous loop (degree 4) has a line with the root s = 0 and a curve
/// with pairs ±iω. A line is absent if its root does not depend on the gains. For two masses the
/// lines λ = +1 and s = 0 are absent: a constant force between them does not move the conductor.
/// @param polynomial  `characteristic_polynomial` of the sampled or the continuous loop
/// @param range       range of P (N/m), its ends included
/// @return the two ends of each line, then the points of the curve by ascending angle; the latter
///         are denser where the curve bends, and some have P exactly at the ends of the range
/// @throws InvalidParameter unless range.lower < range.upper, both finite
template <class Scalar, int Degree>
std::vector<BoundaryPoint<Scalar>> stability_boundary(
    const AffinePolynomial<Scalar, Degree>& polynomial, const Interval<double>& range) {
  validate(polynomial);
  validate_proportional(range);
  const BoundaryCurves<Scalar, Degree> curves(polynomial);
  std::vector<BoundaryPoint<Scalar>> points;
  for (const auto& line : curves.lines()) detail::append_line(points, line, range);
  detail::CurveTracer<Scalar, BoundaryCurves<Scalar, Degree>>(curves, range, 24)
      .trace(detail::curve_cuts(curves, range), points);
  return points;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template std::vector<BoundaryPoint<double>> stability_boundary(
    const AffinePolynomial<double, 4>&, const Interval<double>&);
extern template std::vector<BoundaryPoint<double>> stability_boundary(
    const AffinePolynomial<double, 5>&, const Interval<double>&);
#endif

}  // namespace holdfast
