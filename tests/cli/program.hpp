#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstddef>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "io/text/csv.hpp"
#include "support/temporary_folder.hpp"

namespace holdfast::tests {

/// Whether the program was built with SUNDIALS and with Ceres Solver.
inline constexpr bool both_packages =
#if defined(HOLDFAST_HAS_SUNDIALS) && defined(HOLDFAST_HAS_CERES)
    true;
#else
    false;
#endif

/// What a command line of the program did.
struct Outcome {
  int exit_code;
  std::string output;
  std::string errors;

  std::size_t error_lines() const {
    std::size_t lines = 0;
    for (const char character : errors) lines += character == '\n' ? 1 : 0;
    return lines;
  }
};

/// Runs `holdfast ARGUMENTS` in a shell at `place`; `redirection` is put behind them.
inline Outcome run_holdfast(const std::string& arguments, const std::string& redirection = "",
                            const std::string& place = ".") {
  const TemporaryFolder folder;
  const std::string output = (folder / "out").string(), errors = (folder / "err").string();
  const std::string destination = redirection.empty() ? " >'" + output + "'" : " " + redirection;
  const std::string command = "cd '" + place + "' && '" + HOLDFAST_PROGRAM + "' " + arguments +
                              destination + " 2>'" + errors + "' </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(output), read_text(errors)};
}

/// The table that a command line writes, which has to do so without a word on standard error.
inline program::CsvTable table_of(const std::string& arguments) {
  const Outcome outcome = run_holdfast(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << arguments << '\n' << outcome.errors;
  EXPECT_EQ(outcome.errors, "") << arguments;
  return program::parse_csv(outcome.output, arguments);
}

/// The lines of a text, without their ends.
inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    lines.push_back(line);
  }
  return lines;
}

}  // namespace holdfast::tests
