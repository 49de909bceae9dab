#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "holdfast/core/errors.hpp"

namespace holdfast {

/// Equally spaced values from `min` to `max`, both included exactly.
struct Axis {
  double min = 0.0;        ///< first value, finite
  double max = 0.0;        ///< the last value, ≥ min
  std::int64_t count = 1;  ///< number of values, ≥ 1; if it is 1, the only value is `min`

  /// Value min + (max − min) index/(count − 1) at an index, 0 ≤ index < count.
  double at(std::int64_t index) const {
    const std::int64_t last = count - 1;
    if (index <= 0 || last <= 0) return min;
    if (index >= last) return max;
    // The weighted mean of both ends keeps whole and short decimal steps accurate.
    const double weighed =
        min * static_cast<double>(last - index) + max * static_cast<double>(index);
    return std::clamp(weighed / static_cast<double>(last), min, max);
  }

  /// The index of the first value at(index) > `bound`; `count` if there is none.
  std::int64_t first_above(double bound) const {
    return first_beyond(bound, [bound](double value) { return value > bound; });
  }

  /// The index of the first value ≥ `bound`; `count` if there is none.
  std::int64_t first_not_below(double bound) const {
    return first_beyond(bound, [bound](double value) { return value >= bound; });
  }

 private:
  /// Index of the first value for which `beyond` holds, computed from the bound's position on the
  /// axis. If the bound equals a value within rounding, the values next to it are tested.
  template <class Beyond>
  std::int64_t first_beyond(double bound, Beyond beyond) const {
    if (!(bound >= min)) return 0;
    if (!(bound <= max)) return count;
    const double steps = static_cast<double>(count - 1);
    const double position = max > min ? (bound / 2 - min / 2) / (max / 2 - min / 2) * steps : 0.0;
    auto index = static_cast<std::int64_t>(std::ceil(position));
    const double to_value = std::abs(position - std::round(position));
    if (to_value > 1e-6 + 1e-12 * steps) return index;
    index = static_cast<std::int64_t>(std::round(position));
    while (index > 0 && beyond(at(index - 1))) --index;
    while (index < count && !beyond(at(index))) ++index;
    return index;
  }
};

/// Validates an axis.
/// @param axis  the axis
/// @param name  name of the quantity along the axis, for the message of the exception
/// @param unit  SI unit of this quantity, for the message; empty for a pure number
/// @throws InvalidParameter unless both ends are finite, min ≤ max and 1 ≤ count ≤ 10¹⁵
inline void validate(const Axis& axis, std::string_view name, std::string_view unit) {
  require_finite(name, axis.min, unit);
  require_within(name, axis.max, unit, axis.min, std::numeric_limits<double>::max());
  require_within("number of values along an axis", static_cast<double>(axis.count), "", 1.0, 1e15);
}

}  // namespace holdfast
