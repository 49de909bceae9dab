#pragma once

#include <cstdint>

#include "holdfast/motion/implemented_loop.hpp"
#include "process/job_context.hpp"

namespace holdfast::program {

/// Writes what the case's motion is: one row with the verdict, the numbers behind it and the
/// sentence that says what it rests on.
/// @param largest_period  samples, of the search for an orbit
void write_verdict(const JobContext& context, std::int64_t largest_period, Switching switching);

}  // namespace holdfast::program
