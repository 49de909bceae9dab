#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace holdfast::program {

/// The manual page of the program (roff, section 1), from the same options and case keys as
/// `--help` and the case file.
std::string manual_page(const CLI::App& program, const std::string& examples);

}  // namespace holdfast::program
