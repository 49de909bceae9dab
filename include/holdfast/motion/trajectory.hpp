#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>

#include "holdfast/core/errors.hpp"
#include "holdfast/motion/instant.hpp"
#include "holdfast/motion/sampled_motion.hpp"

namespace holdfast {

namespace detail {

template <class Motion, class = void>
struct IsMotion : std::false_type {};
template <class Motion>
struct IsMotion<Motion, std::void_t<decltype(std::declval<Motion&>().sense().state),
                                    decltype(std::declval<Motion&>().sense().control_force),
                                    decltype(std::declval<Motion&>().sense().engaged),
                                    decltype(std::declval<Motion&>().advance()),
                                    decltype(std::declval<Motion&>().displace_conductor(0.0)),
                                    decltype(std::declval<const Motion&>().index()),
                                    decltype(std::declval<const Motion&>().time()),
                                    decltype(std::declval<const Motion&>().state()),
                                    decltype(std::declval<const Motion&>().readings())>>
    : std::true_type {};

}  // namespace detail

/// Whether a type has the interface of a motion, listed below, which advances a sampled loop from
/// one sample to the next. In a SampledMotion or ModalMotion the contact changes at samples only.
/// An EventMotion also computes changes between samples. For a loop that ideal_loop() can convert,
/// SampledMotion and EventMotion have equal samples up to rounding.
///
///     sense()                  takes sample j: a MotionSample with t_j, x_j (N × 1), the force u_j
///                              (N) and whether the drive transmits; once before each `advance()`
///     advance()                moves from t_j to t_{j+1}
///     displace_conductor(d)    adds d (m) to the conductor's z, before `sense()`
///     index(), time()          j and t_j (s) of the sample that `sense()` will take or has taken
///     state()                  x_j, N × 1
///     readings()               functions that read displacements and velocities from a state
///                              (PortReadings)
template <class Motion>
inline constexpr bool is_motion_v = detail::IsMotion<Motion>::value;

/// A sudden displacement of the conductor (Kollár 2022, Fig. 7).
struct Kick {
  double time;          ///< instant (s); the kick acts at the first sample at or after this instant
  double displacement;  ///< displacement (m), added to the conductor's z₁
};

/// The outcome of a run of a motion over some samples.
enum class TrajectoryOutcome {
  completed,  ///< all samples were taken
  diverged,   ///< the state is not finite; observers received all earlier samples
};

/// The number of samples at t = 0, τ, 2τ, … up to `duration` (s). If the duration is a whole number
/// of sampling periods τ up to round-off, the sample at its end is included.
/// @throws InvalidParameter unless duration ≥ 0, τ > 0, and fewer than 2⁵³ samples
inline std::int64_t samples_within(double duration, double sampling_period) {
  require_non_negative("duration", duration, "s");
  require_positive("sampling period tau", sampling_period, "s");
  const double periods = duration / sampling_period;
  require_within("number of samples", periods, "", 0.0, 9.0e15);
  return static_cast<std::int64_t>(std::floor(periods * (1.0 + instant_round_off))) + 1;
}

/// Runs a motion over `samples` (≥ 0) samples, with a kick unless it is nullopt, and passes each
/// sample to every observer, `observer(const MotionSample&)`.
///
/// Only the observers store data; this function allocates no memory. A further call continues with
/// the next sample. A kick with an instant before the first sample acts at the first sample.
/// @tparam Motion  type for which is_motion_v is true, or any type with `sense`, `advance`,
///                 `displace_conductor` and `time` as described at is_motion_v
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
