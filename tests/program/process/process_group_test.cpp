#include "process/group/process_group.hpp"

#include <sched.h>

#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/group/mpi_launch.hpp"
#include "process/interrupt.hpp"
#include "process/worker_threads.hpp"
#include "support/testing.hpp"

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
class LaunchedProcess {
 public:
  LaunchedProcess(const char* rank, const char* size) {
    setenv("OMPI_COMM_WORLD_RANK", rank, 1);
    setenv("OMPI_COMM_WORLD_SIZE", size, 1);
  }
  ~LaunchedProcess() {
    unsetenv("OMPI_COMM_WORLD_RANK");
    unsetenv("OMPI_COMM_WORLD_SIZE");
  }
  LaunchedProcess(const LaunchedProcess&) = delete;
  LaunchedProcess& operator=(const LaunchedProcess&) = delete;
  LaunchedProcess(LaunchedProcess&&) = delete;
  LaunchedProcess& operator=(LaunchedProcess&&) = delete;
};

/// One that stands in for several: exchange() gives the texts of the others.
class StandInGroup final : public ProcessGroup {
 public:
  StandInGroup(int rank, std::vector<std::string> texts) : rank_(rank), texts_(std::move(texts)) {}
  int rank() const override { return rank_; }
  int size() const override { return static_cast<int>(texts_.size()); }
  std::int64_t take_ticket() override { return 0; }
  void skip_tickets(std::int64_t) override {}
  std::int64_t tickets_taken() override { return 0; }
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

TEST(MpiLaunch, AProcessStartedAloneIsTheOnlyOne) {
  const MpiLaunch alone = launch_in({});
  EXPECT_EQ(alone.rank, 0);
  EXPECT_EQ(alone.size, 1);
}

TEST(MpiLaunch, KnowsTheVariablesOfEveryLauncher) {
  const std::vector<std::pair<std::string, std::string>> variables = {
      {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
      {"PMI_RANK", "PMI_SIZE"},
      {"MV2_COMM_WORLD_RANK", "MV2_COMM_WORLD_SIZE"},
      {"SLURM_PROCID", "SLURM_STEP_NUM_TASKS"}};
  for (const auto& [rank, size] : variables) {
    const MpiLaunch launch = launch_in({{rank, "2"}, {size, "48"}});
    EXPECT_EQ(launch.rank, 2) << rank;
    EXPECT_EQ(launch.size, 48) << size;
  }
}

TEST(MpiLaunch, ABatchScriptOfSlurmIsNotLaunched) {
  EXPECT_EQ(launch_in({{"SLURM_JOB_ID", "7"}, {"SLURM_NTASKS", "48"}, {"SLURM_PROCID", "0"}}).size,
            1);
}

TEST(MpiLaunch, MpirunCountsWithinAStepOfSlurm) {
  const MpiLaunch launch = launch_in({{"SLURM_PROCID", "0"},
                                      {"SLURM_STEP_NUM_TASKS", "2"},
                                      {"OMPI_COMM_WORLD_RANK", "5"},
                                      {"OMPI_COMM_WORLD_SIZE", "96"}});
  EXPECT_EQ(launch.rank, 5);
  EXPECT_EQ(launch.size, 96);
}

TEST(MpiLaunch, WhatMakesNoSenseDoesNotCount) {
  for (const auto& [rank, size] :
       std::vector<std::pair<const char*, const char*>>{{"2", "2"},
                                                        {"-1", "2"},
                                                        {"0", "0"},
                                                        {"0", "-3"},
                                                        {"0", "many"},
                                                        {"", "2"},
                                                        {"0x", "2"},
                                                        {"0", "99999999999999999999"}}) {
    EXPECT_EQ(launch_in({{"PMI_RANK", rank}, {"PMI_SIZE", size}}).size, 1) << rank << ' ' << size;
  }
  EXPECT_EQ(launch_in({{"PMI_SIZE", "2"}}).size, 1);
  EXPECT_EQ(launch_in({{"PMI_RANK", "1"}}).rank, 0);
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
      for (std::int64_t k = 0; k < tickets_of_thread; ++k) own.push_back(group->take_ticket());
    });
  }
  for (std::thread& thread : threads) thread.join();
  std::vector<int> given(4 * tickets_of_thread, 0);
  for (const auto& own : drawn) {
    for (const std::int64_t ticket : own) ++given.at(static_cast<std::size_t>(ticket));
  }
  EXPECT_EQ(given, std::vector<int>(given.size(), 1));
  EXPECT_EQ(group->tickets_taken(), 4 * tickets_of_thread);
}

