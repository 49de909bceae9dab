#pragma once

#include <algorithm>
#include <cstdint>

namespace holdfast {

/// Equally spaced values from `min` to `max`, both included exactly.
struct Axis {
  double min = 0.0;
  double max = 0.0;        ///< ≥ min
  std::int64_t count = 1;  ///< ≥ 1; with count = 1 the only value is `min`

  /// Value number `index`, 0 ≤ index < count.
  double at(std::int64_t index) const {
    const std::int64_t last = count - 1;
    if (index <= 0 || last <= 0) return min;
    if (index >= last) return max;
    // Weighing both ends keeps whole and short decimal steps as exact as they can be.
    const double weighed =
        min * static_cast<double>(last - index) + max * static_cast<double>(index);
    return std::clamp(weighed / static_cast<double>(last), min, max);
  }
};

}  // namespace holdfast
