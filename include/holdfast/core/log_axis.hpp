#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// Logarithmically spaced values from `min` to `max`, both included exactly.
struct LogAxis {
  double min = 1.0;        ///< the first value, > 0
  double max = 1.0;        ///< the last value, ≥ min
  std::int64_t count = 1;  ///< number of values, ≥ 1; if it is 1, the only value is `min`

  /// Value min (max/min)^{index/(count − 1)} at an index, 0 ≤ index < count.
  double at(std::int64_t index) const {
    const std::int64_t last = count - 1;
    if (index <= 0 || last <= 0) return min;
    if (index >= last) return max;
    const double share = static_cast<double>(index) / static_cast<double>(last);
    // The quotient of the ends may leave the range of doubles; their logarithms do not.
    const double logarithm = std::log(min) * (1.0 - share) + std::log(max) * share;
    return std::clamp(std::exp(logarithm), min, max);
  }
};

}  // namespace holdfast
