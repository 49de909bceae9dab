#pragma once

#include <limits>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// An open interval (lower, upper) of the real line; an end may be infinite.
template <class Scalar>
struct Interval {
  /// The lower end, not in the interval; −∞: unbounded below.
  Scalar lower = -std::numeric_limits<Scalar>::infinity();
  /// The upper end, not in the interval; ∞: unbounded above.
  Scalar upper = std::numeric_limits<Scalar>::infinity();

  /// Whether lower < value < upper; false for NaN.
  bool contains(const Scalar& value) const { return lower < value && value < upper; }

  /// A point inside the interval: its middle; lower + 1 + |lower| if only the upper end is
  /// infinite; upper − 1 − |upper| if only the lower end is infinite; 0 if both are infinite.
  Scalar representative() const {
    constexpr Scalar unbounded = std::numeric_limits<Scalar>::infinity();
    if (lower == -unbounded && upper == unbounded) return Scalar(0);
    if (lower == -unbounded) return upper - (Scalar(1) + (upper < 0 ? -upper : upper));
    if (upper == unbounded) return lower + (Scalar(1) + (lower < 0 ? -lower : lower));
    return lower + (upper - lower) / Scalar(2);
  }
};

}  // namespace holdfast
