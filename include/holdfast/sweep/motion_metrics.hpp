#pragma once

#include <cstdint>
#include <limits>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// How a motion ended.
enum class MotionEnd {
  completed,    ///< all its samples were taken
  diverged,     ///< the state left the range of the number type
  accumulates,  ///< its changes of contact do (motion/event_motion.hpp): it cannot be followed
};

/// Metrics of one motion of the sampled loop with backlash, as a sweep keeps them.
///
/// t_j = j τ for j = 0, 1, … up to the last sample not after the duration. The steady samples are
/// those with t_j not before half the duration, round-off apart; where there are none, what is
/// taken of them is NaN. Everything of a motion that diverged is infinite but `engaged_fraction`
/// and `reversals_per_s`, which are NaN, and `first_peak`, which stays what it was. Where changes
/// of contact accumulate everything is NaN but the samples up to there.
struct MotionMetrics {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();  ///< NaN

  MotionEnd end;                 ///< decides which of the numbers below are finite
  std::int64_t samples;          ///< taken; of a motion that diverged, those with a finite state
  double first_peak = unknown;   ///< |z₁| (m) at its first strict local extremum at j ≥ 1
  double steady_peak = unknown;  ///< max |z₁| (m) of the steady samples
  double steady_rms = unknown;   ///< √(mean z₁²) (m) of the steady samples
  double engaged_fraction = unknown;  ///< share of the steady samples at which the drive transmits
  double force_peak = unknown;        ///< max |u_j| (N) of all samples: what the drive must deliver
  double force_rms = unknown;         ///< √(mean u_j²) (N) of the steady samples
  /// Reversals of the drive (1/s): how often Δż ≠ 0 changed its sign or became zero from one steady
  /// sample to the next, by the time from the first to the last of them; NaN where that is zero
  double reversals_per_s = unknown;
  double absorber_stroke = unknown;  ///< max Δz − min Δz (m) of all samples, Δz = z₂ − z₁
};

}  // namespace holdfast
