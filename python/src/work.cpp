#include "work.hpp"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "process/interrupt.hpp"

namespace holdfast::python {
namespace {

namespace nb = nanobind;

constexpr std::chrono::milliseconds between_looks(50);

/// The program has one flag that ends a computation: of two at once both would end.
std::timed_mutex working;
std::atomic<pid_t> worked_in{0};  // the process that has worked; 0: none

void refuse_forked_process() {
  pid_t none = 0;
  const pid_t own = getpid();
  if (!worked_in.compare_exchange_strong(none, own) && none != own)
    throw std::runtime_error(
        "holdfast had computed in this process before it was forked, and its threads did not come "
        "along: start processes with multiprocessing.get_context(\"spawn\") or \"forkserver\"");
}

thread_local bool calls_python = false;

void refuse_where_nobody_answers() {
  refuse_forked_process();
  if (calls_python)
    throw std::runtime_error(
        "a controller or progress callback calls holdfast again while holdfast waits for it: "
        "compute before, or keep what it needs and compute after");
}

/// Takes the lock, or gives up with a signal's exception.
void wait_for_turn(std::unique_lock<std::timed_mutex>& turn) {
  while (!turn.try_lock_for(between_looks)) {
    const nb::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
  }
}

}  // namespace

CallsPython::CallsPython() : outer_(std::exchange(calls_python, true)) {}
CallsPython::~CallsPython() { calls_python = outer_; }

void do_here(const std::function<void()>& work) {
  refuse_where_nobody_answers();
  const nb::gil_scoped_release released;
  std::unique_lock<std::timed_mutex> turn(working, std::defer_lock);
  wait_for_turn(turn);
  work();
}

void do_without_lock(const std::function<void()>& work, const std::function<void()>& watch) {
  refuse_where_nobody_answers();
  std::exception_ptr fault;              // of the work
  std::optional<nb::python_error> stop;  // of a signal or of `watch`
  {
    const nb::gil_scoped_release released;
    std::unique_lock<std::timed_mutex> turn(working, std::defer_lock);
    wait_for_turn(turn);
    std::mutex ending;
    std::condition_variable end;
    bool ended = false;
    std::thread worker([&] {
      try {
        work();
      } catch (...) {
        fault = std::current_exception();
      }
      const std::lock_guard<std::mutex> lock(ending);
      ended = true;
      end.notify_all();
    });
    std::unique_lock<std::mutex> lock(ending);
    while (!end.wait_for(lock, between_looks, [&] { return ended; })) {
      lock.unlock();
      if (!stop) {
        const nb::gil_scoped_acquire held;
        const CallsPython calls;
        try {
          if (PyErr_CheckSignals() != 0) throw nb::python_error();
          watch();
        } catch (nb::python_error& error) {
          stop.emplace(error);
          program::request_stop();
        }
      }
      lock.lock();
    }
    lock.unlock();
    worker.join();
    program::forget_asking();
  }
  if (stop) throw nb::python_error(*stop);
  if (fault) std::rethrow_exception(fault);
}

}  // namespace holdfast::python
