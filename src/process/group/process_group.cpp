#include "process/group/process_group.hpp"

#include <atomic>
#include <exception>

#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/group/mpi_launch.hpp"

namespace holdfast::program {
namespace {

class SingleProcess final : public ProcessGroup {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  std::int64_t take_ticket() override { return tickets_.fetch_add(1); }
  void skip_tickets(std::int64_t count) override { tickets_.fetch_add(count); }
  std::int64_t tickets_taken() override { return tickets_.load(); }
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
    if (!code.empty()) throw ToldElsewhere(std::stoi(code));
}

}  // namespace holdfast::program
