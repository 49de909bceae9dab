#pragma once

#include <cstdint>
#include <string>

#include "holdfast/motion/implemented_loop.hpp"
#include "job.hpp"

namespace holdfast::program {

/// `--duration`, s, finite and not negative.
CLI::Option* add_duration(const Job& job, double& duration);

/// `--from`, s, finite and not negative: what comes before is left out.
void add_from(const Job& job, double& from);

/// `--switching`: the drive enters and leaves its backlash at samples, the paper's rule, or when it
/// happens.
void add_switching(const Job& job, Switching& switching);

/// `--max-period`, samples, 1 to 10⁸.
void add_largest_period(const Job& job, std::int64_t& largest_period);

}  // namespace holdfast::program
