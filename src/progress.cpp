#include "progress.hpp"

#include <unistd.h>

#include <array>
#include <cstdio>
#include <utility>

namespace holdfast::program {
namespace {

constexpr std::int64_t milliseconds_between_updates = 100;
constexpr const char* clear_line = "\r\033[K";

bool standard_error_is_terminal() { return isatty(STDERR_FILENO) == 1; }

std::string rounded(double value) {
  std::array<char, 32> digits{};
  std::snprintf(digits.data(), digits.size(), value < 10.0 ? "%.1f" : "%.4g", value);
  return digits.data();
}

std::string duration_text(double seconds) {
  if (seconds < 60.0) return rounded(seconds) + " s";
  if (seconds < 3600.0) return rounded(seconds / 60.0) + " min";
  return rounded(seconds / 3600.0) + " h";
}

void show(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

bool progress_wanted(const JobContext& context) {
  return !context.quiet && (context.progress || standard_error_is_terminal());
}

std::string progress_text(const std::string& label, std::uint64_t done, std::uint64_t total,
                          double seconds) {
  std::string text = label + ": " + std::to_string(done) + "/" + std::to_string(total);
  if (done == 0 || !(seconds > 0.0)) return text;
  const double rate = static_cast<double>(done) / seconds;
  text += ", " + rounded(rate) + "/s";
  if (done >= total) return text + ", " + duration_text(seconds);
  return text + ", " + duration_text(static_cast<double>(total - done) / rate) + " left";
}

Progress::Progress(std::uint64_t total, std::string label, bool enabled)
    : total_(total),
      label_(std::move(label)),
      enabled_(enabled),
      on_terminal_(standard_error_is_terminal()),
      start_(Clock::now()) {}

Progress::~Progress() {
  if (!enabled_) return;
  show(on_terminal_ ? std::string(clear_line) : status(done_.load()) + "\n");
}

void Progress::advance(std::uint64_t steps) {
  const std::uint64_t done = done_.fetch_add(steps) + steps;
  if (!enabled_) return;
  const auto now = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - start_);
  std::int64_t due = next_draw_.load();
  if (now.count() < due) return;
  // Of the threads that come here at once, one draws.
  if (!next_draw_.compare_exchange_strong(due, now.count() + milliseconds_between_updates)) return;
  draw(done);
}

void Progress::draw(std::uint64_t done) {
  const std::lock_guard<std::mutex> lock(drawing_);
  show(on_terminal_ ? clear_line + status(done) : status(done) + "\n");
}

double Progress::seconds_since_start() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

std::string Progress::status(std::uint64_t done) const {
  return progress_text(label_, done, total_, seconds_since_start());
}

}  // namespace holdfast::program
