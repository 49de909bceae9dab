#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "holdfast/core/compiler.hpp"

/// Options and results of the search for a device's best place and strength; this header needs no
/// Ceres.
namespace holdfast::placement {

/// One number of a device that may be moved: its place, a damping, a gain.
struct MovableValue {
  double lower;  ///< finite, > 0 with `by_ratio`
  double upper;  ///< finite, above the lower one
  /// Where it stands now, lower … upper; NaN: nowhere that counts
  double present = std::numeric_limits<double>::quiet_NaN();
  bool by_ratio = false;  ///< whether it is searched by its logarithm
  int places = 9;         ///< of the first grid along it, 2 … 1000, its ends among them
};

/// Levels to be made small with some values: one (> 0) for each frequency of a band, or each mode,
/// always as many. None, or one that is not finite: the values are not admissible.
using Levels = std::function<std::vector<double>(const std::vector<double>&)>;

/// How the search goes.
struct PlacementOptions {
  int runs = 4;  ///< so many of the grid's best places are begun from, ≥ 1
  /// The exponents p of the norms (Σ level^p)^{1/p} that stand for the largest level, one run of
  /// Ceres after the other; each ≥ 2
  std::vector<double> norms = {8.0, 32.0, 128.0};
  double resolution = 1e-6;     ///< of the way from bound to bound, to which the answer is refined
  std::function<void()> watch;  ///< called at each question; may throw
};

/// Where one value of an answer lies.
enum class PlacementBound {
  none,   ///< between its bounds
  lower,  ///< at the lower one
  upper   ///< at the upper one
};

/// The values whose largest level is the least that was found.
struct Placement {
  std::vector<double> values;          ///< empty: no values that were asked are admissible
  double worst;                        ///< the largest level with them
  std::size_t worst_at;                ///< its number, from 0
  std::vector<PlacementBound> bounds;  ///< of each value
  int questions;                       ///< how often the levels were asked
};

}  // namespace holdfast::placement
