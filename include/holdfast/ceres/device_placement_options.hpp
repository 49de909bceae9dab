#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "holdfast/core/compiler.hpp"

/// Options and results of the search for a device's best place and strength; Ceres is not needed.
namespace holdfast::placement {

/// One value of a device that the search varies, such as its place, damping or gain.
struct MovableValue {
  double lower;  ///< lower bound, finite, > 0 with `by_ratio`
  double upper;  ///< upper bound, finite, > lower
  /// Present value, lower … upper, an additional start of the search; NaN: none
  double present = std::numeric_limits<double>::quiet_NaN();
  bool by_ratio = false;  ///< whether the value varies on a logarithmic scale
  int places = 9;         ///< number of grid points from bound to bound, 2 … 1000
};

/// A function from the device's values to a fixed number of levels (> 0), for example one per mode
/// or per frequency of a band. The search minimises the largest level. For inadmissible values the
/// function returns an empty vector, or a level that is not finite.
using Levels = std::function<std::vector<double>(const std::vector<double>&)>;

/// Options of the search.
struct PlacementOptions {
  int runs = 4;  ///< largest number of grid minima from which the search starts, 1 … 1000
  /// Exponents p (2 … 1000) of the norms (Σ level^p)^{1/p}, which are minimised one after the other
  std::vector<double> norms = {8.0, 32.0, 128.0};
  double resolution = 1e-6;     ///< smallest step relative to a value's range, 10⁻¹⁴ … 0.5
  std::function<void()> watch;  ///< called at each evaluation of the levels; may throw
};

/// The position of one value of the result relative to its bounds, to 10⁻⁴ of its range.
enum class PlacementBound {
  none,   ///< value between its bounds
  lower,  ///< value at its lower bound
  upper   ///< value at its upper bound
};

/// Result of the search: the device values at which the largest level is lowest.
struct Placement {
  std::vector<double> values;          ///< best values; empty if no point evaluated was admissible
  double worst;                        ///< largest level at the best values; ∞ if there are none
  std::size_t worst_at;                ///< index of the largest level, from 0
  std::vector<PlacementBound> bounds;  ///< position of each value relative to its bounds
  int questions;                       ///< number of evaluations of the levels
};

}  // namespace holdfast::placement
