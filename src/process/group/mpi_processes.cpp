#include "process/errors.hpp"
#include "process/group/process_group.hpp"

#ifdef HOLDFAST_HAS_MPI

#include <atomic>
#include <climits>
#include <exception>
#include <functional>
#include <optional>
#include <thread>

#include "process/interrupt.hpp"
#include "process/mpi/session.hpp"

namespace holdfast::program {
namespace {

using mpi::check;
using std::chrono::steady_clock;

constexpr std::chrono::seconds farewell_patience{2};
constexpr std::chrono::milliseconds attendance_period{2};

MPI_Comm copy_of(MPI_Comm processes) {
  MPI_Comm copy = MPI_COMM_NULL;
  check(MPI_Comm_dup(processes, &copy), "make a communicator");
  return copy;
}

int rank_in(MPI_Comm processes) {
  int rank = 0;
  MPI_Comm_rank(processes, &rank);
  return rank;
}

int number_of(MPI_Comm processes) {
  int size = 0;
  MPI_Comm_size(processes, &size);
  return size;
}

/// A number in the memory of process 0 that all processes count up, each without the others' help.
///
/// Where the network does not count by itself, MPI answers the others only while process 0 is in
/// one of its calls, and its workers may not come to one for minutes: a thread of it sees to that.
class Counter {
 public:
  /// Starts at 0. Every process of the communicator has to; so with free().
  Counter(mpi::Session& session, MPI_Comm processes) : session_(session), processes_(processes) {
    constexpr const char* task = "share a counter";
    constexpr int bytes = sizeof(std::int64_t);
    const int rank = rank_in(processes);
    std::int64_t* number = nullptr;
    check(
        MPI_Win_allocate(rank == 0 ? bytes : 0, bytes, MPI_INFO_NULL, processes, &number, &window_),
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
  ~Counter() { stop_attending(); }
  Counter(const Counter&) = delete;
  Counter& operator=(const Counter&) = delete;

  /// Gives the number, and adds the term to it.
  std::int64_t add(std::int64_t term) {
    const auto guard = session_.lock();
    std::int64_t before = 0;
    check(MPI_Fetch_and_op(&term, &before, MPI_INT64_T, 0, 0, MPI_SUM, window_), "count");
    check(MPI_Win_flush(0, window_), "count");
    return before;
  }

  void free() {
    stop_attending();
    check(MPI_Win_unlock_all(window_), "give a counter back");
    check(MPI_Win_free(&window_), "give a counter back");
  }

 private:
  void attend() {
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

  void stop_attending() {
    attending_ = false;
    if (attendant_.joinable()) attendant_.join();
  }

  mpi::Session& session_;
  MPI_Comm processes_;
  MPI_Win window_ = MPI_WIN_NULL;
  std::atomic<bool> attending_{false};
  std::thread attendant_;
};

/// One exchange of texts between all processes of a communicator, as ProcessGroup::exchange().
///
/// An interruption leaves it unfinished, and MPI then still reads and writes its members: it has to
/// live as long as MPI is called.
class Exchange {
 public:
  Exchange(mpi::Session& session, MPI_Comm processes, const std::string& text)
      : session_(session),
        processes_(processes),
        sent_(text.size() <= INT_MAX ? text : std::string()),
        length_(text.size() <= INT_MAX ? static_cast<int>(text.size()) : -1),
        lengths_(static_cast<std::size_t>(number_of(processes)), 0) {}

  /// Waits for the others. To be called once.
  std::vector<std::string> texts() {
    wait_for([this](MPI_Request* request) {
      return MPI_Iallgather(&length_, 1, MPI_INT, lengths_.data(), 1, MPI_INT, processes_, request);
    });
    place_texts();
    wait_for([this](MPI_Request* request) {
      return MPI_Iallgatherv(sent_.data(), length_, MPI_BYTE, received_.data(), lengths_.data(),
                             starts_.data(), MPI_BYTE, processes_, request);
    });
    std::vector<std::string> texts;
    for (std::size_t k = 0; k < lengths_.size(); ++k)
      texts.push_back(received_.substr(static_cast<std::size_t>(starts_[k]),
                                       static_cast<std::size_t>(lengths_[k])));
    return texts;
  }

  /// Whether MPI has done with the members.
  bool finished() { return session_.completed(request_); }

 private:
  void wait_for(const std::function<int(MPI_Request*)>& start) {
    {
      const auto guard = session_.lock();
      check(start(&request_), "exchange texts");
    }
    for (mpi::Pause pause; !finished(); pause.take()) throw_if_interrupted();
  }

  /// Every process knows all lengths, so that either all refuse or none.
  void place_texts() {
    std::int64_t end = 0;
    for (const int length : lengths_) {
      starts_.push_back(static_cast<int>(end));
      end += length;
      if (length < 0 || end > INT_MAX)
        throw NoAnswer("the processes must exchange more than the 2 GiB that MPI can carry");
    }
    received_.resize(static_cast<std::size_t>(end));
  }

  mpi::Session& session_;
  MPI_Comm processes_;
  MPI_Request request_ = MPI_REQUEST_NULL;
  std::string sent_, received_;
  int length_;  // of the own text; −1: more than MPI counts
  std::vector<int> lengths_, starts_;
};

class MpiProcesses final : public ProcessGroup {
 public:
  MpiProcesses() = default;
  ~MpiProcesses() override;
  MpiProcesses(const MpiProcesses&) = delete;
  MpiProcesses& operator=(const MpiProcesses&) = delete;

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  std::int64_t take_tickets(std::int64_t count) override { return tickets_.add(count); }

  std::vector<std::string> exchange(const std::string& text) override;

 private:
  bool failed() const { return std::uncaught_exceptions() > exceptions_before_; }
  bool everyone_leaves();
  void leave();

  const int exceptions_before_ = std::uncaught_exceptions();
  mpi::Session session_;
  MPI_Comm processes_ = copy_of(MPI_COMM_WORLD);
  MPI_Comm leaving_ = copy_of(MPI_COMM_WORLD);  // apart, so that no farewell meets an exchange
  const int rank_ = rank_in(processes_);
  const int size_ = number_of(processes_);
  Counter tickets_{session_, processes_};
  std::unique_ptr<Exchange> exchange_;
};

std::vector<std::string> MpiProcesses::exchange(const std::string& text) {
  // An interruption cut the last one short; the others may still be in it.
  if (exchange_ != nullptr && !exchange_->finished()) throw Interrupted();
  exchange_ = std::make_unique<Exchange>(session_, processes_, text);
  auto texts = exchange_->texts();
  exchange_.reset();
  return texts;
}

/// Whether all processes come to their destructors and nothing is left open between them. Where
/// nothing has gone wrong here they are waited for as long as it takes.
bool MpiProcesses::everyone_leaves() {
  MPI_Request request = MPI_REQUEST_NULL;
  {
    const auto guard = session_.lock();
    check(MPI_Ibarrier(leaving_, &request), "take leave");
  }
  std::optional<steady_clock::time_point> hurried_since;
  for (mpi::Pause pause; !session_.completed(request); pause.take()) {
    if (!hurried_since && (failed() || interrupted())) hurried_since = steady_clock::now();
    if (hurried_since && steady_clock::now() - *hurried_since > farewell_patience) return false;
  }
  return exchange_ == nullptr || exchange_->finished();
}

void MpiProcesses::leave() {
  tickets_.free();
  MPI_Comm_free(&leaving_);
  MPI_Comm_free(&processes_);
  failed() ? session_.end_at_exit() : session_.end();
}

MpiProcesses::~MpiProcesses() {
  try {
    if (everyone_leaves()) {
      leave();
      return;
    }
  } catch (const NoAnswer&) {
    // MPI is of no use any more; the others are ended at exit.
  }
  // MPI is called once more, at exit, and may still hold on to what an exchange has lent it.
  static_cast<void>(exchange_.release());
}

}  // namespace

std::unique_ptr<ProcessGroup> mpi_processes() { return std::make_unique<MpiProcesses>(); }

}  // namespace holdfast::program

#else

namespace holdfast::program {

std::unique_ptr<ProcessGroup> mpi_processes() {
  throw NoAnswer(
      "several processes were started together, which needs MPI, and this program was built "
      "without it: install the package libopenmpi-dev and build again, or start it alone");
}

}  // namespace holdfast::program

#endif
