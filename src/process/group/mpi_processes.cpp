#include "process/errors.hpp"
#include "process/group/process_group.hpp"

#ifdef HOLDFAST_HAS_MPI

#include <exception>
#include <optional>

#include "process/interrupt.hpp"
#include "process/mpi/counter.hpp"
#include "process/mpi/exchange.hpp"
#include "process/mpi/session.hpp"

namespace holdfast::program {
namespace {

using mpi::check;
using std::chrono::steady_clock;

constexpr std::chrono::seconds farewell_patience{2};

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

class MpiProcesses final : public ProcessGroup {
 public:
  MpiProcesses() = default;
  ~MpiProcesses() override;
  MpiProcesses(const MpiProcesses&) = delete;
  MpiProcesses& operator=(const MpiProcesses&) = delete;
  MpiProcesses(MpiProcesses&&) = delete;
  MpiProcesses& operator=(MpiProcesses&&) = delete;

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  std::int64_t take_ticket() override { return tickets_.add(1); }
  void skip_tickets(std::int64_t count) override { tickets_.add(count); }
  std::int64_t tickets_taken() override { return tickets_.value(); }

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
  mpi::Counter tickets_{session_, processes_};
  std::unique_ptr<mpi::Exchange> exchange_;
};

std::vector<std::string> MpiProcesses::exchange(const std::string& text) {
  // An interruption cut the last one short; the others may still be in it.
  if (exchange_ != nullptr && !exchange_->finished()) throw Interrupted();
  exchange_ = std::make_unique<mpi::Exchange>(session_, processes_, text);
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
