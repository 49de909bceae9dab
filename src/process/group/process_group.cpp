#include "process/group/process_group.hpp"

#include <array>
#include <atomic>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <optional>

#include "process/errors.hpp"
#include "process/exit.hpp"

namespace holdfast::program {
namespace {

struct LauncherVariables {
  const char* size;
  const char* rank;
};

// mpirun may run under srun, so what mpirun sets comes first.
constexpr std::array<LauncherVariables, 4> launchers = {{
    {"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"},
    {"PMI_SIZE", "PMI_RANK"},
    {"MV2_COMM_WORLD_SIZE", "MV2_COMM_WORLD_RANK"},
    {"SLURM_STEP_NUM_TASKS", "SLURM_PROCID"},
}};

std::optional<int> whole_number(const char* text) {
  if (text == nullptr) return std::nullopt;
  int value = 0;
  const char* const end = text + std::strlen(text);
  const auto [stop, error] = std::from_chars(text, end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

class SingleProcess final : public ProcessGroup {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  std::int64_t take_tickets(std::int64_t count) override { return tickets_.fetch_add(count); }
  std::vector<std::string> exchange(const std::string& text) override { return {text}; }

 private:
  std::atomic<std::int64_t> tickets_{0};
};

/// Processes of another MPI's launcher find themselves alone, each of them.
void require_all(const MpiLaunch& launch, const ProcessGroup& group) {
  if (group.size() == launch.size) return;
  throw NoAnswer("the launcher started " + std::to_string(launch.size) +
                 " processes, but MPI finds " + std::to_string(group.size()) +
                 ": use the launcher of the MPI that the program is built with (under Slurm "
                 "mpirun, or srun --mpi=pmix)");
}

}  // namespace

MpiLaunch mpi_launch(const EnvironmentLookup& environment) {
  for (const LauncherVariables& variables : launchers) {
    const auto size = whole_number(environment(variables.size));
    const auto rank = whole_number(environment(variables.rank));
    if (size && rank && 0 <= *rank && *rank < *size) return {*rank, *size};
  }
  return {};
}

MpiLaunch mpi_launch() {
  return mpi_launch([](const char* name) -> const char* { return std::getenv(name); });
}

std::unique_ptr<ProcessGroup> single_process() { return std::make_unique<SingleProcess>(); }

std::unique_ptr<ProcessGroup> join_process_group() {
  const MpiLaunch launch = mpi_launch();
  if (launch.size == 1) return single_process();
  auto group = mpi_processes();
  require_all(launch, *group);
  return group;
}

void make_collective_call(ProcessGroup& group, const std::function<void()>& step) {
  std::exception_ptr fault;
  try {
    step();
  } catch (...) {
    fault = std::current_exception();
  }
  const std::vector<std::string> codes =
      group.exchange(fault ? std::to_string(exit_code_of(fault)) : "");
  if (fault) std::rethrow_exception(fault);
  for (const std::string& code : codes)
    if (!code.empty()) throw ReportedElsewhere(std::stoi(code));
}

}  // namespace holdfast::program
