#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

namespace holdfast::program {

struct JobHost;

/// Whether to show progress: never with `quiet` or a JobHost; else if asked for, or on a terminal.
bool progress_wanted(bool quiet, bool asked_for);

/// Counted steps of a job.
struct ProgressCount {
  std::uint64_t done = 0;  // steps done, skipped ones included
  std::uint64_t total = 0;
  std::uint64_t skipped = 0;  // steps done by an earlier run, not part of the rate
  double samples = 0.0;       // samples taken by motions; 0: not counted
};

/// Display on standard error that a job is running, from one second after its start: its name and
/// the elapsed time, or the status of its Progress. On a terminal the line is renewed every second;
/// elsewhere a line appears after 1 s, then after pauses of 2, 4, 8, … s. The display ends with the
/// object, or when the result goes to the terminal.
class Ticking {
 public:
  using Clock = std::chrono::steady_clock;

  /// Begins the display. @param first  time until the first line
  Ticking(std::string job, bool enabled, std::chrono::milliseconds first = std::chrono::seconds(1));
  ~Ticking();
  Ticking(const Ticking&) = delete;
  Ticking& operator=(const Ticking&) = delete;

 private:
  void run(std::chrono::milliseconds first);

  std::string job_;
  Clock::time_point start_ = Clock::now();
  bool ended_ = false;
  std::mutex ending_;
  std::condition_variable end_;
  std::thread thread_;
};

/// Ends the display of progress, if standard output and standard error are a terminal. Call before
/// results are written to standard output.
void yield_terminal_to_result();

/// Display on standard error of the steps done in a job, their rate and the remaining time, at most
/// ten times a second. On a terminal one line is overwritten, and cleared at the end; elsewhere
/// each status is a new line, and the last line gives the total.
class Progress {
 public:
  /// Begins the count. @param label  job and, after a comma, steps: "stability", "sweep, cells"
  Progress(std::uint64_t total, std::string label, bool enabled);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Counts steps done, and samples taken in them. May be called from several threads.
  void advance(std::uint64_t steps = 1, std::uint64_t samples = 0);
  /// Counts steps that an earlier run has done.
  void skip(std::uint64_t steps);

 private:
  using Clock = std::chrono::steady_clock;
  friend class Ticking;

  std::string status() const;

  std::uint64_t total_;
  std::string label_;
  JobHost* host_;  // gets the count; null: none
  bool enabled_;
  bool on_terminal_;
  Clock::time_point start_;
  std::atomic<std::uint64_t> done_{0};
  std::atomic<std::uint64_t> skipped_{0};
  std::atomic<std::uint64_t> samples_{0};
  std::atomic<std::int64_t> next_draw_{0};  // ms after start
};

/// The status line of Progress: `stability: 40/100, 12.5/s, 5 s left`, or with named steps `sweep:
/// 40/100 cells, 12.5 cells/s, 1.2e+08 samples/s, 5 s left`.
std::string progress_text(const std::string& label, const ProgressCount& count, double seconds);

}  // namespace holdfast::program
