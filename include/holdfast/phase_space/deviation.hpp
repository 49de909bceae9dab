#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "holdfast/motion/trajectory.hpp"

namespace holdfast {

/// The difference of two motions at one sample.
struct Deviation {
  double time;          ///< instant (s)
  double displacement;  ///< z of the second motion minus z of the first (m)
  double state;         ///< Euclidean norm of the difference of the states, N × 1, SI numbers
  double rounding;      ///< bound of rounding in `state`: 2⁻⁵² times the larger state's norm

  /// Whether the difference `state` exceeds its bound of rounding.
  bool is_above_rounding() const { return state > rounding; }
};

/// Runs two motions of the same loop side by side and reports their difference at each sample.
///
/// Exponential separation of neighbouring motions is a mark of chaos. The two motions of Kollár
/// 2022, Fig. 11, start 10⁻⁵ m apart in z₁.
/// @tparam Motion   SampledMotion or EventMotion, of a plant of any order
/// @param first     reference motion, at the same sample as `second`, before `sense()`
/// @param second    the motion whose difference from the first is reported
/// @param samples   number of samples; fewer where a state leaves the range of numbers
/// @param observer  called with a `Deviation` at each sample
template <class Motion, class Observer>
TrajectoryOutcome run_deviation(Motion& first, Motion& second, std::int64_t samples,
                                Observer&& observer) {
  for (std::int64_t taken = 0; taken < samples; ++taken) {
    const auto a = first.sense();
    const auto b = second.sense();
    const auto difference = (b.state - a.state).eval();
    if (!std::isfinite(difference.sum())) return TrajectoryOutcome::diverged;
    const double rounding = 0x1.0p-52 * std::max<double>(a.state.norm(), b.state.norm());
    observer(
        Deviation{a.time, first.readings().displacement(difference), difference.norm(), rounding});
    first.advance();
    second.advance();
  }
  return TrajectoryOutcome::completed;
}

}  // namespace holdfast
