#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// Distances between the states of a series, each coordinate measured in its own extent:
///
///     d(x, y) = max_i |x_i − y_i| / (max x_i − min x_i)
///
/// so that 0 ≤ d ≤ 1 in any units. A coordinate that is constant to within round-off, 10⁻¹³ of its
/// own size, is left out; one that is nothing but round-off about zero needs a size given.
template <int Size>
class RelativeDistance {
 public:
  /// @param states  the series whose extents are the measure
  /// @param sizes   size of each coordinate where it is more than the series shows, as when the
  ///                motion has decayed from there
  /// @throws InvalidParameter for an empty series or a state that is not finite
  explicit RelativeDistance(const std::vector<Vector<double, Size>>& states,
                            const Vector<double, Size>& sizes = no_sizes()) {
    require_positive("number of states", static_cast<double>(states.size()), "");
    Vector<double, Size> low = states.front(), high = low;
    for (const auto& state : states) {
      for (const double entry : state) require_finite("coordinate of a state", entry, "");
      low = low.cwiseMin(state);
      high = high.cwiseMax(state);
    }
    Vector<double, Size> largest = low.cwiseAbs().cwiseMax(high.cwiseAbs());
    if (sizes.size() > 0) largest = largest.cwiseMax(sizes);
    const Vector<double, Size> extent = high - low;
    weights_ = (extent.array() > 1e-13 * largest.array()).select(extent.cwiseInverse(), 0.0);
  }

  /// Stands for sizes that are not known.
  static Vector<double, Size> no_sizes() { return Vector<double, Size>::Zero(Size < 0 ? 0 : Size); }

  /// d of two states, of which either may lie outside the series; 0 where no coordinate varies.
  double operator()(const Vector<double, Size>& one, const Vector<double, Size>& other) const {
    return (one - other).cwiseAbs().cwiseProduct(weights_).maxCoeff();
  }

 private:
  Vector<double, Size> weights_;
};

/// Least distance over all pairs of states of a series, relative to its extent: its closest return.
///
/// Work: N²/2 distances, N ≤ 5000.
/// @param states  x_j at successive samples, whose extents are the measure
/// @return 1 of a single state
/// @throws InvalidParameter for no or more than 5000 states, or a state not finite
template <int Size>
double closest_return(const std::vector<Vector<double, Size>>& states) {
  require_within("number of states", static_cast<double>(states.size()), "", 1.0, 5000.0);
  const RelativeDistance<Size> distance(states);
  double closest = 1.0;
  for (std::size_t lag = 1; lag < states.size(); ++lag)
    for (std::size_t j = lag; j < states.size(); ++j)
      closest = std::min(closest, distance(states[j], states[j - lag]));
  return closest;
}

/// Result of a search for repetition, and how far it looked.
struct RepeatSearch {
  std::size_t lag;          ///< the smallest lag that repeats, 0 where none does
  std::size_t largest_lag;  ///< the largest lag that was tried
  double tolerance;         ///< of a repeat, relative to the extent
};

/// Smallest lag n at which the whole second half of a series repeats itself,
///
///     d(x_j, x_{j−n}) ≤ tolerance   for every j ≥ N/2
///
/// with room for `repeats` of them: n ≤ N / (2 repeats). It is evidence and no proof: a motion of
/// slow drift or of a longer period may pass a coarse tolerance. Work: one distance a lag where it
/// fails at once; at worst N²/(4 repeats), N ≤ 10⁶.
/// @param states     x_0 … x_{N−1} at successive samples
/// @param tolerance  relative to the extent of the second half, 0 ≤ tolerance < 1
/// @param repeats    ≥ 1
/// @param sizes      see RelativeDistance: what has decayed below round-off of it is at rest
/// @throws InvalidParameter for no or more than 10⁶ states, a state not finite, or arguments out of
///         their ranges
template <int Size>
RepeatSearch repeats_after(const std::vector<Vector<double, Size>>& states, double tolerance,
                           std::size_t repeats = 3,
                           const Vector<double, Size>& sizes = RelativeDistance<Size>::no_sizes()) {
  require_within("number of states", static_cast<double>(states.size()), "", 1.0, 1e6);
  require_within("tolerance of a repeat", tolerance, "", 0.0, 1.0);
  require_within("number of repeats", static_cast<double>(repeats), "", 1.0, 1e6);
  const std::size_t half = states.size() / 2;
  const RelativeDistance<Size> distance(
      {states.begin() + static_cast<std::ptrdiff_t>(half), states.end()}, sizes);
  const std::size_t largest = half / repeats;
  for (std::size_t lag = 1; lag <= largest; ++lag) {
    std::size_t j = half;
    while (j < states.size() && distance(states[j], states[j - lag]) <= tolerance) ++j;
    if (j == states.size()) return {lag, largest, tolerance};
  }
  return {0, largest, tolerance};
}

/// Determinism of a series by its recurrence plot, the pairs of a state with itself left out: the
/// share of the pairs within a radius that lie on diagonal lines of two or more, of the returns
/// that are followed by another; 0 where nothing returns.
///
/// It is near 1 for a motion on a closed curve and about 1 − (1 − rate)² for chance, the rate being
/// the share of the pairs that are within the radius. Work: N²/2 distances and no storage,
/// N ≤ 5000. Source: N. Marwan et al., Physics Reports 438 (2007), 237–329.
/// @param states  x_j at successive samples, whose extents are the measure
/// @param radius  share of the extent, > 0
/// @throws InvalidParameter for fewer than two or more than 5000 states, a state not finite, or
///         another radius
template <int Size>
double recurrence_determinism(const std::vector<Vector<double, Size>>& states, double radius) {
  require_within("number of states", static_cast<double>(states.size()), "", 2.0, 5000.0);
  require_positive("recurrence radius", radius, "");
  const RelativeDistance<Size> distance(states);
  std::int64_t recurrent = 0, in_lines = 0;
  for (std::size_t lag = 1; lag < states.size(); ++lag) {
    std::int64_t run = 0;
    for (std::size_t j = lag; j <= states.size(); ++j) {
      if (j < states.size() && distance(states[j], states[j - lag]) <= radius) {
        ++run;
        continue;
      }
      recurrent += run;
      if (run >= 2) in_lines += run;
      run = 0;
    }
  }
  return recurrent > 0 ? static_cast<double>(in_lines) / static_cast<double>(recurrent) : 0.0;
}

}  // namespace holdfast
