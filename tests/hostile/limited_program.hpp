#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "support/temporary_folder.hpp"
#include "support/testing.hpp"

namespace holdfast::tests {

/// Whether the program is built with a sanitizer, which reserves terabytes and takes its time.
inline constexpr bool is_sanitized =
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
    true;
#else
    false;
#endif
#else
    false;
#endif

/// What a program that runs alone and for seconds may take. Where others have the processors, its
/// time is that which it computes, up to five times as much by the clock.
struct Limits {
  std::chrono::milliseconds patience{2000};    ///< until it is asked to stop
  std::chrono::milliseconds last_words{1000};  ///< from then until it is killed
  rlim_t processor_seconds = 5;
  rlim_t address_space = rlim_t{4} << 30U;
  rlim_t file_size = rlim_t{64} << 20U;
};

/// How a limited program ended.
struct LimitedEnding {
  int exit_code = -1;          ///< −1 where a signal ended it
  int ended_by_signal = 0;     ///< 0 where none did
  bool asked_to_stop = false;  ///< it was not done within the patience
  bool killed = false;         ///< nor did it stop when it was asked
  double seconds = 0.0;
  std::string output;  ///< its first thousand characters
  std::string errors;
};

/// `holdfast WORDS` in the folder `place/work`, with `place/tmp` for temporary files; what it
/// writes goes to `place/out` and `place/err`.
class LimitedProgram {
 public:
  LimitedProgram(const std::vector<std::string>& words, std::filesystem::path place,
                 const Limits& limits)
      : place_(std::move(place)), limits_(limits), start_(Clock::now()) {
    std::vector<std::string> command = {HOLDFAST_PROGRAM};
    command.insert(command.end(), words.begin(), words.end());
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (std::string& word : command) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    process_ = fork();
    if (process_ < 0) throw std::runtime_error("cannot start a process");
    if (process_ == 0) become(arguments.data());
  }
  ~LimitedProgram() {
    if (ended_) return;
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  LimitedProgram(const LimitedProgram&) = delete;
  LimitedProgram& operator=(const LimitedProgram&) = delete;
  LimitedProgram(LimitedProgram&&) = delete;
  LimitedProgram& operator=(LimitedProgram&&) = delete;

  LimitedEnding wait() {
    LimitedEnding ending;
    if (!ends_within(limits_.patience)) {
      ending.asked_to_stop = true;
      kill(process_, SIGINT);
      ending.killed = !ends_within(limits_.last_words);
      if (ending.killed) kill(process_, SIGKILL);
    }
    if (!ended_) waitpid(process_, &status_, 0);
    ended_ = true;
    ending.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    ending.exit_code = WIFEXITED(status_) ? WEXITSTATUS(status_) : -1;
    ending.ended_by_signal = WIFSIGNALED(status_) ? WTERMSIG(status_) : 0;
    ending.output = beginning_of(place_ / "out");
    ending.errors = read_text(place_ / "err");
    return ending;
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// In the child: the rest of its life. A file that grows too large is an error of write(), as on
  /// a full disk, rather than a signal.
  [[noreturn]] void become(char** arguments) const {
    limit(RLIMIT_CPU, limits_.processor_seconds);
    if (!is_sanitized) limit(RLIMIT_AS, limits_.address_space);
    limit(RLIMIT_FSIZE, limits_.file_size);
    limit(RLIMIT_CORE, 0);
    signal(SIGXFSZ, SIG_IGN);
    redirect(STDIN_FILENO, "/dev/null");
    redirect(STDOUT_FILENO, place_ / "out");
    redirect(STDERR_FILENO, place_ / "err");
    setenv("TMPDIR", (place_ / "tmp").c_str(), 1);
    if (chdir((place_ / "work").c_str()) == 0) execv(arguments[0], arguments);
    _exit(127);
  }

  static void limit(int resource, rlim_t most) {
    const struct rlimit both = {most, most};
    setrlimit(static_cast<__rlimit_resource>(resource), &both);
  }

  static void redirect(int descriptor, const std::filesystem::path& file) {
    const int opened = open(file.c_str(), O_RDWR | O_CREAT | O_TRUNC, 0600);
    dup2(opened, descriptor);
    close(opened);
  }

  bool ends_within(std::chrono::milliseconds time) {
    const auto begin = Clock::now();
    const auto computed = processor_time();
    const auto is_up = [&] {
      const auto passed = Clock::now() - begin;
      return passed > 5 * time || (passed > time && processor_time() - computed > time);
    };
    while (!ended_ && !is_up()) {
      ended_ = waitpid(process_, &status_, WNOHANG) == process_;
      if (!ended_) std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    return ended_;
  }

  /// That the process has had, all of its threads together.
  std::chrono::nanoseconds processor_time() const {
    clockid_t clock = 0;
    struct timespec time = {};
    const bool known =
        clock_getcpuclockid(process_, &clock) == 0 && clock_gettime(clock, &time) == 0;
    if (!known) return std::chrono::nanoseconds::zero();
    return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
  }

  static std::string beginning_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::string text(1000, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    return text;
  }

  std::filesystem::path place_;
  Limits limits_;
  Clock::time_point start_;
  pid_t process_ = 0;
  int status_ = 0;
  bool ended_ = false;
};

}  // namespace holdfast::tests
