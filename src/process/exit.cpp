#include "process/exit.hpp"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <holdfast/core/errors.hpp>
#include <new>
#include <string_view>
#include <thread>

#include "host/job_host.hpp"
#include "process/errors.hpp"
#include "process/group/process_group.hpp"
#include "process/interrupt.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

/// Whether the first of the processes that a launcher started together tells of a wrong input that
/// all of them were given. The launcher ends the others when it has, and would end it too if one of
/// them exited before: hence they wait. Where nothing ends them the input is wrong here alone.
bool first_process_reports() {
  if (mpi_launch().rank == 0) return false;
  const auto patience_ends = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  while (!interrupted() && std::chrono::steady_clock::now() < patience_ends)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return interrupted();
}

/// Message of an exception; nothing where another process has told it.
std::string message_of(const std::exception_ptr& fault) {
  try {
    std::rethrow_exception(fault);
  } catch (const ReportedElsewhere&) {
    return "";
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

/// Says what there is to say of an exception that ends the program with that code.
void tell(const std::exception_ptr& fault, int code) {
  const std::string message = message_of(fault);
  const bool known = message.empty() || (code == exit_code::wrong_input && first_process_reports());
  if (!known) report_error(message);
}

/// For where there is no memory for the words either.
void tell_lack_of_memory() {
  constexpr std::string_view line = "holdfast: no memory is left\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
}

/// Ends where a library's destructor throws for want of memory, which comes here uncaught.
[[noreturn]] void end_without_memory() {
  try {
    if (const std::exception_ptr fault = std::current_exception()) std::rethrow_exception(fault);
  } catch (const std::bad_alloc&) {
    tell_lack_of_memory();
    remove_unfinished_files();
    _exit(exit_code::no_answer);
  } catch (...) {
    // A fault of the program, which ends as such.
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
  // Over the line of a job's progress, if one is shown.
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
  } catch (const ReportedElsewhere& reported) {
    return reported.exit_code();
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
    const int code = exit_code_of(fault);
    try {
      tell(fault, code);
    } catch (...) {
      tell_lack_of_memory();
    }
    return code;
  }
}

}  // namespace holdfast::program
