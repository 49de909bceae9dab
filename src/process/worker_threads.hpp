#pragma once

namespace holdfast::program {

/// Number of worker threads: `requested` if > 0, else the number of cores on which this process may
/// run (sched_getaffinity; a batch system or taskset may restrict them), at least 1.
int worker_threads(int requested);

}  // namespace holdfast::program
