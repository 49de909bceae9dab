#pragma once

#include <functional>
#include <string>
#include <vector>

namespace holdfast::program {

/// Does one command line of the program, without the program's name; throws what its job throws.
using CommandRunner = std::function<void(const std::vector<std::string>&)>;

/// A job's command line with the options that made the case before its own: job, case, the rest.
/// @param arguments  the job and its own options
std::vector<std::string> command_of(const std::vector<std::string>& arguments,
                                    const std::vector<std::string>& case_arguments);

/// The same of the program, as a shell reads it.
std::string shell_text(const std::vector<std::string>& arguments,
                       const std::vector<std::string>& case_arguments);

}  // namespace holdfast::program
