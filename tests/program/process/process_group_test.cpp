#include "process/group/process_group.hpp"

#include <sched.h>

#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/interrupt.hpp"
#include "process/worker_threads.hpp"
#include "support/other_gnuplot.hpp"

namespace holdfast::program {
namespace {

using LauncherEnvironment = std::map<std::string, std::string>;

MpiLaunch launch_in(const LauncherEnvironment& environment) {
  return mpi_launch([&environment](const char* name) -> const char* {
    const auto found = environment.find(name);
    return found == environment.end() ? nullptr : found->second.c_str();
  });
}

/// This process as one that Open MPI's launcher started, while the object lives.
struct LaunchedProcess {
  tests::Variable rank, size;
  LaunchedProcess(const char* of, const char* all)
      : rank("OMPI_COMM_WORLD_RANK", of), size("OMPI_COMM_WORLD_SIZE", all) {}
};

/// One that stands in for several: exchange() gives the texts of the others.
class StandInGroup final : public ProcessGroup {
 public:
  StandInGroup(int rank, std::vector<std::string> texts) : rank_(rank), texts_(std::move(texts)) {}
  int rank() const override { return rank_; }
  int size() const override { return static_cast<int>(texts_.size()); }
  std::int64_t take_tickets(std::int64_t) override { return 0; }
  std::vector<std::string> exchange(const std::string& text) override {
    for (std::string& other : texts_) {
      if (other.empty()) other = text;
    }
    return texts_;
  }

