#include "process/mpi/counter.hpp"

namespace holdfast::program::mpi {
namespace {

constexpr std::chrono::milliseconds attendance_period{2};

}  // namespace

Counter::Counter(Session& session, MPI_Comm processes) : session_(session), processes_(processes) {
  constexpr const char* task = "share a counter";
  constexpr int bytes = sizeof(std::int64_t);
  int rank = 0;
  MPI_Comm_rank(processes, &rank);
  std::int64_t* number = nullptr;
  check(MPI_Win_allocate(rank == 0 ? bytes : 0, bytes, MPI_INFO_NULL, processes, &number, &window_),
        task);
  check(MPI_Win_set_errhandler(window_, MPI_ERRORS_RETURN), task);
  check(MPI_Win_lock_all(MPI_MODE_NOCHECK, window_), task);
  if (rank == 0) *number = 0;
  check(MPI_Win_sync(window_), task);
  check(MPI_Barrier(processes), task);
  if (rank != 0 || !session.serves_many_threads()) return;
  attending_ = true;
  attendant_ = std::thread([this] { attend(); });
}

Counter::~Counter() { stop_attending(); }

std::int64_t Counter::apply(std::int64_t term, MPI_Op operation) {
  const auto guard = session_.lock();
  std::int64_t before = 0;
  check(MPI_Fetch_and_op(&term, &before, MPI_INT64_T, 0, 0, operation, window_), "count");
  check(MPI_Win_flush(0, window_), "count");
  return before;
}

void Counter::attend() {
  while (attending_) {
    {
      // Any call lets MPI answer what has come; this one asks for nothing.
      const auto guard = session_.lock();
      int arrived = 0;
      MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, processes_, &arrived, MPI_STATUS_IGNORE);
    }
    std::this_thread::sleep_for(attendance_period);
  }
}

void Counter::stop_attending() {
  attending_ = false;
  if (attendant_.joinable()) attendant_.join();
}

void Counter::free() {
  stop_attending();
  check(MPI_Win_unlock_all(window_), "give a counter back");
  check(MPI_Win_free(&window_), "give a counter back");
}

}  // namespace holdfast::program::mpi
