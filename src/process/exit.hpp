#pragma once

#include <exception>
#include <functional>
#include <string>

namespace holdfast::program {

/// The program's exit codes.
namespace exit_code {
inline constexpr int done = 0;
inline constexpr int no_answer = 1;
inline constexpr int wrong_input = 2;
inline constexpr int interrupted = 130;
}  // namespace exit_code

/// The code of an exception: WrongInput, holdfast::InvalidParameter 2; Interrupted 130; anything
/// else 1.
int exit_code_of(const std::exception_ptr& fault);

/// Runs the program's work and gives its exit code. An exception becomes one line on standard
/// error that begins with `holdfast: `, and its exit_code_of().
int run_guarded(const std::function<int()>& work);

/// Writes `holdfast: ` and the message on one line of standard error; the host of a job gets it as
/// a warning.
void report_error(const std::string& message);

/// Reports with `warning: ` before it; nothing when there is none or it is not wanted. A host gets
/// every one: it has its own way of not wanting them.
void report_warning(const std::string& message, bool quiet);

}  // namespace holdfast::program
