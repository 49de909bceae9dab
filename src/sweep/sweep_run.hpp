#pragma once

#include "process/job_context.hpp"
#include "sweep/sweep_plan.hpp"

namespace holdfast::program {

/// Computes a sweep and writes it: tiles are handed out to the threads of all processes, kept in a
/// work folder beside the output as they finish, and put together at the end.
///
/// Throws WrongInput for what SweepPlan, SweepOutput and TileStore refuse, NoAnswer and OutputError
/// as they do, Interrupted; where tiles are left for --resume, standard error says so.
void write_sweep(const JobContext& context, const SweepOptions& options);

/// Writes to standard output how large a sweep would be, and computes nothing: axes, cells, tiles,
/// samples, bytes of the tiles. Of several processes the first one writes.
void write_sweep_size(const JobContext& context, const SweepOptions& options);

}  // namespace holdfast::program
