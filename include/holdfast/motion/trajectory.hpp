#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "holdfast/core/errors.hpp"
#include "holdfast/motion/instant.hpp"
#include "holdfast/motion/sampled_motion.hpp"

namespace holdfast {

/// A sudden displacement of the conductor, as in Kollár 2022, Fig. 7.
struct Kick {
  double time;          ///< s; it acts at the first sample not before this instant, round-off apart
  double displacement;  ///< m, added to z₁
};

/// How a trajectory ended.
enum class TrajectoryOutcome {
  completed,  ///< all samples were taken
  diverged,   ///< the state left the range of the number type; the observers saw all samples before
              ///< that
};

/// Number of samples at t = 0, τ, 2τ, … up to the last one not after `duration`.
/// A duration meant as a whole number of periods counts its last sample in spite of round-off.
/// @throws InvalidParameter unless duration ≥ 0, τ > 0, and fewer than 2⁵³ samples
inline std::int64_t samples_within(double duration, double sampling_period) {
  require_non_negative("duration", duration, "s");
  require_positive("sampling period tau", sampling_period, "s");
  const double periods = duration / sampling_period;
  require_within("number of samples", periods, "", 0.0, 9.0e15);
  return static_cast<std::int64_t>(std::floor(periods * (1.0 + instant_round_off))) + 1;
}

/// Runs `samples` samples of a motion and shows each to every observer, `observer(const
/// MotionSample&)`.
///
/// The observers decide what is kept; nothing is allocated here. The motion is left at the sample
/// after the last one shown, so that a further call goes on from there.
template <class Motion, class... Observers>
TrajectoryOutcome run_trajectory(Motion& motion, std::int64_t samples,
                                 const std::optional<Kick>& kick, Observers&&... observers) {
  bool kicked = !kick;
  for (std::int64_t taken = 0; taken < samples; ++taken) {
    if (!kicked && not_before(motion.time(), kick->time)) {
      motion.displace_conductor(kick->displacement);
      kicked = true;
    }
    const auto sample = motion.sense();
    if (!std::isfinite(sample.state.sum())) return TrajectoryOutcome::diverged;
    (observers(sample), ...);
    motion.advance();
  }
  return TrajectoryOutcome::completed;
}

}  // namespace holdfast
