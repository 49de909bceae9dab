#pragma once

#include <exception>
#include <functional>
#include <string>

namespace holdfast::program {

/// The program's exit codes.
namespace exit_code {
inline constexpr int done = 0;
inline constexpr int no_answer = 1;      ///< NoAnswer, OutputError or an unexpected exception
inline constexpr int wrong_input = 2;    ///< WrongInput or InvalidParameter
inline constexpr int interrupted = 130;  ///< ended by a signal
}  // namespace exit_code

/// Exit code of an exception: 2 for WrongInput and InvalidParameter, 130 for Interrupted, else 1.
int exit_code_of(const std::exception_ptr& fault);

/// Runs the program's work and returns its exit code. For an exception it writes one line that
/// begins with `holdfast: ` to standard error, and returns exit_code_of() it.
int run_guarded(const std::function<int()>& work);

/// Writes `holdfast: ` and the message as one line to standard error; with a JobHost, adds the
/// message to the host's warnings instead.
void report_error(const std::string& message);

/// Reports a warning with `warning: ` before it; nothing if the message is empty or `quiet`. A
/// JobHost gets every warning, also if `quiet`.
void report_warning(const std::string& message, bool quiet);

}  // namespace holdfast::program
