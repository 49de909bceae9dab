#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "host/received_table.hpp"
#include "io/file/output.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "text/column.hpp"

namespace holdfast::program {

/// The text as a cell of CSV: in quotes where RFC 4180 wants them.
std::string csv_cell(std::string_view text);

/// Writes a table as CSV (RFC 4180: CRLF line ends, quotes where needed), the header row first.
/// Numbers have the shortest digits that read back the same; `inf`, `-inf`, `nan`; 0 without a
/// sign; booleans 0, 1.
///
///     writer.row(0.5, 12, "spring");
///     writer.cell(0.5); writer.cell(12); writer.end_row();   // where the width is not fixed
///
/// Throws std::logic_error when a row has not as many cells as there are columns, Interrupted
/// every so many rows, and what OutputFile::write() throws.
class CsvWriter {
 public:
  CsvWriter(OutputFile& output, const std::vector<Column>& columns);

  /// From here on cells go to these columns, of which there are as many, and none becomes text.
  void give_to(std::vector<ReceivedColumn>& columns) { received_ = columns.data(); }

  /// A number, a text or a boolean.
  template <typename Value>
  void cell(const Value& value) {
    if (received_ != nullptr)
      receive(received_as(value));
    else
      text_cell(value);
  }
  void end_row() {
    if (received_ == nullptr || cells_in_row_ != width_) return end_text_row();
    cells_in_row_ = 0;
    count_row();
  }

  template <typename... Cells>
  void row(const Cells&... cells) {
    if (received_ != nullptr && cells_in_row_ == 0 && sizeof...(cells) == width_) {
      ReceivedColumn* column = received_;
      ((column++)->put(received_as(cells)), ...);
      return count_row();
    }
    (cell(cells), ...);
    end_row();
  }

  /// Rows that are text already, each with its cells and its line end as this class writes them.
  void rows_of_text(std::string_view text, std::uint64_t rows);

  /// Hands what is still held back to the output; call before its commit().
  void flush();

  std::uint64_t rows() const { return rows_; }
  /// How many cells of each column were no number, of those that became text here.
  const std::vector<std::uint64_t>& nans() const { return nans_; }

 private:
  /// A cell as a column in memory takes it.
  static double received_as(double value) { return value; }
  static std::string_view received_as(std::string_view text) { return text; }
  template <typename Integer, std::enable_if_t<std::is_integral_v<Integer>, int> = 0>
  static std::int64_t received_as(Integer value) {
    return static_cast<std::int64_t>(value);
  }

  void text_cell(double value);
  void text_cell(std::string_view text);
  template <typename Integer, std::enable_if_t<std::is_integral_v<Integer>, int> = 0>
  void text_cell(Integer value) {
    separate();
    buffer_ += std::to_string(value);
  }
  template <typename Value>
  void receive(Value value) {
    if (cells_in_row_ < width_) received_[cells_in_row_].put(value);
    ++cells_in_row_;
  }
  void separate();
  void end_line();
  void end_text_row();
  void count_row() {
    constexpr std::uint64_t rows_between_looks = 1024;
    if (++rows_ % rows_between_looks == 0) throw_if_interrupted();
  }

  OutputFile& output_;
  std::size_t width_;
  std::vector<std::uint64_t> nans_;
  std::size_t cells_in_row_ = 0;
  std::uint64_t rows_ = 0;
  std::string buffer_;
  ReceivedColumn* received_ = nullptr;  // where cells are not to become text
};

/// A table read from CSV: text cells, with numbers on request. What is wrong with it is told by
/// line and column; a cell is quoted only where require() has shown that the file is what it was
/// taken for, as whoever names a file need not be allowed to read it.
class CsvTable {
 public:
  const std::vector<std::string>& names() const { return names_; }
  std::size_t rows() const { return lines_.size(); }

  /// Throws WrongInput unless there are these columns.
  void require(const std::vector<std::string>& columns);

  /// Throws WrongInput when there is no such column.
  const std::string& text(std::size_t row, std::string_view column) const;
  /// Throws WrongInput with file and line for a cell that is not a number; `inf`, `nan` are.
  double number(std::size_t row, std::string_view column) const;
  std::vector<double> numbers(std::string_view column) const;
  /// The same; throws also for an empty cell and for a number that is not finite.
  double finite(std::size_t row, const std::string& column) const;
  /// A column of finite numbers, each above the one before. Throws WrongInput where one is not.
  std::vector<double> ascending(const std::string& column) const;
  /// Throws WrongInput for fewer rows than `what` needs.
  void require_rows(std::size_t fewest, const std::string& what) const;

  /// Fault of a row, with file and line.
  WrongInput fault(std::size_t row, const std::string& message) const;

 private:
  friend CsvTable parse_csv(std::string_view text, const std::string& name);
  std::size_t index(std::string_view column) const;
  double number_at(std::size_t row, std::size_t column) const;

  std::string name_;
  std::vector<std::string> names_;
  std::vector<std::string> cells_;  // row after row
  std::vector<std::size_t> lines_;
  bool known_ = false;  // it has the columns of what it was taken for
};

/// Reads a CSV file with a header row: LF or CRLF, quoted fields that may hold both; blank lines,
/// lines that begin with #, and separators at the end of lines count for nothing. Columns stand
/// between commas or, where the header has none outside quotes, between semicolons or tabs; then
/// numbers may have decimal commas. Above numbers without a header the last comment is one.
/// Throws WrongInput, `file:line: …`, for anything malformed, ambiguous or unreadable.
CsvTable read_csv(const std::filesystem::path& file);

/// Parses a table from a text; `name` stands for the file in messages.
CsvTable parse_csv(std::string_view text, const std::string& name);

}  // namespace holdfast::program
