#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// The distance between states of a series, each coordinate divided by its extent in the series:
///
///     d(x, y) = max_i |x_i − y_i| / extent_i,   extent_i = max − min of coordinate i
///
/// For states of the series 0 ≤ d ≤ 1. A coordinate counts as constant and is left out if its
/// extent is at most 10⁻¹³ of its largest magnitude, in the series or in `sizes`.
template <int Size>
class RelativeDistance {
 public:
  /// @param states  the series from which the extents are computed
  /// @param sizes   largest |x_i| of each coordinate i before the series; needed to recognise
  ///                coordinates that have decayed to round-off about zero
  /// @throws InvalidParameter where the series is empty or a state is not finite
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

  /// The default of the constructor's `sizes`: a zero vector, empty if Size is Eigen::Dynamic.
  static Vector<double, Size> no_sizes() { return Vector<double, Size>::Zero(Size < 0 ? 0 : Size); }

  /// The distance d of any two states; 0 where all coordinates of the series are constant.
  double operator()(const Vector<double, Size>& one, const Vector<double, Size>& other) const {
    return (one - other).cwiseAbs().cwiseProduct(weights_).maxCoeff();
  }

 private:
  Vector<double, Size> weights_;
};

/// The closest return of a series: the smallest RelativeDistance between any two of its states.
/// Work: N²/2 distances for N states.
/// @param states  x_j at successive samples; their extents define the distance
/// @return distance, 0 … 1; 1 for a single state
/// @throws InvalidParameter for no or more than 5000 states, or a state that is not finite
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

/// The result of a search for the lag (samples) after which a series repeats.
struct RepeatSearch {
  std::size_t lag;          ///< smallest lag after which the series repeats; 0: none was found
  std::size_t largest_lag;  ///< largest lag that was tested
  double tolerance;         ///< largest RelativeDistance that counted as a repeat
};

/// Searches for the smallest lag n after which a series of N states repeats in its second half,
///
///     d(x_j, x_{j−n}) ≤ tolerance   for every j ≥ N/2,   n ≤ N / (2 repeats)
///
/// where d is the RelativeDistance of the second half. The lag found need not be a period: a coarse
/// tolerance also admits slow drift or a longer period. Work: at most N²/(4 repeats) distances.
/// @param states     x_0 … x_{N−1} at successive samples
/// @param tolerance  largest distance d that counts as a repeat, 0 … 1, as a share of the extent
/// @param repeats    number of repetitions that must fit into the second half, 1 … 10⁶
/// @param sizes      largest |x_i| of each coordinate before the series, as in RelativeDistance
/// @throws InvalidParameter for no or more than 10⁶ states, a state that is not finite, or a
/// tolerance or number of repeats out of its range
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

/// The determinism of a series: the share of recurrent pairs of states that lie on diagonal lines
/// of its recurrence plot. A pair (x_j, x_{j−n}), n ≥ 1, is recurrent if its RelativeDistance is at
/// most `radius`. A diagonal line is two or more successive recurrent pairs with the same lag n.
///
/// The determinism is near 1 for a motion on a closed curve. For a random series it is about
/// 1 − (1 − p)², where p is the share of recurrent pairs. Work: N²/2 distances for N states.
/// @param states  x_j at successive samples; their extents define the distance
/// @param radius  largest distance of a recurrent pair, as a share of the extent, > 0
/// @return determinism, 0 … 1; 0 if no pair is recurrent
/// @throws InvalidParameter for fewer than two or more than 5000 states, a state that is not
/// finite, or a radius that is not positive
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
