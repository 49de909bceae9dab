#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>

#include "job.hpp"

namespace {

/// Restarts the program without OpenBLAS threads where the address space is limited. These threads
/// retry until they get memory, and fork() and exit() would wait for them forever.
void begin_without_threads_of_blas(char** arguments) {
  struct rlimit most {};
  const bool limited = getrlimit(RLIMIT_AS, &most) == 0 && most.rlim_cur != RLIM_INFINITY;
  if (!limited || std::getenv("OPENBLAS_NUM_THREADS") != nullptr) return;
  if (setenv("OPENBLAS_NUM_THREADS", "1", 0) == 0) execv("/proc/self/exe", arguments);
}

}  // namespace

int main(int argument_count, char** arguments) {
  begin_without_threads_of_blas(arguments);
  holdfast::program::install_signal_handlers();
  return holdfast::program::run_program(argument_count, arguments);
}
