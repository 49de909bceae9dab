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

/// Whether progress is to be shown: never when quiet, else when asked for or on a terminal.
bool progress_wanted(bool quiet, bool asked_for);

/// How far a job is.
struct ProgressCount {
  std::uint64_t done = 0;  // steps, those skipped counted
  std::uint64_t total = 0;
  std::uint64_t skipped = 0;  // done before: they say nothing of the rate
  double samples = 0.0;       // taken by motions; 0: the job does not say
};

/// Shows on standard error that a job is at work, from a second after its begin on: its name and
/// the time, or where it counts its steps what its Progress says. On a terminal every second;
/// elsewhere a line after 1, 2, 4, … s. Ends with the object, or when the result goes to the same
/// terminal.
class Ticking {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param first  when the first line is due
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

/// To be called before results are written to standard output: where that is the terminal which
/// shows progress, nothing of the kind is shown any more.
void yield_terminal_to_result();

/// Shows on standard error how much of a job is done, its rate and the time that remains; at most
/// ten times a second. On a terminal one line is drawn over and cleared at the end; elsewhere each
/// is a line of its own, and the last says the total.
class Progress {
 public:
  /// @param label  of the job, and after a comma what its steps are: "stability", "sweep, cells"
  Progress(std::uint64_t total, std::string label, bool enabled);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Counts steps done. May be called from many threads.
  void advance(std::uint64_t steps = 1, std::uint64_t samples = 0);
  /// Counts steps that were done by an earlier run.
  void skip(std::uint64_t steps);

 private:
  using Clock = std::chrono::steady_clock;
  friend class Ticking;

  std::string status() const;

  std::uint64_t total_;
  std::string label_;
  JobHost* host_;  // that gets the count, if there is one
  bool enabled_;
  bool on_terminal_;
  Clock::time_point start_;
  std::atomic<std::uint64_t> done_{0};
  std::atomic<std::uint64_t> skipped_{0};
  std::atomic<std::uint64_t> samples_{0};
  std::atomic<std::int64_t> next_draw_{0};  // ms after start
};

/// The line that Progress shows: `stability: 40/100, 12.5/s, 5 s left`, or where the steps have a
/// name `sweep: 40/100 cells, 12.5 cells/s, 1.2e+08 samples/s, 5 s left`.
std::string progress_text(const std::string& label, const ProgressCount& count, double seconds);

}  // namespace holdfast::program
