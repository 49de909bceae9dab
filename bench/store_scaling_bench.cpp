// What a store that many processes fill needs of its file system. Processes that wait in place of
// computing fill one store, each its part of it, on a storage that takes only so many calls a
// second, all processes together, and answers each after a latency. Beside what they reach stands
// what a queue predicts for them, and then what it predicts for ten thousand processes.
//
//     store_scaling_bench [FOLDER [PROCESSES [LATENCY_S [CALLS_PER_S [CHUNK_S]]]]]
//
// The storage's calls are those of the system that name a file or wait for a disk: the program's
// own are caught here on their way.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <new>
#include <queue>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "case/case_file.hpp"
#include "process/exit.hpp"
#include "store/fill_store.hpp"
#include "store/stored_grid.hpp"

namespace {

using namespace holdfast::program;
namespace fs = std::filesystem;

struct Storage {
  double latency = 0.0;  // s, of a call
  double rate = 0.0;     // calls a second that it takes

  double service() const { return 1.0 / rate; }
};

std::int64_t nanoseconds() {
  return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
}

/// The storage that the processes share. Without a rate it only counts.
struct SharedStorage {
  Storage storage;
  std::atomic<std::int64_t> free_at{0};  // ns
  std::atomic<std::int64_t> calls{0};

  void take_call() {
    ++calls;
    if (!(storage.rate > 0.0)) return;
    const auto service = static_cast<std::int64_t>(1e9 * storage.service());
    const auto latency = static_cast<std::int64_t>(1e9 * storage.latency);
    std::int64_t last = free_at;
    std::int64_t done = 0;
    do {
      done = std::max(last, nanoseconds()) + service;
    } while (!free_at.compare_exchange_weak(last, done));
    std::this_thread::sleep_for(std::chrono::nanoseconds(done + latency - nanoseconds()));
  }
};

SharedStorage* shared_storage = nullptr;  // nothing: the system's
thread_local std::int64_t calls_here = 0;

void call_storage() {
  if (shared_storage == nullptr) return;
  ++calls_here;
  shared_storage->take_call();
}

template <class... Arguments>
int passed_on(long number, Arguments... arguments) {
  call_storage();
  return static_cast<int>(syscall(number, arguments...));
}

}  // namespace

// In place of the C library's.
extern "C" {
int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  return passed_on(SYS_openat, AT_FDCWD, path, flags, mode);
}
int rename(const char* from, const char* to) noexcept {
  return passed_on(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0);
}
int unlink(const char* path) noexcept { return passed_on(SYS_unlinkat, AT_FDCWD, path, 0); }
int fsync(int file) { return passed_on(SYS_fsync, file); }
int flock(int file, int operation) noexcept { return passed_on(SYS_flock, file, operation); }
int stat(const char* path, struct stat* found) noexcept {
  call_storage();
  return fstatat(AT_FDCWD, path, found, 0);
}
int lstat(const char* path, struct stat* found) noexcept {
  call_storage();
  return fstatat(AT_FDCWD, path, found, AT_SYMLINK_NOFOLLOW);
}
}

namespace {

constexpr int chunks_of_each = 8;

/// Calls of a chunk: those before it is computed, one after the other, and those that keep it,
/// while the next one is computed.
struct ChunkCalls {
  int before = 0;
  int after = 0;
};

StoreDescription description_of(std::int64_t chunks) {
  JobContext context;
  context.job = "sweep";
  context.case_data = load_case(std::nullopt, {});
  const GridLayout layout{{{{"backlash.width", "m", ""}, holdfast::Axis{0.0, 0.003, chunks}},
                           {{"initial.z1", "m", ""}, holdfast::Axis{0.0, 1.0, 1}}},
                          {{{"steady_peak", "N.s/m", ""}, {}},
                           {{"reversals_per_s", "Hz", ""}, {}},
                           {{"engaged_fraction", "", ""}, {}},
                           {{"outcome", "", "", "string"}, {"computed"}}}};
  return store_description(context, layout, 1);
}

/// One of the processes: its part of the store, a wait in place of each computation.
void fill_part(const StoreFolder& store, StorePart part, double chunk_seconds) {
  const auto compute = [&](std::int64_t) {
    std::this_thread::sleep_for(std::chrono::duration<double>(chunk_seconds));
    return ChunkResult{{{0.1}, {2.0}, {0.5}, {0.0}}, 1};
  };
  JobContext context;
  context.quiet = true;
  context.threads = 1;
  fill_store(context, store, {"sweep, cells", compute, nullptr, false, part});
}

ChunkCalls calls_of_chunk(const fs::path& folder) {
  const StoreFolder store = StoreFolder::enter(folder, description_of(chunks_of_each));
  calls_here = shared_storage->calls = 0;
  fill_part(store, {}, 0.001);
  const std::int64_t before = calls_here, all = shared_storage->calls;
  store.remove();
  return {static_cast<int>(before / chunks_of_each),
          static_cast<int>((all - before) / chunks_of_each)};
}

/// The share of the processes' time in which they compute; 0 where one failed.
double measured_share(const fs::path& folder, Storage storage, int processes,
                      double chunk_seconds) {
  shared_storage->storage.rate = 0.0;  // to describe the store is no part of filling it
  const StoreFolder store = StoreFolder::enter(folder, description_of(processes * chunks_of_each));
  shared_storage->storage = storage;
  const std::int64_t start = nanoseconds();
  for (int process = 0; process < processes; ++process)
    if (fork() == 0)
      _exit(run_guarded([&] {
        fill_part(store, {process + 1, processes}, chunk_seconds);
        return exit_code::done;
      }));
  bool whole = true;
  for (int status = 0; wait(&status) > 0;) whole = whole && status == 0;
  const double seconds = 1e-9 * static_cast<double>(nanoseconds() - start);
  shared_storage->storage.rate = 0.0;
  whole = whole && store.chunks_done() == store.grid().chunks();
  store.remove();
  return whole ? chunks_of_each * chunk_seconds / seconds : 0.0;
}

/// The same processes as a queue before one server.
class QueueOfProcesses {
 public:
  QueueOfProcesses(Storage storage, ChunkCalls calls, int processes, double chunk_seconds)
      : storage_(storage),
        calls_(calls),
        chunk_seconds_(chunk_seconds),
        processes_(static_cast<std::size_t>(processes)) {}

