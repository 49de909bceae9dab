#pragma once

#include <mpi.h>

#include <chrono>
#include <mutex>
#include <thread>

namespace holdfast::program::mpi {

/// Throws NoAnswer, in MPI's words, unless `code` is MPI_SUCCESS. `task` goes on "MPI cannot".
void check(int code, const char* task);

/// MPI in this process, from its start to its end. It is started so that one thread at a time may
/// call it, and so that its failures are codes for check().
///
/// A session that is not ended ends all processes when this one exits: not every launcher does so
/// by itself, and they would wait for ever. At exit, since this one may have to say why before.
class Session {
 public:
  /// Throws std::logic_error where the process has started MPI before, NoAnswer where it fails.
  Session();

  /// To be held in every call of MPI. Throws NoAnswer where this MPI serves the thread that has
  /// started it alone, and another asks.
  std::unique_lock<std::mutex> lock();

  bool serves_many_threads() const { return thread_level_ >= MPI_THREAD_SERIALIZED; }

  /// Whether what the request stands for is done.
  bool completed(MPI_Request& request);

  /// Ends MPI, for which every process of the launch waits.
  void end();

  /// Ends MPI at exit, so that all have said what they have to when the first is gone: the launcher
  /// ends the others where one fails.
  void end_at_exit();

 private:
  int thread_level_ = MPI_THREAD_SINGLE;
  const std::thread::id first_thread_ = std::this_thread::get_id();
  std::mutex mutex_;
};

/// The pauses between two looks whether others have come, 1 ms at first and 20 ms later: MPI's own
/// waiting would keep a core busy that the workers of another process need.
class Pause {
 public:
  void take();

 private:
  std::chrono::milliseconds length_{1};
};

}  // namespace holdfast::program::mpi
