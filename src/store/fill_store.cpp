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

/// Number that is almost certainly different for any two processes.
std::uint64_t number_of_this_process() {
  const auto now = std::chrono::system_clock::now().time_since_epoch().count();
  return checksum(std::to_string(now) + "-" + std::to_string(getpid()));
}

/// A chunk that is written while the next is computed, so that a thread need not wait for the disk.
class ChunkUnderWay {
 public:
  /// Starts writing a chunk, after the previous one is written.
  template <class Keep>
  void begin(Keep&& keep) {
    finish();
    done_ = std::async(way, std::forward<Keep>(keep));
  }

  /// Waits for the chunk; throws the exception of its writing.
  void finish() {
    if (done_.valid()) done_.get();
  }

 private:
#ifdef __EMSCRIPTEN__  // a module has one thread
  static constexpr std::launch way = std::launch::deferred;
#else  // without a further thread it is written in finish()
  static constexpr std::launch way = std::launch::async | std::launch::deferred;
#endif

  std::future<void> done_;
};

/// The work of one process on a store.
class StoreFilling {
 public:
  StoreFilling(const JobContext& context, const StoreFolder& store, const ChunkWork& work)
      : context_(context),
        store_(store),
        work_(work),
        tickets_((store.grid().chunks() - work.part.number) / work.part.of + 1),
        first_ticket_(first_ticket()),
        progress_(static_cast<std::uint64_t>(store.grid().cells() / work.part.of), work.steps,
                  progress_wanted(context)) {}

  void run(int threads) {
    std::atomic<bool> stop{false};
    parallel_rows(threads, 1, threads, 0, [&](int&, std::int64_t, std::int64_t) {
      try {
        take_chunks(stop);
      } catch (...) {
        stop = true;
        throw;
      }
    });
  }

 private:
  /// Index of the first chunk, within the part, that this process takes: 0 for the first process, a
  /// random one for later processes, so that they rarely try the same chunk.
  std::int64_t first_ticket() const {
    if (!store_.has(chunk_of(0))) return 0;
    return static_cast<std::int64_t>(number_of_this_process() %
                                     static_cast<std::uint64_t>(tickets_));
  }

  std::int64_t chunk_of(std::int64_t ticket) const {
    return work_.part.number - 1 + ticket * work_.part.of;
  }

  /// Work of one thread: chunk after chunk, then the chunks that other processes have not finished.
  void take_chunks(const std::atomic<bool>& stop) {
    std::vector<std::int64_t> elsewhere;
    ChunkUnderWay under_way;
    while (!stop) {
      throw_if_interrupted();
      const std::int64_t ticket = taken_++;
      if (ticket >= tickets_) break;
      const std::int64_t chunk = chunk_of((first_ticket_ + ticket) % tickets_);
      if (!see_to(chunk, false, under_way)) elsewhere.push_back(chunk);
    }
    under_way.finish();  // others may wait for it
    while (!stop && !elsewhere.empty()) see_to_others(elsewhere, under_way);
  }

  /// Waits for the chunks of other processes, and computes those that they abandon.
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

  /// Computes a chunk unless it is done or claimed. True if it is done or being written here.
  /// @param last  whether no other process will take the chunk
  bool see_to(std::int64_t chunk, bool last, ChunkUnderWay& under_way) {
    throw_if_interrupted();
    const bool done = is_done(chunk);
    const bool left = done && ChunkClaim::exists(store_.file_of(chunk));
    if (done && !left) return count_found(chunk);
    auto claim = std::make_unique<const ChunkClaim>(store_.file_of(chunk));
    if (claim->was_left()) store_.remove_leftovers(chunk);
    if (claim->answer() == ChunkClaim::Answer::elsewhere) return false;
    if (claim->answer() == ChunkClaim::Answer::unknown && !last) return false;
    // Another process may have finished it before this claim.
    if (is_done(chunk)) return count_found(chunk);
    if (store_.has(chunk))
      tell(store_.file_of(chunk).string() +
           " or a file that belongs to it is damaged; this chunk is computed anew");
    under_way.begin(
        [this, chunk, claim = std::move(claim), result = work_.compute(chunk)]() mutable {
          store_.put(chunk, result.values);
          claim.reset();  // the chunk is written
          progress_.advance(static_cast<std::uint64_t>(store_.grid().cells_of(chunk)),
                            static_cast<std::uint64_t>(result.samples));
        });
    return true;
  }

  bool is_done(std::int64_t chunk) const {
    return store_.has(chunk) && (!work_.verify || store_.read(chunk));
  }

  /// Reports a warning from any thread, also to the host, which only the first thread has.
  void tell(const std::string& warning) const {
    const std::lock_guard<std::mutex> one_at_a_time(telling_);
    std::optional<HostScope> here;
    if (host_ != nullptr) here.emplace(*host_);
    report_warning(warning, context_.quiet);
  }

  bool count_found(std::int64_t chunk) {
    if (work_.found) work_.found(chunk);
    progress_.skip(static_cast<std::uint64_t>(store_.grid().cells_of(chunk)));
    return true;
  }

  const JobContext& context_;
  const StoreFolder& store_;
  const ChunkWork& work_;
  JobHost* host_ = JobHost::current();
  mutable std::mutex telling_;
  std::int64_t tickets_;  // number of chunks of the part
  std::int64_t first_ticket_;
  std::atomic<std::int64_t> taken_{0};
  Progress progress_;
};

}  // namespace

void fill_store(const JobContext& context, const StoreFolder& store, const ChunkWork& work) {
  StoreFilling(context, store, work).run(worker_threads(context.threads));
}

void report_kept_chunks(const StoreFolder& store, const std::string& how_to_go_on) noexcept {
  try {
    const std::int64_t kept = store.chunks_done();
    report_error(std::to_string(kept) + " of " + std::to_string(store.grid().chunks()) +
                 (kept == 1 ? " chunk is" : " chunks are") + " kept in " + store.folder().string() +
                 "; " + how_to_go_on);
  } catch (...) {
    // The original fault is the one to report.
  }
}

void fill_store(const JobContext& context, const StoreDescription& description,
                const ChunkWork& work) {
  const StoreFolder store = StoreFolder::enter(*context.output, description);
  try {
    fill_store(context, store, work);
  } catch (...) {
    report_kept_chunks(store, "repeat the same command to continue");
    throw;
  }
}

}  // namespace holdfast::program