TEST(ProcessGroup, WhatIsPassedOverIsGivenToNobody) {
  const auto group = single_process();
  EXPECT_EQ(group->take_ticket(), 0);
  group->skip_tickets(10);
  EXPECT_EQ(group->tickets_taken(), 11);
  EXPECT_EQ(group->take_ticket(), 11);
  group->skip_tickets(0);
  EXPECT_EQ(group->take_ticket(), 12);
}

TEST(ProcessGroup, AThreadThatGivesUpEndsTheHandOutForAll) {
  constexpr std::int64_t tickets = 1'000'000;
  const auto group = single_process();
  std::vector<std::int64_t> drawn(3, 0);
  std::vector<std::thread> threads;
  threads.reserve(drawn.size());
  for (auto& own : drawn) {
    threads.emplace_back([&group, &own] {
      while (group->take_ticket() < tickets) ++own;
    });
  }
  group->skip_tickets(tickets);
  EXPECT_GE(group->take_ticket(), tickets);
  for (std::thread& thread : threads) thread.join();
  const std::int64_t given = std::accumulate(drawn.begin(), drawn.end(), std::int64_t{0});
  constexpr std::int64_t refused = 4;
  EXPECT_EQ(group->tickets_taken(), given + tickets + refused);
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

TEST(RunGuarded, TheFirstOfSeveralProcessesTellsOfWrongInput) {
  const auto message_in_rank = [](const char* rank) {
    const LaunchedProcess launched(rank, "2");
    ::testing::internal::CaptureStderr();
    const int code = run_guarded([&rank]() -> int {
      // What the launcher does to the others once the first has ended.
      if (*rank != '0') raise(SIGTERM);
      throw WrongInput("the words");
    });
    clear_interrupt();
    EXPECT_EQ(code, exit_code::wrong_input);
    return ::testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(message_in_rank("0"), "holdfast: the words\n");
  EXPECT_EQ(message_in_rank("1"), "");
}

TEST(RunGuarded, InputThatIsWrongInAnotherProcessAloneIsToldByThatOne) {
  const LaunchedProcess launched("1", "2");
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(run_guarded([]() -> int { throw WrongInput("the words"); }), exit_code::wrong_input);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "holdfast: the words\n");
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

TEST(ShareOfCores, ProcessesWithCoresOfTheirOwnTakeThemAll) {
  EXPECT_EQ(shares_of({{"a", {0, 1, 2}}, {"a", {3}}, {"a", {4, 5}}}), (std::vector<int>{3, 1, 2}));
  EXPECT_EQ(shares_of({{"a", {0, 1}}, {"b", {0, 1}}}), (std::vector<int>{2, 2}));
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

TEST(ShareOfCores, EveryProcessHasAThreadWhereThereAreMoreThanCores) {
  EXPECT_EQ(shares_of({{"a", {0, 1}}, {"a", {0, 1}}, {"a", {0, 1}}}), (std::vector<int>{1, 1, 1}));
  EXPECT_EQ(shares_of({{"a", {}}}), std::vector<int>{1});
}

TEST(ShareOfCores, WhatOverlapsInPartIsDividedThere) {
  EXPECT_EQ(shares_of({{"a", {0, 1}}, {"a", {1, 2, 3}}}), (std::vector<int>{2, 2}));
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
