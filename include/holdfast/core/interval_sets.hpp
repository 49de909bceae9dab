#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "holdfast/core/interval.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// Whether one of the open intervals contains the value.
template <class Scalar>
bool contains_any(const std::vector<Interval<Scalar>>& intervals, const Scalar& value) {
  return std::any_of(intervals.begin(), intervals.end(),
                     [&](const Interval<Scalar>& interval) { return interval.contains(value); });
}

/// The intersection of two unions of open intervals. In each argument and in the result the
/// intervals are ascending and disjoint.
template <class Scalar>
std::vector<Interval<Scalar>> intersection(const std::vector<Interval<Scalar>>& first,
                                           const std::vector<Interval<Scalar>>& second) {
  std::vector<Interval<Scalar>> result;
  for (const Interval<Scalar>& a : first) {
    for (const Interval<Scalar>& b : second) {
      const Interval<Scalar> common{std::max(a.lower, b.lower), std::min(a.upper, b.upper)};
      if (common.lower < common.upper) result.push_back(common);
    }
  }
  return result;
}

/// The open intervals of x in which c₀ + c₁ x + c₂ x² < 0: none, one or two, ascending.
///
/// The roots are q/c₂ and c₀/q with q = −(c₁ ± √(c₁² − 4 c₀ c₂))/2; ± is the sign of c₁, to avoid
/// cancellation. c₂ may be 0. For c₂ < 0 with a double root the result is (−∞, ∞), root included.
/// @param quadratic  coefficients [c₀, c₁, c₂], finite
template <class Scalar>
std::vector<Interval<Scalar>> where_negative(const Vector<Scalar, 3>& quadratic) {
  constexpr Scalar unbounded = std::numeric_limits<Scalar>::infinity();
  const Scalar c0 = quadratic[0], c1 = quadratic[1], c2 = quadratic[2];
  const Scalar discriminant = c1 * c1 - Scalar(4) * c0 * c2;
  if (!(discriminant > Scalar(0))) {
    const bool negative = c2 < Scalar(0) || (c2 == Scalar(0) && c0 < Scalar(0));
    return negative ? std::vector<Interval<Scalar>>{{-unbounded, unbounded}}
                    : std::vector<Interval<Scalar>>{};
  }
  const Scalar root = std::sqrt(discriminant);
  const Scalar q = (c1 < Scalar(0) ? root - c1 : -root - c1) / Scalar(2);
  if (c2 == Scalar(0)) {
    const Scalar zero = c0 / q;
    return {c1 > Scalar(0) ? Interval<Scalar>{-unbounded, zero}
                           : Interval<Scalar>{zero, unbounded}};
  }
  const auto [lower, upper] = std::minmax({q / c2, c0 / q});
  if (c2 > Scalar(0)) return {{lower, upper}};
  std::vector<Interval<Scalar>> outside;
  if (lower > -unbounded) outside.push_back({-unbounded, lower});
  if (upper < unbounded) outside.push_back({upper, unbounded});
  return outside;
}

}  // namespace holdfast
