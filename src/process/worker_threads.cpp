#include "process/worker_threads.hpp"

#include <sched.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <vector>

namespace holdfast::program {

int worker_threads(int requested) {
  if (requested > 0) return requested;
  std::vector<cpu_set_t> set(1);
  // The kernel refuses a set that is smaller than its number of cores.
  while (sched_getaffinity(0, set.size() * sizeof(cpu_set_t), set.data()) != 0 && errno == EINVAL &&
         set.size() < 64) {
    set.resize(2 * set.size());
  }
  // Counted one by one, since WebAssembly has no CPU_COUNT_S.
  const std::size_t bytes = set.size() * sizeof(cpu_set_t);
  int cores = 0;
  for (std::size_t core = 0; core < 8 * bytes; ++core)
    cores += CPU_ISSET_S(core, bytes, set.data()) ? 1 : 0;
  return std::max(1, cores);
}

}  // namespace holdfast::program
