#include "process/mpi/session.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program::mpi {
namespace {

std::atomic<bool> all_end{false};

extern "C" void holdfast_end_mpi_at_exit() {
  int finalized = 0;
  MPI_Finalized(&finalized);
  if (finalized != 0) return;
  if (all_end) {
    MPI_Finalize();
    return;
  }
  MPI_Abort(MPI_COMM_WORLD, interrupted() ? exit_code::interrupted : exit_code::no_answer);
}

}  // namespace

void check(int code, const char* task) {
  if (code == MPI_SUCCESS) return;
  char words[MPI_MAX_ERROR_STRING] = {};
  int length = 0;
  MPI_Error_string(code, words, &length);
  throw NoAnswer("MPI cannot " + std::string(task) + ": " + words);
}

Session::Session() {
  int started = 0;
  MPI_Initialized(&started);
  if (started != 0) throw std::logic_error("MPI can be started once per process");
  check(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &thread_level_), "start");
  std::atexit(holdfast_end_mpi_at_exit);
  // An MPI that handles signals itself would keep them from the program.
  install_signal_handlers();
  check(MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN), "hand over errors");
}

std::unique_lock<std::mutex> Session::lock() {
  if (!serves_many_threads() && std::this_thread::get_id() != first_thread_) {
    throw NoAnswer("this MPI supports only one thread per process: give --threads 1");
  }
  return std::unique_lock<std::mutex>(mutex_);
}

bool Session::completed(MPI_Request& request) {
  const auto guard = lock();
  int done = 0;
  check(MPI_Test(&request, &done, MPI_STATUS_IGNORE), "wait for the other processes");
  return done != 0;
}

void Session::end() { MPI_Finalize(); }

void Session::end_at_exit() { all_end = true; }

void Pause::take() {
  std::this_thread::sleep_for(length_);
  length_ = std::min(2 * length_, std::chrono::milliseconds(20));
}

}  // namespace holdfast::program::mpi