  double share() {
    for (std::size_t process = 0; process < processes_.size(); ++process)
      events_.push({0.0, process, Step::look, calls_.before});
    double end = 0.0;
    while (!events_.empty()) {
      const Event event = events_.top();
      events_.pop();
      end = std::max(end, event.time);
      follow(event);
    }
    return chunks_of_each * chunk_seconds_ / end;
  }

 private:
  enum class Step { look, compute, keep };

  struct Event {
    double time;
    std::size_t process;
    Step step;
    int calls;  // that are left of the step

    friend bool operator<(const Event& one, const Event& other) { return one.time > other.time; }
  };

  struct Process {
    int left = chunks_of_each;
    bool keeps = false;
    bool waits = false;  // with a chunk for the last one to be kept
  };

  void follow(const Event& event) {
    Process& process = processes_[event.process];
    if (event.calls > 0) {
      free_at_ = std::max(free_at_, event.time) + storage_.service();
      events_.push({free_at_ + storage_.latency, event.process, event.step, event.calls - 1});
    } else if (event.step == Step::look) {
      events_.push({event.time + chunk_seconds_, event.process, Step::compute, 0});
    } else if (event.step == Step::compute) {
      process.waits = process.keeps;
      if (!process.keeps) go_on(event);
    } else {
      process.keeps = false;
      if (process.waits) go_on(event);
    }
  }

  /// Keeps what is computed and comes to the next chunk.
  void go_on(const Event& event) {
    Process& process = processes_[event.process];
    process.waits = false;
    process.keeps = true;
    events_.push({event.time, event.process, Step::keep, calls_.after});
    if (--process.left > 0) events_.push({event.time, event.process, Step::look, calls_.before});
  }

  Storage storage_;
  ChunkCalls calls_;
  double chunk_seconds_;
  double free_at_ = 0.0;
  std::vector<Process> processes_;
  std::priority_queue<Event> events_;
};

void print_ten_thousand(Storage storage, ChunkCalls calls) {
  std::printf("10000 processes, predicted:\n");
  for (const double seconds : {1.0, 3.0, 10.0, 30.0, 100.0, 300.0})
    std::printf("  %5g s a chunk: %.3f of their time computing\n", seconds,
                QueueOfProcesses(storage, calls, 10000, seconds).share());
}

void compare(const fs::path& folder, int processes, Storage storage, double chunk_seconds) {
  void* memory = mmap(nullptr, sizeof(SharedStorage), PROT_READ | PROT_WRITE,
                      MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  shared_storage = new (memory) SharedStorage;
  const ChunkCalls calls = calls_of_chunk(folder);
  std::printf("calls of a chunk of 4 columns: %d before it is computed, %d to keep it\n",
              calls.before, calls.after);
  std::printf("storage: %g s a call, %g calls/s; %d processes, %g s a chunk\n", storage.latency,
              storage.rate, processes, chunk_seconds);
  std::printf("  measured   %.3f of their time computing\n",
              measured_share(folder, storage, processes, chunk_seconds));
  std::printf("  predicted  %.3f\n",
              QueueOfProcesses(storage, calls, processes, chunk_seconds).share());
  print_ten_thousand(storage, calls);
}

}  // namespace

int main(int count, char** words) {
  return run_guarded([&] {
    const auto word = [&](int place, const char* usual) {
      return std::string(count > place ? words[place] : usual);
    };
    compare(fs::path(word(1, ".")) / "store_scaling_bench.zarr", std::stoi(word(2, "64")),
            {std::stod(word(3, "0.002")), std::stod(word(4, "1000"))}, std::stod(word(5, "1")));
    return exit_code::done;
  });
}
