#include "process/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <system_error>
#include <utility>

#include "host/job_host.hpp"

namespace holdfast::program {
namespace {

constexpr std::int64_t milliseconds_between_updates = 100;
constexpr const char* clear_line = "\r\033[K";

/// Lock of standard error, for one line at a time.
std::mutex showing;
const Progress* counting = nullptr;  // the job's, or null; guarded by `showing`
std::atomic<bool> yielded{false};    // whether the terminal is left to the result
std::atomic<bool> ticks{false};      // whether a Ticking is active; further ones show nothing

bool standard_error_is_terminal() { return isatty(STDERR_FILENO) == 1; }

std::string whole_or_tenth(double value) {
  std::array<char, 32> digits{};
  std::snprintf(digits.data(), digits.size(), value < 10.0 ? "%.1f" : "%.4g", value);
  return digits.data();
}

std::string duration_text(double seconds) {
  if (seconds < 60.0) return whole_or_tenth(seconds) + " s";
  if (seconds < 3600.0) return whole_or_tenth(seconds / 60.0) + " min";
  return whole_or_tenth(seconds / 3600.0) + " h";
}

void show(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

/// Shows the progress of a job; the caller has locked `showing`.
void show_status(const std::string& status) {
  if (!yielded) show(standard_error_is_terminal() ? clear_line + status : status + "\n");
}

}  // namespace

bool progress_wanted(bool quiet, bool asked_for) {
  if (JobHost::current() != nullptr) return false;
  return !quiet && (asked_for || standard_error_is_terminal());
}

std::string progress_text(const std::string& label, const ProgressCount& count, double seconds) {
  const std::size_t comma = label.find(", ");
  const std::string steps = comma == std::string::npos ? "" : " " + label.substr(comma + 2);
  std::string text = label.substr(0, comma) + ": " + std::to_string(count.done) + "/" +
                     std::to_string(count.total) + steps;
  if (count.done == count.skipped || !(seconds > 0.0)) return text;
  const double rate = static_cast<double>(count.done - count.skipped) / seconds;
  text += ", " + whole_or_tenth(rate) + steps + "/s";
  if (count.samples > 0.0) text += ", " + whole_or_tenth(count.samples / seconds) + " samples/s";
  if (count.done >= count.total) return text + ", " + duration_text(seconds);
  const double left = static_cast<double>(count.total - count.done) / rate;
  return text + ", " + duration_text(left) + " left";
}

Ticking::Ticking(std::string job, bool enabled, std::chrono::milliseconds first)
    : job_(std::move(job)) {
  if (!enabled || ticks.exchange(true)) return;
  try {
    thread_ = std::thread([this, first] { run(first); });
  } catch (const std::system_error&) {
    ticks = false;  // no thread is available: the job shows nothing
  }
}

Ticking::~Ticking() {
  {
    const std::lock_guard<std::mutex> lock(ending_);
    ended_ = true;
  }
  end_.notify_all();
  if (!thread_.joinable()) return;
  thread_.join();
  ticks = false;
}

void Ticking::run(std::chrono::milliseconds first) {
  const bool on_terminal = standard_error_is_terminal();
  bool shown = false;
  std::unique_lock<std::mutex> lock(ending_);
  for (auto pause = first; !end_.wait_for(lock, pause, [this] { return ended_; });) {
    const std::lock_guard<std::mutex> line(showing);
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    show_status(counting != nullptr ? counting->status() : job_ + ": " + duration_text(seconds));
    shown = true;
    if (!on_terminal) pause *= 2;
  }
  if (shown && on_terminal && !yielded) show(clear_line);
}

void yield_terminal_to_result() {
  if (yielded || !standard_error_is_terminal() || isatty(STDOUT_FILENO) != 1) return;
  const std::lock_guard<std::mutex> lock(showing);
  if (!yielded.exchange(true)) show(clear_line);
}

Progress::Progress(std::uint64_t total, std::string label, bool enabled)
    : total_(total),
      label_(std::move(label)),
      host_(JobHost::current()),
      enabled_(enabled && host_ == nullptr),
      on_terminal_(standard_error_is_terminal()),
      start_(Clock::now()) {
  if (host_ != nullptr) host_->steps = total_;
  if (!enabled_) return;
  const std::lock_guard<std::mutex> lock(showing);
  counting = this;
}

Progress::~Progress() {
  if (!enabled_) return;
  const std::lock_guard<std::mutex> lock(showing);
  if (counting == this) counting = nullptr;
  if (!yielded) show(on_terminal_ ? std::string(clear_line) : status() + "\n");
}

void Progress::skip(std::uint64_t steps) { skipped_ += steps; }

void Progress::advance(std::uint64_t steps, std::uint64_t samples) {
  done_ += steps;
  samples_ += samples;
  if (host_ != nullptr) host_->steps_done += steps;
  if (!enabled_) return;
  const auto now = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - start_);
  std::int64_t due = next_draw_.load();
  if (now.count() < due) return;
  // Only one of the threads that arrive at the same time draws.
  if (!next_draw_.compare_exchange_strong(due, now.count() + milliseconds_between_updates)) return;
  const std::lock_guard<std::mutex> lock(showing);
  show_status(status());
}

std::string Progress::status() const {
  const std::uint64_t skipped = skipped_;
  const ProgressCount count{std::min(skipped + done_, total_), total_, skipped,
                            static_cast<double>(samples_.load())};
  return progress_text(label_, count, std::chrono::duration<double>(Clock::now() - start_).count());
}

}  // namespace holdfast::program
