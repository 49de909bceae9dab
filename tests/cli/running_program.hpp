#pragma once

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "support/temporary_folder.hpp"

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

/// How a program ended, and what it took.
struct Ending {
  int exit_code;         ///< −1 where a signal ended it
  int ended_by_signal;   ///< 0 where none did
  long peak_memory_kib;  ///< largest resident memory
  std::string output;
  std::string errors;
};

/// The words of a command line that quotes nothing.
inline std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// The parts of a text between its bars: `a|b c||d` has four.
inline std::vector<std::string> between_bars(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char character : text)
    if (character == '|')
      parts.emplace_back();
    else
      parts.back() += character;
  return parts;
}

/// `holdfast WORDS` beside the test, without a shell between, so that a signal reaches the program
/// itself. It is killed when the object goes.
class RunningProgram {
 public:
  /// @param surroundings  commands of a shell that becomes the program: `ulimit -v 50000`
  explicit RunningProgram(const std::vector<std::string>& words,
                          const std::string& surroundings = "") {
    std::vector<std::string> command = {HOLDFAST_PROGRAM};
    if (!surroundings.empty())
      command = {"/bin/sh", "-c", surroundings + "\nexec \"$@\"", "sh", HOLDFAST_PROGRAM};
    command.insert(command.end(), words.begin(), words.end());
    std::vector<char*> arguments;
    for (std::string& word : command) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    redirect(files, STDIN_FILENO, "/dev/null");
    redirect(files, STDOUT_FILENO, output_);
    redirect(files, STDERR_FILENO, errors_);
    const int failure =
        posix_spawn(&process_, arguments[0], &files, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    if (failure != 0) throw std::runtime_error("cannot start " + command[0]);
  }
  ~RunningProgram() {
    if (ended_) return;
    send(SIGKILL);
    wait();
  }
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;
  RunningProgram(RunningProgram&&) = delete;
  RunningProgram& operator=(RunningProgram&&) = delete;

  /// Whether it still runs; one that has ended stays to be waited for.
  bool runs() const {
    siginfo_t change = {};
    waitid(P_PID, static_cast<id_t>(process_), &change, WEXITED | WNOHANG | WNOWAIT);
    return change.si_pid == 0;
  }

  void send(int signal_number) const { kill(process_, signal_number); }

  /// Until it computes: its handlers stand, of which the one for SIGALRM is the last (a shell that
  /// becomes the program may handle SIGINT itself, but no alarm), and it has used so much of a
  /// processor; or it has ended.
  void wait_until_it_computes(std::chrono::milliseconds used) const {
    const auto computes = [&] {
      return (status("SigCgt:", 16) >> (SIGALRM - 1) & 1U) != 0 && processor_time() >= used;
    };
    while (runs() && !computes()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  /// Largest resident memory so far, of the program alone; 0 once it has ended.
  std::size_t peak_memory_so_far_kib() const { return status("VmHWM:", 10); }

  /// Until it has ended, or so long; then it is killed.
  Ending wait_at_most(std::chrono::seconds patience = std::chrono::seconds(120)) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (runs() && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    if (runs()) send(SIGKILL);
    return wait();
  }

  /// Whether it ends within the time that it computes, or five times as much by the clock.
  bool ends_within(std::chrono::milliseconds time) const {
    const auto begin = std::chrono::steady_clock::now();
    const auto computed = processor_time();
    const auto is_up = [&] {
      const auto passed = std::chrono::steady_clock::now() - begin;
      return passed > 5 * time || (passed > time && processor_time() - computed > time);
    };
    while (runs() && !is_up()) std::this_thread::sleep_for(std::chrono::microseconds(500));
    return !runs();
  }

  Ending wait() {
    int status = 0;
    struct rusage used = {};
    wait4(process_, &status, 0, &used);
    ended_ = true;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1,
            WIFSIGNALED(status) ? WTERMSIG(status) : 0, used.ru_maxrss, read_text(output_),
            read_text(errors_)};
  }

 private:
  /// What the kernel tells of the process; 0 where it tells nothing any more.
  std::size_t status(const std::string& name, int base) const {
    std::istringstream lines(read_text("/proc/" + std::to_string(process_) + "/status"));
    for (std::string line; std::getline(lines, line);)
      if (line.rfind(name, 0) == 0) return std::stoull(line.substr(name.size()), nullptr, base);
    return 0;
  }

  /// That it has had, all of its threads together.
  std::chrono::nanoseconds processor_time() const {
    clockid_t clock = 0;
    struct timespec time = {};
    if (clock_getcpuclockid(process_, &clock) != 0 || clock_gettime(clock, &time) != 0) return {};
    return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
  }

  static void redirect(posix_spawn_file_actions_t& files, int descriptor, const std::string& path) {
    posix_spawn_file_actions_addopen(&files, descriptor, path.c_str(), O_RDWR | O_CREAT, 0600);
  }

  TemporaryFolder folder_;
  std::string output_ = (folder_ / "out").string();
  std::string errors_ = (folder_ / "err").string();
  pid_t process_ = 0;
  bool ended_ = false;
};

}  // namespace holdfast::tests
