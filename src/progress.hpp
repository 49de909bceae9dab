#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

#include "job_context.hpp"

namespace holdfast::program {

/// Whether progress is to be shown: never when quiet, else when asked for or on a terminal.
bool progress_wanted(const JobContext& context);

/// Shows on standard error how much of a job is done, its rate and the time that remains; at most
/// ten times a second. On a terminal one line is drawn over and cleared at the end; elsewhere each
/// is a line of its own, and the last says the total.
class Progress {
 public:
  Progress(std::uint64_t total, std::string label, bool enabled);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  Progress(Progress&&) = delete;
  Progress& operator=(Progress&&) = delete;

  /// Counts steps done. May be called from many threads.
  void advance(std::uint64_t steps = 1);

 private:
  using Clock = std::chrono::steady_clock;

  void draw(std::uint64_t done);
  double seconds_since_start() const;
  std::string status(std::uint64_t done) const;

  std::uint64_t total_;
  std::string label_;
  bool enabled_;
  bool on_terminal_;
  Clock::time_point start_;
  std::atomic<std::uint64_t> done_{0};
  std::atomic<std::int64_t> next_draw_{0};  // ms after start
  std::mutex drawing_;
};

/// The line that Progress shows: `label: 40/100, 12.5/s, 5 s left`.
std::string progress_text(const std::string& label, std::uint64_t done, std::uint64_t total,
                          double seconds);

}  // namespace holdfast::program
