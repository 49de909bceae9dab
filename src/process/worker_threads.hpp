#pragma once

namespace holdfast::program {

/// Number of worker threads: `requested` where that is > 0, else the cores that this process may
/// run on (sched_getaffinity), which the batch system or taskset has left to it; at least 1.
int worker_threads(int requested);

}  // namespace holdfast::program
