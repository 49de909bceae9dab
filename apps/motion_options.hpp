#pragma once

#include <cstdint>
#include <string>

#include "holdfast/motion/trajectory.hpp"
#include "interrupt.hpp"
#include "job.hpp"

namespace holdfast::program {

/// `--duration`, s, finite and not negative.
void add_duration(const Job& job, double& duration);

/// `--switching sampled`: the drive enters and leaves its backlash at samples, the paper's rule.
void add_switching(const Job& job, std::string& switching);

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

}  // namespace holdfast::program
