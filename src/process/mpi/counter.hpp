#pragma once

#include <atomic>
#include <cstdint>
#include <thread>

#include "process/mpi/session.hpp"

namespace holdfast::program::mpi {

/// A number in the memory of process 0 that all processes count up, each without the others' help.
///
/// Where the network does not count by itself, MPI answers the others only while process 0 is in
/// one of its calls, and its workers may not come to one for minutes: a thread of it sees to that.
class Counter {
 public:
  /// Starts at 0. Every process of the communicator has to; so with free().
  Counter(Session& session, MPI_Comm processes);
  ~Counter();
  Counter(const Counter&) = delete;
  Counter& operator=(const Counter&) = delete;
  Counter(Counter&&) = delete;
  Counter& operator=(Counter&&) = delete;

  /// Gives the number and adds `term` to it.
  std::int64_t add(std::int64_t term) { return apply(term, MPI_SUM); }

  std::int64_t value() { return apply(0, MPI_NO_OP); }

  void free();

 private:
  std::int64_t apply(std::int64_t term, MPI_Op operation);
  void attend();
  void stop_attending();

  Session& session_;
  MPI_Comm processes_;
  MPI_Win window_ = MPI_WIN_NULL;
  std::atomic<bool> attending_{false};
  std::thread attendant_;
};

}  // namespace holdfast::program::mpi
