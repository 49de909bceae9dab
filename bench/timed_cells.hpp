#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <thread>
#include <vector>

namespace holdfast {

/// Calls job(cell) for all cells on some threads. @return seconds
template <class Job>
double timed_cells(std::size_t count, unsigned threads, const Job& job) {
  const auto begin = std::chrono::steady_clock::now();
  std::atomic<std::size_t> next{0};
  std::vector<std::thread> pool;
  for (unsigned k = 0; k < threads; ++k)
    pool.emplace_back([&] {
      for (std::size_t cell; (cell = next++) < count;) job(cell);
    });
  for (std::thread& thread : pool) thread.join();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace holdfast
