#include "process/exit.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <holdfast/core/errors.hpp>
#include <new>
#include <string_view>

#include "host/job_host.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

std::string message_of(const std::exception_ptr& fault) {
  try {
    std::rethrow_exception(fault);
  } catch (const Interrupted& stopped) {
    return stopped.what();
  } catch (const Refusal& refusal) {
    return refusal.what();
  } catch (const InvalidParameter& error) {
    return error.what();
  } catch (const std::bad_alloc&) {
    return "the computation needs more memory than there is";
  } catch (const std::exception& error) {
    return std::string("unexpected failure: ") + error.what();
  } catch (...) {
    return "unexpected failure";
  }
}

/// Reports lack of memory, without allocating any.
void tell_lack_of_memory() {
  constexpr std::string_view line = "holdfast: no memory is left\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
}

/// Terminate handler, for a library's destructor that throws std::bad_alloc.
[[noreturn]] void end_without_memory() {
  try {
    if (const std::exception_ptr fault = std::current_exception()) std::rethrow_exception(fault);
  } catch (const std::bad_alloc&) {
    tell_lack_of_memory();
    remove_unfinished_files();
    _exit(exit_code::no_answer);
  } catch (...) {
    // Any other exception is a fault of the program.
  }
  std::abort();
}

}  // namespace

void report_error(const std::string& message) {
  if (JobHost* host = JobHost::current()) {
    host->warnings.push_back(one_line(message));
    return;
  }
  constexpr std::size_t longest = 1500;
  // Overwrites the progress line of a job, if one is shown.
  const std::string begin = isatty(STDERR_FILENO) == 1 ? "\r\033[K" : "";
  const std::string line = begin + "holdfast: " + shortened(one_line(message), longest) + "\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
  std::fflush(stderr);
}

void report_warning(const std::string& message, bool quiet) {
  if (message.empty()) return;
  if (JobHost::current() != nullptr)
    report_error(message);
  else if (!quiet)
    report_error("warning: " + message);
}

int exit_code_of(const std::exception_ptr& fault) {
  try {
    std::rethrow_exception(fault);
  } catch (const Interrupted&) {
    return exit_code::interrupted;
  } catch (const WrongInput&) {
    return exit_code::wrong_input;
  } catch (const InvalidParameter&) {
    return exit_code::wrong_input;
  } catch (...) {
    return exit_code::no_answer;
  }
}

int run_guarded(const std::function<int()>& work) {
  install_signal_handlers();
  std::set_terminate(end_without_memory);
  try {
    return work();
  } catch (...) {
    const std::exception_ptr fault = std::current_exception();
    try {
      report_error(message_of(fault));
    } catch (...) {
      tell_lack_of_memory();
    }
    return exit_code_of(fault);
  }
}

}  // namespace holdfast::program
