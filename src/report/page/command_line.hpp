#pragma once

#include <string>
#include <vector>

namespace holdfast::program {

/// A job's command line with the options that made the case before its own: job, case, the rest.
/// @param arguments  the job and its own options
std::vector<std::string> command_of(const std::vector<std::string>& arguments,
                                    const std::vector<std::string>& case_arguments);

/// A command line of the program that a shell reads as these arguments.
std::string shell_text(const std::vector<std::string>& arguments);

/// The same of a job's command line and the case's options.
inline std::string shell_text(const std::vector<std::string>& arguments,
                              const std::vector<std::string>& case_arguments) {
  return shell_text(command_of(arguments, case_arguments));
}

}  // namespace holdfast::program
