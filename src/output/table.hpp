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

/// A job's result: a CSV table and, for a named file, a file of metadata. At commit() both files
/// appear or neither.
///
///     Table table(context, {{"time_s", "s", "time"}, {"z1_m", "m", "displacement"}});
///     table.row(0.0, 0.1);
///     table.commit();
///
/// Throws the exceptions of OutputFile and CsvWriter. A path that cannot be written is refused
/// before the computation.
class Table {
 public:
  Table(const JobContext& context, const std::vector<Column>& columns);

  template <typename... Cells>
  void row(const Cells&... cells) {
    writer_.row(cells...);
  }

  /// Writer for rows whose number of cells is known only at run time: cell() … end_row().
  CsvWriter& writer() { return writer_; }

  /// Sets the trusted digits in the metadata; call before commit().
  void trust(const TrustedDigits& trusted) { trusted_ = trusted; }

  /// Reserves memory for the given number of rows, if the table is kept in memory.
  void expect(std::int64_t rows);

  /// Adds a note on the numbers to the metadata.
  void note(const std::string& name, const std::string& text) {
    context_.notes.emplace_back(name, text);
  }

  /// Warns of NaN cells in columns whose description does not mention `nan`. Throws NoAnswer if
  /// more than a quarter of the cells of such a column are NaN. Call before commit().
  void require_numbers();

  void commit();

 private:
  std::uint64_t nans(std::size_t column);

  OutputFile output_;
  CsvWriter writer_;
  std::unique_ptr<OutputFile> metadata_;  // none for standard output
  JobContext context_;
  std::vector<Column> columns_;
  std::vector<ReceivedColumn> received_;  // in place of text, if a host takes the table
  TrustedDigits trusted_;
};

/// Throws WrongInput if a table has more than 10⁷ rows or cells as text, or 2·10⁸ in memory, unless
/// --yes was given.
/// @param what      counted things in the message: "cells" or "rows"
/// @param instead   advice in the message: how to get fewer, or another file format
void require_text_meant(const JobContext& context, std::int64_t count, const std::string& what,
                        const std::string& instead);

/// Writes the number of trusted digits into a table's metadata, and warns if it is below six.
void tell_trust(const JobContext& context, Table& table, const TrustedDigits& trusted);

}  // namespace holdfast::program
