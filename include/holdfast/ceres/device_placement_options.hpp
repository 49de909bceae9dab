#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "holdfast/core/compiler.hpp"

/// Options and results of the search best_placement(); this header does not need Ceres Solver.
namespace holdfast::placement {

/// One value of a device that the search varies, such as its position, damping or gain.
struct MovableValue {
  double lower;  ///< lower bound, finite; > 0 if `by_ratio`
  double upper;  ///< upper bound, finite, > lower
  /// Present value, lower … upper: an additional start point of the search; NaN: none
  double present = std::numeric_limits<double>::quiet_NaN();
  bool by_ratio = false;  ///< whether the value is varied on a logarithmic scale
  int places = 9;         ///< number of grid points from lower to upper bound, 2 … 1000
};

/// A function that computes a fixed number of levels (> 0) from the device's values. A level is a
/// quantity to be kept low, for example the amplitude of one mode. The search minimises the largest
/// level. For inadmissible values the function returns an empty vector or a non-finite level.
using Levels = std::function<std::vector<double>(const std::vector<double>&)>;

/// Options of the search.
struct PlacementOptions {
  int runs = 4;  ///< largest number of local minima of the grid used as start points, 1 … 1000
  /// Exponents p (2 … 1000) of the norms (Σ level^p)^{1/p}, which are minimised one after the other
  std::vector<double> norms = {8.0, 32.0, 128.0};
  double resolution = 1e-6;  ///< smallest step as a fraction of a value's range, 10⁻¹⁴ … 0.5
  std::function<void()> watch;  ///< called before each evaluation of the levels; may throw to stop
};

/// Whether a value of the result lies at one of its bounds, to within 10⁻⁴ of its range.
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
  std::vector<PlacementBound> bounds;  ///< for each of `values`, whether it lies at a bound
  int questions;                       ///< number of evaluations of the levels
};

}  // namespace holdfast::placement
