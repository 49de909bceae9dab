#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

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

/// The launch in this process's environment.
MpiLaunch mpi_launch();

/// The processes that work on one computation: this one alone, or those that `mpirun` or `srun`
/// started.
///
/// The destructor of several processes waits until all have come to theirs. Where an exception or
/// a signal ends this one and the others do not follow within two seconds, they are ended as well,
/// once this process has said why and exits.
class ProcessGroup {
 public:
  virtual ~ProcessGroup() = default;
  ProcessGroup(const ProcessGroup&) = delete;
  ProcessGroup& operator=(const ProcessGroup&) = delete;

  /// Number of this process, 0 … size() − 1.
  virtual int rank() const = 0;
  virtual int size() const = 0;

  /// Takes the next `count` ≥ 0 numbers of a counter that all processes share, 0, 1, 2, …, and
  /// gives the first of them: each number is given once. A process that takes many passes over what
  /// is left of the work; one that takes none learns how many have been taken. Needs nothing of the
  /// other processes; any thread may ask.
  /// Throws NoAnswer where MPI fails, or can be used by the joining thread alone and another asks.
  virtual std::int64_t take_tickets(std::int64_t count) = 0;

  /// Every process brings a text and gets those of all, in the order of their ranks. Waits for all
  /// of them, without burdening a core; one thread of each.
  /// Throws Interrupted, what take_tickets() throws, and NoAnswer in every process where the texts
  /// together have 2³¹ bytes or more.
  virtual std::vector<std::string> exchange(const std::string& text) = 0;

 protected:
  ProcessGroup() = default;
};

/// This process alone.
std::unique_ptr<ProcessGroup> single_process();

/// The processes that were started together by an MPI launcher, when there is one and the program
/// is built with MPI; else this process alone. Once per program.
///
/// Throws NoAnswer where a launcher started several processes and they cannot work together, since
/// each would do the whole work: the program is built without MPI, or with another MPI than the
/// launcher's.
std::unique_ptr<ProcessGroup> join_process_group();

/// Starts MPI and joins the processes that its launcher started together. Where MPI cannot start
/// at all it says so itself and ends the process.
///
/// Throws NoAnswer where the program is built without MPI, and in MPI's words where it fails;
/// std::logic_error at the second call, since MPI starts once per process.
std::unique_ptr<ProcessGroup> mpi_processes();

/// A step that all processes of a group take, and that ends when the last of them has. What one
/// throws ends it in all: where it arose it comes out as it is, elsewhere as ReportedElsewhere with
/// the exit code of the first process at fault. All processes call it, in the same order.
void make_collective_call(ProcessGroup& group, const std::function<void()>& step);

}  // namespace holdfast::program