 private:
  int rank_;
  std::vector<std::string> texts_;
};

TEST(MpiLaunch, IsWhatTheVariablesOfALauncherSay) {
  const std::vector<std::tuple<LauncherEnvironment, int, int>> launches = {
      {{{"OMPI_COMM_WORLD_RANK", "2"}, {"OMPI_COMM_WORLD_SIZE", "48"}}, 2, 48},
      {{{"PMI_RANK", "2"}, {"PMI_SIZE", "48"}}, 2, 48},
      {{{"MV2_COMM_WORLD_RANK", "2"}, {"MV2_COMM_WORLD_SIZE", "48"}}, 2, 48},
      {{{"SLURM_PROCID", "2"}, {"SLURM_STEP_NUM_TASKS", "48"}}, 2, 48},
      // mpirun within a step of Slurm.
      {{{"SLURM_PROCID", "0"},
        {"SLURM_STEP_NUM_TASKS", "2"},
        {"OMPI_COMM_WORLD_RANK", "5"},
        {"OMPI_COMM_WORLD_SIZE", "96"}},
       5,
       96},
      // Alone: a batch script of Slurm too.
      {{}, 0, 1},
      {{{"SLURM_JOB_ID", "7"}, {"SLURM_NTASKS", "48"}, {"SLURM_PROCID", "0"}}, 0, 1},
      {{{"PMI_SIZE", "2"}}, 0, 1},
      {{{"PMI_RANK", "1"}}, 0, 1}};
  for (const auto& [environment, rank, size] : launches) {
    const MpiLaunch launch = launch_in(environment);
    EXPECT_EQ(launch.rank, rank) << ::testing::PrintToString(environment);
    EXPECT_EQ(launch.size, size) << ::testing::PrintToString(environment);
  }
}

TEST(MpiLaunch, WhatMakesNoSenseDoesNotCount) {
  const std::vector<std::pair<const char*, const char*>> senseless = {
      {"2", "2"},    {"-1", "2"}, {"0", "0"},  {"0", "-3"},
      {"0", "many"}, {"", "2"},   {"0x", "2"}, {"0", "99999999999999999999"}};
  for (const auto& [rank, size] : senseless)
    EXPECT_EQ(launch_in({{"PMI_RANK", rank}, {"PMI_SIZE", size}}).size, 1) << rank << ' ' << size;
}

TEST(ProcessGroup, AloneItIsTheFirstAndHearsItself) {
  const auto group = single_process();
  EXPECT_EQ(group->rank(), 0);
  EXPECT_EQ(group->size(), 1);
  EXPECT_EQ(group->exchange("text"), std::vector<std::string>{"text"});
}

TEST(ProcessGroup, ThreadsGetEveryTicketOnce) {
  constexpr std::int64_t tickets_of_thread = 1000;
  const auto group = single_process();
  std::vector<std::vector<std::int64_t>> drawn(4);
  std::vector<std::thread> threads;
  threads.reserve(drawn.size());
  for (auto& own : drawn) {
    threads.emplace_back([&group, &own] {
      for (std::int64_t k = 0; k < tickets_of_thread; ++k) own.push_back(group->take_tickets(1));
    });
  }
  for (std::thread& thread : threads) thread.join();
  std::vector<int> given(4 * tickets_of_thread, 0);
  for (const auto& own : drawn) {
    for (const std::int64_t ticket : own) ++given.at(static_cast<std::size_t>(ticket));
  }
  EXPECT_EQ(given, std::vector<int>(given.size(), 1));
  EXPECT_EQ(group->take_tickets(0), 4 * tickets_of_thread);
}

TEST(ProcessGroup, WhatIsPassedOverIsGivenToNobody) {
  const auto group = single_process();
  EXPECT_EQ(group->take_tickets(1), 0);
  group->take_tickets(10);
  EXPECT_EQ(group->take_tickets(0), 11);
  EXPECT_EQ(group->take_tickets(1), 11);
  group->take_tickets(0);
  EXPECT_EQ(group->take_tickets(1), 12);
}

TEST(ProcessGroup, AThreadThatGivesUpEndsTheHandOutForAll) {
  constexpr std::int64_t tickets = 1'000'000;
  const auto group = single_process();
  std::vector<std::int64_t> drawn(3, 0);
  std::vector<std::thread> threads;
  threads.reserve(drawn.size());
  for (auto& own : drawn) {
    threads.emplace_back([&group, &own] {
      while (group->take_tickets(1) < tickets) ++own;
    });
  }
  group->take_tickets(tickets);
  EXPECT_GE(group->take_tickets(1), tickets);
  for (std::thread& thread : threads) thread.join();
  const std::int64_t given = std::accumulate(drawn.begin(), drawn.end(), std::int64_t{0});
  constexpr std::int64_t refused = 4;
  EXPECT_EQ(group->take_tickets(0), given + tickets + refused);
}

TEST(ProcessGroup, WithoutALauncherItIsThisProcessAlone) {
  EXPECT_EQ(join_process_group()->size(), 1);
  const LaunchedProcess launched("0", "1");
  EXPECT_EQ(join_process_group()->size(), 1);
}

#ifndef HOLDFAST_HAS_MPI
TEST(ProcessGroup, WithoutMpiSeveralProcessesAreRefused) {
  const LaunchedProcess launched("1", "2");
  EXPECT_THROW(join_process_group(), NoAnswer);
}
#endif

/// What the process of a rank tells of an input that is wrong.
/// @param ended  as the launcher ends the others once the first has ended
std::string told_in_rank(const char* rank, bool ended) {
  const LaunchedProcess launched(rank, "2");
  ::testing::internal::CaptureStderr();
  const int code = run_guarded([&]() -> int {
    if (ended) raise(SIGTERM);
    throw WrongInput("the words");
  });
  clear_interrupt();
  EXPECT_EQ(code, exit_code::wrong_input);
  return ::testing::internal::GetCapturedStderr();
}

TEST(RunGuarded, TheFirstOfSeveralProcessesTellsOfWrongInputUnlessItIsWrongInAnotherAlone) {
  EXPECT_EQ(told_in_rank("0", false), "holdfast: the words\n");
  EXPECT_EQ(told_in_rank("1", true), "");
  EXPECT_EQ(told_in_rank("1", false), "holdfast: the words\n");
}

std::vector<int> shares_of(const std::vector<ProcessCores>& processes) {
  std::vector<int> shares;
  for (std::size_t k = 0; k < processes.size(); ++k) shares.push_back(share_of_cores(processes, k));
  return shares;
}

std::vector<int> first_cores(int count) {
  std::vector<int> cores(static_cast<std::size_t>(count));
  std::iota(cores.begin(), cores.end(), 0);
  return cores;
}

TEST(ShareOfCores, GoesToTheProcessThatHasFewest) {
  // Cores of their own; two machines; more processes than cores; none; an overlap.
  const std::vector<std::pair<std::vector<ProcessCores>, std::vector<int>>> shares = {
      {{{"a", {0, 1, 2}}, {"a", {3}}, {"a", {4, 5}}}, {3, 1, 2}},
      {{{"a", {0, 1}}, {"b", {0, 1}}}, {2, 2}},
      {{{"a", {0, 1}}, {"a", {0, 1}}, {"a", {0, 1}}}, {1, 1, 1}},
      {{{"a", {}}}, {1}},
      {{{"a", {0, 1}}, {"a", {1, 2, 3}}}, {2, 2}}};
  for (const auto& [processes, expected] : shares) EXPECT_EQ(shares_of(processes), expected);
}

TEST(ShareOfCores, EveryCoreGoesToOneProcessAndNoneToTwo) {
  for (int cores = 1; cores <= 20; ++cores) {
    for (int processes = 1; processes <= cores; ++processes) {
      const auto shares = shares_of(std::vector<ProcessCores>(static_cast<std::size_t>(processes),
                                                              {"a", first_cores(cores)}));
      EXPECT_EQ(std::accumulate(shares.begin(), shares.end(), 0), cores);
      const auto [fewest, most] = std::minmax_element(shares.begin(), shares.end());
      EXPECT_LE(*most - *fewest, 1) << cores << " cores, " << processes << " processes";
    }
  }
}

TEST(WorkerThreads, ANumberThatWasAskedForIsTaken) {
  EXPECT_EQ(worker_threads(7, *single_process()), 7);
}

TEST(WorkerThreads, ThereAreAsManyAsCoresThatTheProcessMayRunOn) {
  cpu_set_t before;
  ASSERT_EQ(sched_getaffinity(0, sizeof(before), &before), 0);
  EXPECT_EQ(worker_threads(0, *single_process()), CPU_COUNT(&before));
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(static_cast<std::size_t>(own_cores().cores.back()), &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof(one), &one), 0);
  EXPECT_EQ(worker_threads(0, *single_process()), 1);
  EXPECT_EQ(sched_setaffinity(0, sizeof(before), &before), 0);
}

TEST(WorkerThreads, ProcessesOfOneMachineDivideItsCores) {
  const int cores = static_cast<int>(own_cores().cores.size());
  int sum = 0;
  for (int rank = 0; rank < cores; ++rank) {
    // Empty texts: as many processes with this one's cores.
    StandInGroup group(rank, std::vector<std::string>(static_cast<std::size_t>(cores)));
    sum += worker_threads(0, group);
  }
  EXPECT_EQ(sum, cores);
  StandInGroup with_another_machine(0, {"", "elsewhere\n0 1 2 3 "});
  EXPECT_EQ(worker_threads(0, with_another_machine), cores);
}

}  // namespace
}  // namespace holdfast::program
