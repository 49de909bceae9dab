#pragma once

#include "process/job_context.hpp"
#include "sweep/sweep_plan.hpp"

namespace holdfast::program {

/// Writes to standard output how large a sweep would be, and computes nothing: axes, cells, tiles,
/// samples, bytes of the tiles. Of several processes the first one writes.
void write_sweep_size(const JobContext& context, const SweepOptions& options);

}  // namespace holdfast::program
