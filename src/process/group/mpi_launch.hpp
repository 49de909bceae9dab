#pragma once

#include <functional>
#include <string>

namespace holdfast::program {

/// This process among those that an MPI launcher started together, as far as the environment tells:
/// known before MPI is, and without it.
struct MpiLaunch {
  int rank = 0;
  int size = 1;  // 1: started alone
};

/// The value of an environment variable, or nullptr.
using EnvironmentLookup = std::function<const char*(const char* name)>;

/// Reads the variables of Open MPI (OMPI_COMM_WORLD_…), of PMI (MPICH, Intel MPI, Cray, and srun
/// with PMI: PMI_…), of MVAPICH (MV2_COMM_WORLD_…) and of srun (SLURM_STEP_NUM_TASKS,
/// SLURM_PROCID); the first pair that makes sense counts. A batch script of Slurm is itself started
/// alone, although it finds SLURM_NTASKS and SLURM_PROCID: the number of tasks of a step has only
/// what srun starts.
MpiLaunch mpi_launch(const EnvironmentLookup& environment);

/// The same of this process's environment.
MpiLaunch mpi_launch();

}  // namespace holdfast::program
