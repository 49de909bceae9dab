#include "process/worker_threads.hpp"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <map>
#include <sstream>
#include <utility>

namespace holdfast::program {
namespace {

/// Name of the kernel's present run; the host's name where it tells none, which machines may have
/// in common ("localhost").
std::string machine_identity() {
  std::string identity;
  std::getline(std::ifstream("/proc/sys/kernel/random/boot_id"), identity);
  if (!identity.empty()) return identity;
  char name[256] = {};
  gethostname(name, sizeof(name) - 1);
  return name;
}

std::string cores_text(const ProcessCores& process) {
  std::ostringstream text;
  text << process.machine << '\n';
  for (const int core : process.cores) text << core << ' ';
  return text.str();
}

ProcessCores process_of(const std::string& text) {
  std::istringstream stream(text);
  ProcessCores process;
  std::getline(stream, process.machine);
  for (int core = 0; stream >> core;) process.cores.push_back(core);
  return process;
}

/// The processes, by number, that may run on each core of a machine; the cores that few may use
/// first.
std::vector<std::vector<std::size_t>> users_of_cores(const std::vector<ProcessCores>& processes,
                                                     const std::string& machine) {
  std::map<int, std::vector<std::size_t>> users;
  for (std::size_t k = 0; k < processes.size(); ++k) {
    if (processes[k].machine != machine) continue;
    for (const int core : processes[k].cores) users[core].push_back(k);
  }
  std::vector<std::vector<std::size_t>> result;
  result.reserve(users.size());
  for (auto& entry : users) result.push_back(std::move(entry.second));
  std::stable_sort(result.begin(), result.end(),
                   [](const auto& a, const auto& b) { return a.size() < b.size(); });
  return result;
}

}  // namespace

ProcessCores own_cores() {
  std::vector<cpu_set_t> set(1);
  // The kernel refuses a set that is too small for the cores it knows.
  while (sched_getaffinity(0, set.size() * sizeof(cpu_set_t), set.data()) != 0 && errno == EINVAL &&
         set.size() < 64) {
    set.resize(2 * set.size());
  }
  ProcessCores own{machine_identity(), {}};
  const std::size_t bytes = set.size() * sizeof(cpu_set_t);
  for (std::size_t core = 0; core < 8 * bytes; ++core) {
    if (CPU_ISSET_S(core, bytes, set.data())) own.cores.push_back(static_cast<int>(core));
  }
  return own;
}

int share_of_cores(const std::vector<ProcessCores>& processes, std::size_t own) {
  std::vector<int> shares(processes.size(), 0);
  for (const auto& users : users_of_cores(processes, processes[own].machine)) {
    const auto poorest =
        std::min_element(users.begin(), users.end(),
                         [&shares](std::size_t a, std::size_t b) { return shares[a] < shares[b]; });
    ++shares[*poorest];
  }
  return std::max(1, shares[own]);
}

int worker_threads(int requested, ProcessGroup& group) {
  if (requested > 0) return requested;
  std::vector<ProcessCores> processes;
  for (const std::string& text : group.exchange(cores_text(own_cores()))) {
    processes.push_back(process_of(text));
  }
  return share_of_cores(processes, static_cast<std::size_t>(group.rank()));
}

}  // namespace holdfast::program
