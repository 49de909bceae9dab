// Run by mpirun: process_group_check SCENARIO [FILE]. Exit code 0 when every property holds.
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <thread>

#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/group/process_group.hpp"
#include "process/interrupt.hpp"
#include "process/worker_threads.hpp"

namespace holdfast::program {
namespace {

constexpr std::int64_t ticket_count = 200;

void require(bool holds, const std::string& property) {
  if (!holds) throw NoAnswer("not so: " + property);
}

void pause_shortly() { std::this_thread::sleep_for(std::chrono::milliseconds(5)); }

/// The tickets below ticket_count that this thread gets.
std::vector<std::int64_t> draw(ProcessGroup& group) {
  std::vector<std::int64_t> drawn;
  for (;;) {
    const std::int64_t ticket = group.take_tickets(1);
    if (ticket >= ticket_count) return drawn;
    drawn.push_back(ticket);
    // So that every thread and process comes to its turn.
    if (ticket % 8 == 0) pause_shortly();
  }
}

std::string drawn_by_threads(ProcessGroup& group, std::size_t thread_count) {
  std::vector<std::vector<std::int64_t>> drawn(thread_count);
  std::vector<std::thread> threads;
  threads.reserve(thread_count);
  for (auto& own : drawn) threads.emplace_back([&group, &own] { own = draw(group); });
  for (std::thread& thread : threads) thread.join();
  std::ostringstream text;
  for (const auto& own : drawn) {
    for (const std::int64_t ticket : own) text << ticket << ' ';
  }
  return text.str();
}

/// How often the processes together have drawn each of the tickets below ticket_count.
std::vector<int> times_given(ProcessGroup& group, const std::string& drawn) {
  std::vector<int> given(ticket_count, 0);
  for (const std::string& text : group.exchange(drawn)) {
    std::istringstream stream(text);
    for (std::size_t ticket = 0; stream >> ticket;) ++given.at(ticket);
  }
  return given;
}

void check_every_ticket_is_given_once(ProcessGroup& group) {
  for (const int times : times_given(group, drawn_by_threads(group, 3)))
    require(times == 1, "every ticket is given once");
  // Each thread has learnt from one ticket more that there are no others.
  require(group.take_tickets(0) == ticket_count + 3 * group.size(), "take_tickets(0) counts all");
}

/// Of length 0 for some ranks and of some MB for others, with bytes of every value.
std::string text_of_rank(int rank, int round) {
  const auto seed = static_cast<std::size_t>(rank) + static_cast<std::size_t>(round);
  std::string text(seed % 3 == 0 ? 0 : seed * seed * 700'001, '\0');
  for (std::size_t k = 0; k < text.size(); ++k) text[k] = static_cast<char>((k * k + seed) % 256);
  return text;
}

void check_exchange_orders_by_rank(ProcessGroup& group) {
  for (int round = 0; round < 4; ++round) {
    const auto texts = group.exchange(text_of_rank(group.rank(), round));
    require(texts.size() == static_cast<std::size_t>(group.size()), "one text from each");
    for (int rank = 0; rank < group.size(); ++rank) {
      require(texts[static_cast<std::size_t>(rank)] == text_of_rank(rank, round),
              "the texts stand in the order of the ranks");
    }
  }
}

/// Every process passes over a number of tickets of its own, together
/// ticket_count · (1 + … + size).
void check_all_can_pass_over_tickets(ProcessGroup& group) {
  const std::int64_t size = group.size();
  const std::int64_t before = group.take_tickets(0);
  group.exchange("");
  group.take_tickets(ticket_count * (group.rank() + 1));
  group.exchange("");
  const std::int64_t first_left = before + ticket_count * size * (size + 1) / 2;
  const std::int64_t ticket = group.take_tickets(1);
  require(ticket >= first_left && ticket < first_left + size, "take_tickets() adds up");
  group.exchange("");
  require(group.take_tickets(0) == first_left + size, "take_tickets(0) counts what is skipped");
}

void check_ranks(ProcessGroup& group) {
  const MpiLaunch launch = mpi_launch();
  require(group.rank() == launch.rank && group.size() == launch.size,
          "the environment and MPI agree");
}

/// Together the processes of a machine take as many threads as it has cores, or one each.
void check_threads_share_the_cores(ProcessGroup& group) {
  require(worker_threads(7, group) == 7, "a number that was asked for is taken");
  const int threads = worker_threads(0, group);
  require(threads >= 1, "at least one thread");
  const std::string machine = own_cores().machine;
  const auto machines = group.exchange(machine);
  const auto threads_of = group.exchange(std::to_string(threads));
  int processes = 0, sum = 0;
  for (std::size_t rank = 0; rank < machines.size(); ++rank) {
    if (machines[rank] != machine) continue;
    ++processes;
    sum += std::stoi(threads_of[rank]);
  }
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  require(sum <= std::max(cores, processes), "no core has two threads while there are enough");
}

void cooperate(ProcessGroup& group, const std::string&) {
  check_ranks(group);
  check_every_ticket_is_given_once(group);
  check_all_can_pass_over_tickets(group);
  check_exchange_orders_by_rank(group);
  check_threads_share_the_cores(group);
}

/// Of two processes the first, which holds the counter, calls nothing until the other has drawn
/// all.
void draw_while_the_first_rests(ProcessGroup& group, const std::string& file) {
  if (group.rank() == 0) {
    while (!std::filesystem::exists(file)) {
      throw_if_interrupted();
      pause_shortly();
    }
  } else {
    require(draw(group).size() == ticket_count, "the only process that draws gets all tickets");
    std::ofstream(file) << "drawn";
  }
  group.exchange("");
}

/// The last process gives the work up after three tickets, and with it all that others have not
/// drawn.
void give_up(ProcessGroup& group, const std::string&) {
  const bool gives_up = group.rank() == group.size() - 1;
  std::string drawn;
  for (int k = 0; gives_up && k < 3; ++k) drawn += std::to_string(group.take_tickets(1)) + ' ';
  group.exchange("");
  if (gives_up) {
    group.take_tickets(ticket_count);
    require(draw(group).empty(), "who has given up gets no ticket");
  } else {
    drawn += drawn_by_threads(group, 3);
  }
  std::int64_t sum = 0;
  for (const int times : times_given(group, drawn)) {
    require(times <= 1, "no ticket is given twice");
    sum += times;
  }
  const std::int64_t refused = 3 * (group.size() - 1) + 1;
  require(group.take_tickets(0) == ticket_count + sum + refused,
          "every ticket is given, passed over or refused");
}

[[noreturn]] void work_until_interrupted() {
  for (;;) {
    throw_if_interrupted();
    pause_shortly();
  }
}

/// One process fails outside of any exchange, another works and the third waits for both.
void fail_alone(ProcessGroup& group, const std::string&) {
  if (group.rank() == 1) throw NoAnswer("the second process fails");
  if (group.rank() == 2) work_until_interrupted();
  group.exchange("");
}

void fail_together(ProcessGroup& group, const std::string&) {
  const auto reasons = group.exchange(group.rank() == 1 ? "the second process fails" : "");
  if (group.rank() == 0) throw NoAnswer(reasons.at(1));
  throw std::runtime_error("told by the first");
}

void interrupt_one(ProcessGroup& group, const std::string&) {
  if (group.rank() == 1) std::raise(SIGTERM);
  group.exchange("");
  throw_if_interrupted();
}

using Scenario = std::function<void(ProcessGroup&, const std::string&)>;

const std::map<std::string, Scenario> scenarios = {
    {"cooperate", cooperate},
    {"rest", draw_while_the_first_rests},
    {"give_up", give_up},
    {"fail_alone", fail_alone},
    {"fail_together", fail_together},
    {"interrupt_one", interrupt_one},
};

int run(const std::vector<std::string>& arguments) {
  const auto scenario = scenarios.find(arguments.at(0));
  if (scenario == scenarios.end()) throw WrongInput("unknown scenario " + arguments.at(0));
  const auto group = join_process_group();
  struct sigaction action {};
  sigaction(SIGTERM, nullptr, &action);
  require(action.sa_handler != SIG_DFL, "signals still set a flag after MPI has started");
  scenario->second(*group, arguments.size() > 1 ? arguments[1] : "");
  return exit_code::done;
}

}  // namespace
}  // namespace holdfast::program

int main(int argument_count, char** arguments) {
  using namespace holdfast::program;
  return run_guarded([&] { return run({arguments + 1, arguments + argument_count}); });
}
