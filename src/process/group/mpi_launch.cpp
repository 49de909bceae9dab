#include "process/group/mpi_launch.hpp"

#include <array>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <optional>

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

}  // namespace holdfast::program
