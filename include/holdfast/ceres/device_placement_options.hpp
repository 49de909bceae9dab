#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "holdfast/core/compiler.hpp"

/// Options and results of the search for a device's best place and strength; this header needs no
/// Ceres.
namespace holdfast::placement {

/// One number of a device that the search varies: its place, a damping, a gain.
struct MovableValue {
  double lower;  ///< lower bound, finite, > 0 with `by_ratio`
  double upper;  ///< upper bound, finite, > lower
  /// Present value, lower … upper; NaN: none
  double present = std::numeric_limits<double>::quiet_NaN();
  bool by_ratio = false;  ///< whether the value varies on a logarithmic scale
  int places = 9;         ///< number of grid points from bound to bound, 2 … 1000
};

/// Function from a device's values to a fixed number of levels (> 0), for example one for each mode
/// or each frequency of a band. The search minimises the largest level. For inadmissible values the
/// function returns no levels, or a level that is not finite.
using Levels = std::function<std::vector<double>(const std::vector<double>&)>;

/// Options of the search.
struct PlacementOptions {
  int runs = 4;  ///< number of the grid's best points from which the search starts, ≥ 1
  /// Exponents p ≥ 2 of the norms (Σ level^p)^{1/p}, minimised one after the other
  std::vector<double> norms = {8.0, 32.0, 128.0};
  double resolution = 1e-6;     ///< accuracy of each value relative to the range of its bounds
  std::function<void()> watch;  ///< called at each evaluation of the levels; may throw
};

/// The position of one value of the result relative to its bounds.
enum class PlacementBound {
  none,   ///< between its bounds
  lower,  ///< at its lower bound
  upper   ///< at its upper bound
};

/// Result of the search: the values at which the largest level is least.
struct Placement {
  std::vector<double> values;          ///< best values; empty if no point evaluated was admissible
  double worst;                        ///< largest level at the best values
  std::size_t worst_at;                ///< index of the largest level, from 0
  std::vector<PlacementBound> bounds;  ///< position of each value in its range
  int questions;                       ///< number of evaluations of the levels
};

}  // namespace holdfast::placement
