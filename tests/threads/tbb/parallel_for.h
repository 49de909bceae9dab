// What the library uses of oneTBB, with threads that the thread sanitizer sees: that of the system
// is not instrumented, and all that it hands from thread to thread would look unguarded. Only the
// preset tsan looks into this folder.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace tbb {

template <class Value>
class blocked_range {
 public:
  blocked_range(Value begin, Value end) : begin_(begin), end_(end) {}
  Value begin() const { return begin_; }
  Value end() const { return end_; }

 private:
  Value begin_, end_;
};

/// Threads of the arena that the calling thread is in.
inline int& threads_here() {
  thread_local int threads = 1;
  return threads;
}

class task_arena {
 public:
  static constexpr int automatic = -1;

  explicit task_arena(int threads) : threads_(threads > 0 ? threads : 4) {}

  template <class Work>
  void execute(const Work& work) {
    const int outside = threads_here();
    threads_here() = threads_;
    try {
      work();
    } catch (...) {
      threads_here() = outside;
      throw;
    }
    threads_here() = outside;
  }

 private:
  int threads_;
};

template <class Value, class Body>
void parallel_for(const blocked_range<Value>& range, const Body& body) {
  std::atomic<Value> next(range.begin());
  std::mutex guard;
  std::exception_ptr failure;
  const auto work = [&] {
    for (Value index = next++; index < range.end(); index = next++) {
      try {
        body(blocked_range<Value>(index, index + 1));
      } catch (...) {
        next = range.end();
        const std::lock_guard<std::mutex> lock(guard);
        if (!failure) failure = std::current_exception();
      }
    }
  };
  std::vector<std::thread> others;
  for (int k = 1; k < threads_here(); ++k) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace tbb
