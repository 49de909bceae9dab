#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/stability/boundary_point.hpp"

namespace holdfast::detail {

/// Follows one curve of root pairs from angle to angle and keeps what lies in the P range.
///
/// Starts from geometrically spaced tan(θ/2)-like parameters and halves each step until the curve's
/// middle lies on its chord to 1/500 of its length or the step no longer matters.
template <class Scalar, class GainsAt>
class CurveTracer {
 public:
  CurveTracer(BoundaryCurve curve, ProportionalRange range, GainsAt gains_at)
      : curve_(curve), range_(range), gains_at_(std::move(gains_at)) {}

  void trace(const Scalar& from, const Scalar& to,
             std::vector<BoundaryPoint<Scalar>>& points) const {
    const auto start = gains_at_(from), end = gains_at_(to);
    if (start && inside(*start)) points.push_back({curve_, from, *start});
    refine(from, start, to, end, deepest_, points);
  }

 private:
  using Gains = std::optional<PdGains<Scalar>>;
  static constexpr int deepest_ = 14;

  bool inside(const PdGains<Scalar>& gains) const {
    return gains.proportional >= Scalar(range_.lower) && gains.proportional <= Scalar(range_.upper);
  }

  void refine(const Scalar& from, const Gains& start, const Scalar& to, const Gains& end, int depth,
              std::vector<BoundaryPoint<Scalar>>& points) const {
    const Scalar middle = (from + to) / Scalar(2);
    const Gains between = gains_at_(middle);
    if (depth == 0 || !worth_splitting(start, between, end)) return;
    refine(from, start, middle, between, depth - 1, points);
    if (inside(*between)) points.push_back({curve_, middle, *between});
    refine(middle, between, to, end, depth - 1, points);
  }

  bool worth_splitting(const Gains& start, const Gains& between, const Gains& end) const {
    if (!start || !between || !end) return false;
    // A narrow range may lie between two points: what counts is whether the curve passes through
    // it.
    const auto [lowest, highest] =
        std::minmax({start->proportional, between->proportional, end->proportional});
    if (highest < Scalar(range_.lower) || lowest > Scalar(range_.upper)) return false;
    if (!inside(*start) || !inside(*between) || !inside(*end)) return true;
    return deviation(*start, *between, *end) > Scalar(0.002) || width(*start, *end) > Scalar(0.01);
  }

  Scalar width(const PdGains<Scalar>& a, const PdGains<Scalar>& b) const {
    return std::abs(a.proportional - b.proportional) / Scalar(range_.upper - range_.lower);
  }

  /// Distance of the middle from the chord's middle, in units of the P range and of the D in
  /// question.
  Scalar deviation(const PdGains<Scalar>& a, const PdGains<Scalar>& m,
                   const PdGains<Scalar>& b) const {
    const Scalar d_scale = std::abs(a.differential) + std::abs(b.differential) + Scalar(1e-12);
    const Scalar p_off = m.proportional - (a.proportional + b.proportional) / Scalar(2);
    const Scalar d_off = m.differential - (a.differential + b.differential) / Scalar(2);
    return std::hypot(p_off / Scalar(range_.upper - range_.lower), d_off / d_scale);
  }

  BoundaryCurve curve_;
  ProportionalRange range_;
  GainsAt gains_at_;
};

/// Traces a root-pair curve over angles of which a parameter takes geometric steps, 40 a decade.
template <class Scalar, class GainsAt, class AngleOf>
void append_pairs(std::vector<BoundaryPoint<Scalar>>& points, BoundaryCurve curve,
                  const ProportionalRange& range, const Interval<Scalar>& parameter,
                  GainsAt gains_at, AngleOf angle_of) {
  const CurveTracer<Scalar, GainsAt> tracer(curve, range, std::move(gains_at));
  const Scalar decades = std::log10(parameter.upper / parameter.lower);
  const int steps = static_cast<int>(std::ceil(Scalar(40) * decades));
  Scalar from = angle_of(parameter.lower);
  for (int k = 1; k <= steps; ++k) {
    const Scalar exponent = decades * Scalar(k) / Scalar(steps);
    const Scalar to = angle_of(parameter.lower * std::pow(Scalar(10), exponent));
    tracer.trace(from, to, points);
    from = to;
  }
}

}  // namespace holdfast::detail
