#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "process/group/process_group.hpp"

namespace holdfast::program {

/// A process and the cores of its machine that it may run on.
struct ProcessCores {
  std::string machine;  // differs between machines
  std::vector<int> cores;
};

/// This machine and the cores that this process may run on (sched_getaffinity): those that the
/// launcher, the batch system or taskset left to it.
ProcessCores own_cores();

/// How many cores fall to the process `own` where every core of a machine goes to the one of the
/// processes that may run on it that has fewest; at least 1.
int share_of_cores(const std::vector<ProcessCores>& processes, std::size_t own);

/// How many worker threads this process takes: `requested` where that is > 0, else its share of the
/// cores. All processes of the group ask, with the same number, as for exchange().
int worker_threads(int requested, ProcessGroup& group);

}  // namespace holdfast::program
