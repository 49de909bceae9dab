#include "store/fill_store.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "host/job_host.hpp"
#include "output/row_blocks.hpp"
#include "process/exit.hpp"
#include "process/interrupt.hpp"
#include "process/progress.hpp"
#include "process/worker_threads.hpp"
#include "text/checksum.hpp"

namespace holdfast::program {
namespace {

/// A number in which two processes hardly agree.
std::uint64_t number_of_this_process() {
  const auto now = std::chrono::system_clock::now().time_since_epoch().count();
  return checksum(std::to_string(now) + "-" + std::to_string(getpid()));
}

/// A chunk that is kept while the next one is computed: a thread need not wait for the disk.
class ChunkUnderWay {
 public:
  /// Keeps another one once the last is done.
  template <class Keep>
  void begin(Keep&& keep) {
    finish();
    done_ = std::async(way, std::forward<Keep>(keep));
  }

  /// Throws what could not be kept.
  void finish() {
    if (done_.valid()) done_.get();
  }

 private:
#ifdef __EMSCRIPTEN__  // a module has one thread
  static constexpr std::launch way = std::launch::deferred;
#else  // where the system has no further thread it is kept when it is asked for
  static constexpr std::launch way = std::launch::async | std::launch::deferred;
#endif

  std::future<void> done_;
};

/// One process at work on a store.
class StoreFilling {
 public:
  StoreFilling(const JobContext& context, const StoreFolder& store, ProcessGroup& group,
               const ChunkWork& work)
      : context_(context),
        store_(store),
        group_(group),
        work_(work),
        tickets_((store.grid().chunks() - work.part.number) / work.part.of + 1),
        first_ticket_(common_first_ticket()),
        progress_(static_cast<std::uint64_t>(store.grid().cells() / work.part.of), work.steps,
                  group.rank() == 0 && progress_wanted(context)) {}

  void run(int threads) {
    std::atomic<bool> stop{false};
    parallel_rows(threads, 1, threads, 0, [&](int&, std::int64_t, std::int64_t) {
      try {
        take_chunks(stop);
      } catch (...) {
        if (!stop.exchange(true)) give_up_tickets();
        throw;
      }
    });
  }

 private:
  /// The first process goes in order; one that joins later begins elsewhere, so that they rarely
  /// meet.
  std::int64_t common_first_ticket() {
    const bool begun = group_.rank() == 0 && store_.has(chunk_of(0));
    const std::uint64_t chosen =
        begun ? number_of_this_process() % static_cast<std::uint64_t>(tickets_) : 0;
    return std::stoll(group_.exchange(std::to_string(chosen)).front());
  }

  std::int64_t chunk_of(std::int64_t ticket) const {
    return work_.part.number - 1 + ticket * work_.part.of;
  }

  /// The other processes need not go on.
  void give_up_tickets() noexcept {
    try {
      group_.take_tickets(tickets_);
    } catch (...) {
      // They go on in vain; the fault that brought us here is the one to be told.
    }
  }

  /// Work of one thread: the next chunk, until there is none; then what others have not done.
  void take_chunks(const std::atomic<bool>& stop) {
    std::vector<std::int64_t> elsewhere;
    ChunkUnderWay under_way;
    while (!stop) {
      throw_if_interrupted();
      const std::int64_t ticket = group_.take_tickets(1);
      if (ticket >= tickets_) break;
      const std::int64_t chunk = chunk_of((first_ticket_ + ticket) % tickets_);
      if (!see_to(chunk, false, under_way)) elsewhere.push_back(chunk);
      show_others();
    }
    under_way.finish();  // others may wait for it
    while (!stop && !elsewhere.empty()) see_to_others(elsewhere, under_way);
  }

  /// Waits for what others have, and does what they leave.
  void see_to_others(std::vector<std::int64_t>& elsewhere, ChunkUnderWay& under_way) {
    const std::size_t before = elsewhere.size();
    elsewhere.erase(
        std::remove_if(elsewhere.begin(), elsewhere.end(),
                       [&](std::int64_t chunk) { return see_to(chunk, true, under_way); }),
        elsewhere.end());
    under_way.finish();
    if (elsewhere.size() == before) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    throw_if_interrupted();
  }

