#pragma once

#include <string>

#include "holdfast/motion/trajectory.hpp"
#include "job.hpp"

namespace holdfast::program {

/// `--duration`, s, finite and not negative.
void add_duration(const Job& job, double& duration);

/// `--switching sampled`: the drive enters and leaves its backlash at samples, the paper's rule.
void add_switching(const Job& job, std::string& switching);

/// Throws NoAnswer when the motion diverged, saying when.
void require_completed(TrajectoryOutcome outcome, double time);

}  // namespace holdfast::program
