#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace holdfast::program {

/// Completion of the program's command lines for a shell, from the same options as `--help`: jobs,
/// their options, the words that an option takes, the keys of a case, names of files.
std::string bash_completion(const CLI::App& program);
std::string zsh_completion(const CLI::App& program);

}  // namespace holdfast::program
