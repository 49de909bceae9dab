#include "process/interrupt.hpp"

#include <pthread.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <string_view>

namespace holdfast::program {
namespace {

constexpr std::size_t path_size = 4096;

/// A path that the signal handler may read once `state` is 2.
struct Slot {
  std::atomic<int> state{0};  // 0 free, 1 being filled, 2 complete
  char path[path_size] = {};
};

std::atomic<int> signals_seen{0};
pthread_t taker = pthread_self();  // the thread that takes the signals
std::array<Slot, 8> slots;
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may take no lock");

/// Time for a computation to check the flag; longer than the two seconds for which processes of a
/// group wait for each other.
constexpr unsigned seconds_to_end = 3;

/// Passes a signal on to the thread `taker`; true if passed on. A signal arrives at any thread that
/// does not block it, but only one thread can hold all signals back.
bool handed_on(int signal_number) {
  return pthread_equal(pthread_self(), taker) == 0 && pthread_kill(taker, signal_number) == 0;
}

[[noreturn]] void end_at_once() {
  remove_unfinished_files();
  _exit(130);
}

extern "C" void holdfast_on_signal(int signal_number) {
  const int before = errno;
  const bool elsewhere = handed_on(signal_number);
  errno = before;
  if (elsewhere) return;
  if (signals_seen.fetch_add(1) > 0) end_at_once();
  alarm(seconds_to_end);
}

extern "C" void holdfast_on_alarm(int signal_number) {
  if (handed_on(signal_number)) return;
  constexpr std::string_view line = "holdfast: interrupted\n";
  [[maybe_unused]] const ssize_t ignored = write(STDERR_FILENO, line.data(), line.size());
  end_at_once();
}

void handle(int signal_number, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  // No SA_RESTART: a write that waits for a slow reader must also end.
  sigaction(signal_number, &action, nullptr);
}

bool is_ignored(int signal_number) {
  struct sigaction action {};
  return sigaction(signal_number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

void remove_unfinished_files() {
  for (const Slot& slot : slots) {
    if (slot.state.load() == 2) unlink(slot.path);
  }
}

void install_signal_handlers() {
  taker = pthread_self();
  handle(SIGINT, holdfast_on_signal);
  handle(SIGTERM, holdfast_on_signal);
  if (!is_ignored(SIGHUP)) handle(SIGHUP, holdfast_on_signal);  // nohup ignores it
  handle(SIGALRM, holdfast_on_alarm);
  handle(SIGPIPE, SIG_IGN);
  handle(SIGXFSZ, SIG_IGN);
}

void restore_signals_of_child() {
  handle(SIGPIPE, SIG_DFL);
  handle(SIGXFSZ, SIG_DFL);
}

bool interrupted() { return signals_seen.load(std::memory_order_relaxed) != 0; }

void throw_if_interrupted() {
  if (interrupted()) throw Interrupted();
}

void request_stop() { signals_seen.store(1); }

void forget_asking() { signals_seen.store(0); }

void clear_interrupt() {
  alarm(0);
  signals_seen.store(0);
}

SignalsHeld::SignalsHeld() {
  sigset_t held;
  sigemptyset(&held);
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP, SIGALRM})
    sigaddset(&held, signal_number);
  pthread_sigmask(SIG_BLOCK, &held, &before_);
}

SignalsHeld::~SignalsHeld() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

RemovedBySignal::RemovedBySignal(const char* path) {
  if (std::strlen(path) >= path_size) return;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    int free = 0;
    if (!slots[i].state.compare_exchange_strong(free, 1)) continue;
    std::strcpy(slots[i].path, path);
    slots[i].state.store(2);
    slot_ = static_cast<int>(i);
    return;
  }
}

RemovedBySignal::~RemovedBySignal() {
  if (slot_ >= 0) slots[static_cast<std::size_t>(slot_)].state.store(0);
}

}  // namespace holdfast::program
