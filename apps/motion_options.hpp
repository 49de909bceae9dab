#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "holdfast/motion/trajectory.hpp"
#include "interrupt.hpp"
#include "job.hpp"

namespace holdfast::program {

/// `--duration`, s, finite and not negative.
void add_duration(const Job& job, double& duration);

/// `--switching sampled`: the drive enters and leaves its backlash at samples, the paper's rule.
void add_switching(const Job& job, std::string& switching);

/// `--max-period`, samples, 1 to 10⁸.
void add_largest_period(const Job& job, std::int64_t& largest_period);

/// Observer of a trajectory that ends it when the user or the system asks the program to stop.
class StopWhenInterrupted {
 public:
  void operator()(const MotionSample<double>& sample) const {
    constexpr std::int64_t samples_between_looks = 1 << 14;
    if (sample.index % samples_between_looks == 0) throw_if_interrupted();
  }
};

/// Throws NoAnswer when the motion diverged, saying when.
void require_completed(TrajectoryOutcome outcome, double time);

/// Runs `samples` samples of a motion past the observers, as `run_trajectory` does, to the last
/// one. Ends early only by an exception: when the program is asked to stop, or NoAnswer when the
/// motion diverges.
template <class Motion, class... Observers>
void run_to_completion(Motion& motion, std::int64_t samples, const std::optional<Kick>& kick,
                       Observers&&... observers) {
  const TrajectoryOutcome outcome = run_trajectory(motion, samples, kick, StopWhenInterrupted(),
                                                   std::forward<Observers>(observers)...);
  require_completed(outcome, motion.time());
}

}  // namespace holdfast::program
