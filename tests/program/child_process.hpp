#pragma once

#include <sys/wait.h>
#include <unistd.h>
#include "support/testing.hpp"

namespace holdfast::tests {

/// Runs the work, which gives an exit code, in a child process; gives that code, 99 where the work
/// threw, and minus the signal's number where one ended the child.
template <typename Work>
int exit_code_of_child(const Work& work) {
  const pid_t child = fork();
  if (child == 0) {
    try {
      _exit(work());
    } catch (const std::exception&) {
      _exit(99);
    }
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace holdfast::tests
