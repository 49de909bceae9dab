#pragma once

#include <sys/wait.h>

#include "io/text/csv.hpp"
#include "support/temporary_folder.hpp"
#include "text/text.hpp"

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
                            const std::string& place = ".",
                            const std::string& program = HOLDFAST_PROGRAM) {
  const TemporaryFolder folder;
  const std::string output = (folder / "out").string(), errors = (folder / "err").string();
  const std::string destination = redirection.empty() ? " >'" + output + "'" : " " + redirection;
  const std::string command = "cd '" + place + "' && '" + program + "' " + arguments + destination +
                              " 2>'" + errors + "' </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(output), read_text(errors)};
}

inline void expect_holds(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nis not in\n" << text;
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
  expect_holds(outcome.errors, mentioned);
}

/// Answered, with these words on standard error.
inline void expect_said(const std::string& arguments, const std::vector<std::string>& words) {
  const Outcome outcome = run_holdfast(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << arguments << outcome.errors;
  expect_holds(outcome.errors, words);
}

/// A file in a folder of its own.
class TextFile {
 public:
  explicit TextFile(const std::string& text, const std::string& name = "mine.toml")
      : path_((folder_ / name).string()) {
    write_text(path_, text);
  }

  const std::string& path() const { return path_; }
  std::string as_case() const { return " --case '" + path_ + "'"; }

 private:
  TemporaryFolder folder_;
  std::string path_;
};

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

/// Printed by a command that does its work.
inline std::string printed_by(const std::string& arguments) {
  const Outcome outcome = run_holdfast(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << arguments << '\n' << outcome.errors;
  return outcome.output;
}

/// The first line that it prints.
inline std::string header_of(const std::string& arguments) {
  const std::string output = printed_by(arguments);
  return output.substr(0, output.find_first_of("\r\n"));
}

/// The table that a command line writes, which has to do so without a word on standard error.
inline program::CsvTable table_of(const std::string& arguments) {
  const Outcome outcome = run_holdfast(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << arguments << '\n' << outcome.errors;
  EXPECT_EQ(outcome.errors, "") << arguments;
  return program::parse_csv(outcome.output, arguments);
}

/// The row with this text in a column.
inline std::size_t row_of(const program::CsvTable& table, const std::string& text,
                          const std::string& column = "quantity") {
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (table.text(row, column) == text) return row;
  ADD_FAILURE() << "no row of " << text;
  return 0;
}

/// A number of a table of quantities.
inline double value_of(const program::CsvTable& table, const std::string& quantity,
                       const std::string& column = "value") {
  return table.number(row_of(table, quantity), column);
}

/// Largest magnitude in a column.
inline double largest_in(const program::CsvTable& table, const std::string& column) {
  double largest = 0.0;
  for (const double value : table.numbers(column)) largest = std::max(largest, std::abs(value));
  return largest;
}

/// A job over gains, asked for one pair of them.
inline program::CsvTable cell_of(const std::string& job, double p, double d,
                                 const std::string& settings) {
  return table_of(job + " --p=" + program::format_number(p) + " --d=" + program::format_number(d) +
                  " " + settings);
}

/// The columns of two tables are the same but for a share of the largest number in each.
inline void expect_same(const program::CsvTable& found, const program::CsvTable& expected,
                        const std::vector<std::string>& columns, double tolerance) {
  ASSERT_EQ(found.rows(), expected.rows());
  ASSERT_GT(found.rows(), 0U);
  for (const std::string& column : columns) {
    double largest = 0.0;
    for (const double value : expected.numbers(column))
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
    for (std::size_t row = 0; row < expected.rows(); ++row) {
      const double one = found.number(row, column), other = expected.number(row, column);
      if (std::isnan(other)) {
        EXPECT_TRUE(std::isnan(one)) << column << " in row " << row;
      } else if (!std::isfinite(other)) {
        EXPECT_EQ(one, other) << column << " in row " << row;
      } else {
        EXPECT_NEAR(one, other, tolerance * largest) << column << " in row " << row;
      }
    }
  }
}

}  // namespace holdfast::tests
