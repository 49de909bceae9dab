#pragma once

#include <cstdint>
#include <limits>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// The outcome of a motion in a sweep.
enum class MotionEnd {
  completed,    ///< all samples were taken
  diverged,     ///< the state left the range of the number type
  accumulates,  ///< more contact changes in one period than are computed (SwitchCounts)
};

/// The metrics of one motion of the sampled loop with backlash in a sweep. The displacement of the
/// conductor is z₁, that of the absorber z₂. Samples are taken at t_j = j τ, j = 0, 1, …, up to the
/// duration. Samples at or after half the duration, up to round-off, are called steady; metrics of
/// steady samples are NaN if there are none. For a motion that diverged, `first_peak` is valid,
/// `engaged_fraction` and `reversals_per_s` are NaN, and all other metrics are infinite.
/// For MotionEnd::accumulates all metrics are NaN, and `samples` counts the samples up to the start
/// of the period with too many contact changes.
struct MotionMetrics {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();  ///< NaN: no value

  MotionEnd end;                 ///< outcome, which determines which numbers are finite
  std::int64_t samples;          ///< number of samples; if diverged, of samples with a finite state
  double first_peak = unknown;   ///< |z₁| (m) at its first strict local extremum at j ≥ 1
  double steady_peak = unknown;  ///< max |z₁| (m) of the steady samples
  double steady_rms = unknown;   ///< √(mean z₁²) (m) of the steady samples
  double engaged_fraction = unknown;  ///< fraction of steady samples at which the drive transmits
  double force_peak = unknown;        ///< largest control force |u_j| (N) of all samples
  double force_rms = unknown;         ///< √(mean u_j²) (N) of the control force, steady samples
  /// Reversals of the drive per second (1/s): the number of times that Δż changed sign or became 0
  /// between steady samples, per time from the first to the last steady sample; NaN if this is 0 s
  double reversals_per_s = unknown;
  double absorber_stroke = unknown;  ///< max Δz − min Δz (m) of all samples, Δz = z₂ − z₁
};

}  // namespace holdfast
