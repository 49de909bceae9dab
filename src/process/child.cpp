#include "process/child.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>

namespace holdfast::program {
namespace {

constexpr int none = -1000;

[[noreturn]] void end_with(const std::function<int()>& work) {
  int code = 255;
  try {
    code = work();
  } catch (...) {
    // The exit code is enough; the message belongs to the parent.
  }
  _exit(code);
}

}  // namespace

int run_in_child(const std::function<int()>& work) {
  const pid_t child = fork();
  if (child < 0) return none;
  if (child == 0) end_with(work);
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return none;
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace holdfast::program