  /// Whether the chunk is done, here or elsewhere, or under way here.
  /// @param last  nobody comes to it any more
  bool see_to(std::int64_t chunk, bool last, ChunkUnderWay& under_way) {
    throw_if_interrupted();
    const bool done = is_done(chunk);
    const bool left = done && ChunkClaim::exists(store_.file_of(chunk));
    if (done && !left) return count_found(chunk);
    auto claim = std::make_unique<const ChunkClaim>(store_.file_of(chunk));
    if (claim->was_left()) store_.remove_leftovers(chunk);
    if (claim->answer() == ChunkClaim::Answer::elsewhere) return false;
    if (claim->answer() == ChunkClaim::Answer::unknown && !last) return false;
    // Its last holder may have finished it before it was ours.
    if (is_done(chunk)) return count_found(chunk);
    if (store_.has(chunk))
      tell(store_.file_of(chunk).string() +
           " or a file that belongs to it is damaged, and is computed anew");
    under_way.begin(
        [this, chunk, claim = std::move(claim), result = work_.compute(chunk)]() mutable {
          store_.put(chunk, result.values);
          claim.reset();  // the chunk is there
          ++seen_;
          progress_.advance(static_cast<std::uint64_t>(store_.grid().cells_of(chunk)),
                            static_cast<std::uint64_t>(result.samples));
        });
    return true;
  }

  bool is_done(std::int64_t chunk) const {
    return store_.has(chunk) && (!work_.verify || store_.read(chunk));
  }

  /// From any thread, also to the host, which the first one alone has.
  void tell(const std::string& warning) const {
    const std::lock_guard<std::mutex> one_at_a_time(telling_);
    std::optional<HostScope> here;
    if (host_ != nullptr) here.emplace(*host_);
    report_warning(warning, context_.quiet);
  }

  bool count_found(std::int64_t chunk) {
    ++seen_;
    if (work_.found) work_.found(chunk);
    progress_.skip(static_cast<std::uint64_t>(store_.grid().cells_of(chunk)));
    return true;
  }

  /// Shows the chunks handed out that were not seen here.
  void show_others() {
    if (group_.rank() != 0 || group_.size() == 1) return;
    const std::int64_t taken = std::min(group_.take_tickets(0), tickets_);
    const std::int64_t others = std::max(taken - seen_, std::int64_t{0});
    progress_.set_elsewhere(static_cast<std::uint64_t>(
        std::min(others * store_.grid().cells_of_file(), store_.grid().cells())));
  }

  const JobContext& context_;
  const StoreFolder& store_;
  ProcessGroup& group_;
  const ChunkWork& work_;
  JobHost* host_ = JobHost::current();
  mutable std::mutex telling_;
  std::int64_t tickets_;  // one a chunk of the part
  std::int64_t first_ticket_;
  Progress progress_;
  std::atomic<std::int64_t> seen_{0};  // chunks done or found here
};

}  // namespace

void fill_store(const JobContext& context, const StoreFolder& store, ProcessGroup& group,
                int threads, const ChunkWork& work) {
  StoreFilling(context, store, group, work).run(threads);
}

void report_kept_chunks(const StoreFolder& store, const std::string& how_to_go_on) noexcept {
  try {
    const std::int64_t kept = store.chunks_done();
    report_error(std::to_string(kept) + " of " + std::to_string(store.grid().chunks()) +
                 (kept == 1 ? " chunk is" : " chunks are") + " kept in " + store.folder().string() +
                 "; " + how_to_go_on);
  } catch (...) {
    // The fault that brought us here is the one to be told.
  }
}

void fill_store(const JobContext& context, const StoreDescription& description,
                const ChunkWork& work) {
  const std::unique_ptr<ProcessGroup> group = join_process_group();
  std::optional<StoreFolder> store;
  make_collective_call(*group, [&] {
    if (group->rank() == 0) store = StoreFolder::enter(*context.output, description);
  });
  make_collective_call(*group, [&] {
    if (!store) store = StoreFolder::enter(*context.output, description);
  });
  try {
    const int threads = worker_threads(context.threads, *group);
    make_collective_call(*group, [&] { fill_store(context, *store, *group, threads, work); });
  } catch (...) {
    if (group->rank() == 0) report_kept_chunks(*store, "repeat the same command to continue");
    throw;
  }
}

}  // namespace holdfast::program
