#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "holdfast/motion/trajectory.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "text/text.hpp"

namespace holdfast::program {

/// Throws Interrupted if the user or the system has asked to stop; checks this every 2¹⁴th sample.
/// @param sample  index of the current sample
inline void look_for_interrupt(std::int64_t sample) {
  constexpr std::int64_t samples_between_looks = 1 << 14;
  if (sample % samples_between_looks == 0) throw_if_interrupted();
}

/// Throws NoAnswer for a motion that diverged at `time` (s).
[[noreturn]] inline void refuse_diverging(double time) {
  throw NoAnswer("the motion diverges: its numbers overflow at t = " + format_number(time) +
                 " s; give a shorter --duration to see how it grows");
}

/// Throws NoAnswer if the outcome says that the motion diverged at `time` (s).
inline void require_completed(TrajectoryOutcome outcome, double time) {
  if (outcome == TrajectoryOutcome::diverged) refuse_diverging(time);
}

/// Runs a motion over `samples` samples and shows each to the observers, as `run_trajectory` does.
/// Throws Interrupted when the program is asked to stop, NoAnswer when the motion diverges.
template <class Motion, class... Observers>
void run_to_completion(Motion& motion, std::int64_t samples, const std::optional<Kick>& kick,
                       Observers&&... observers) {
  const auto look = [](const auto& sample) { look_for_interrupt(sample.index); };
  const TrajectoryOutcome outcome =
      run_trajectory(motion, samples, kick, look, std::forward<Observers>(observers)...);
  require_completed(outcome, motion.time());
}

}  // namespace holdfast::program
