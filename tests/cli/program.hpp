#pragma once

#include <sys/wait.h>

#include "io/text/csv.hpp"
#include "support/temporary_folder.hpp"
#include "support/testing.hpp"

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

/// Refused: the exit code, one line that begins with the program's name, nothing on standard
/// output.
inline void expect_refused(const std::string& arguments, const std::vector<std::string>& mentioned,
                           int exit_code = 2, const std::string& place = ".") {
  const Outcome outcome = run_holdfast(arguments, "", place);
  EXPECT_EQ(outcome.exit_code, exit_code) << arguments;
  EXPECT_EQ(outcome.error_lines(), 1U) << arguments << "\n" << outcome.errors;
  EXPECT_EQ(outcome.errors.rfind("holdfast: ", 0), 0U) << outcome.errors;
  EXPECT_EQ(outcome.output, "") << arguments;
  for (const std::string& part : mentioned)
    EXPECT_NE(outcome.errors.find(part), std::string::npos) << part << " in " << outcome.errors;
}

inline void expect_holds(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nis not in\n" << text;
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

/// The first line that a command line writes, which has to go well.
inline std::string header_of(const std::string& arguments) {
  const Outcome outcome = run_holdfast(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << arguments << outcome.errors;
  return outcome.output.substr(0, outcome.output.find_first_of("\r\n"));
}

/// The table that a command line writes, which has to do so without a word on standard error.
inline program::CsvTable table_of(const std::string& arguments) {
  const Outcome outcome = run_holdfast(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << arguments << '\n' << outcome.errors;
  EXPECT_EQ(outcome.errors, "") << arguments;
  return program::parse_csv(outcome.output, arguments);
}

/// What a command prints that succeeds without a word of errors.
inline std::string printed_by(const std::string& arguments) {
  const Outcome outcome = run_holdfast(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << arguments << '\n' << outcome.errors;
  return outcome.output;
}

}  // namespace holdfast::tests
