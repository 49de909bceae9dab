#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "case/job_context.hpp"
#include "io/file/output.hpp"
#include "io/text/csv.hpp"
#include "output/trusted_digits.hpp"

namespace holdfast::program {

/// A job's result: a CSV table and, for a named file, its metadata; both appear at commit() or
/// neither does.
///
///     Table table(context, {{"time_s", "s", "time"}, {"z1_m", "m", "displacement"}});
///     table.row(0.0, 0.1);
///     table.commit();
///
/// Throws what OutputFile and CsvWriter throw; a path that cannot be written is refused before
/// anything is computed.
class Table {
 public:
  Table(const JobContext& context, const std::vector<Column>& columns);

  template <typename... Cells>
  void row(const Cells&... cells) {
    writer_.row(cells...);
  }

  /// For rows whose width is known only when the program runs: cell() … end_row().
  CsvWriter& writer() { return writer_; }

  /// Sets the trusted digits in the metadata; call before commit().
  void trust(const TrustedDigits& trusted) { trusted_ = trusted; }

  /// How many rows are to come, where that is known.
  void expect(std::int64_t rows);

  /// Adds a note on the numbers to the metadata.
  void note(const std::string& name, const std::string& text) {
    context_.notes.emplace_back(name, text);
  }

  /// Warns where a cell is no number in a column whose description does not say what `nan` means
  /// there, and throws NoAnswer where more than a tenth of them are; call before commit().
  void require_numbers();

  void commit();

 private:
  std::uint64_t nans(std::size_t column);

  OutputFile output_;
  CsvWriter writer_;
  std::unique_ptr<OutputFile> metadata_;  // none for standard output
  JobContext context_;
  std::vector<Column> columns_;
  std::vector<ReceivedColumn> received_;  // in place of text, where a host takes them
  TrustedDigits trusted_;
};

/// Throws WrongInput where so many rows or cells would be more text than anybody reads, unless
/// --yes says that they are meant.
/// @param what      "cells", "rows"
/// @param instead   what makes fewer, or another file
void require_text_meant(const JobContext& context, std::int64_t count, const std::string& what,
                        const std::string& instead);

/// Puts the digits of a table into its metadata and, where there are few, tells the user.
void tell_trust(const JobContext& context, Table& table, const TrustedDigits& trusted);

}  // namespace holdfast::program
