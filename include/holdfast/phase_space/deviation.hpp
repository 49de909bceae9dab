#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "holdfast/motion/trajectory.hpp"

namespace holdfast {

/// The difference of two motions at one sample.
struct Deviation {
  double time;          ///< instant (s)
  double displacement;  ///< conductor's displacement: second motion minus first (m)
  double state;         ///< Euclidean norm of the difference of the states in SI units
  double rounding;      ///< rounding bound of `state`: 2⁻⁵² times the larger state norm

  /// Whether the difference `state` exceeds its rounding bound.
  bool is_above_rounding() const { return state > rounding; }
};

/// Runs two motions of the same loop side by side and reports their difference at each sample.
///
/// Exponential separation of neighbouring motions indicates chaos. The two motions of Kollár 2022,
/// Fig. 11, start 10⁻⁵ m apart in z₁.
/// @tparam Motion   SampledMotion or EventMotion, of a plant of any order
/// @param first     reference motion, before sense() of the same sample as `second`
/// @param second    the motion whose difference from the first is reported
/// @param samples   number of samples
/// @param observer  called with a `Deviation` at each sample
/// @return `diverged` where the run ended early because a state is not finite
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
