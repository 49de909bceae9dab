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

/// The text as a CSV cell, in quotes where RFC 4180 requires them or the text begins with #.
std::string csv_cell(std::string_view text);

/// Writer of a table as CSV (RFC 4180: CRLF line ends, quotes where needed), the header row first.
/// Numbers have the shortest digits that read back equal, or are `inf`, `-inf`, `nan`; zero has no
/// sign; booleans are 0 or 1.
///
///     writer.row(0.5, 12, "spring");
///     writer.cell(0.5); writer.cell(12); writer.end_row();   // for a variable number of columns
///
/// Throws std::logic_error if the number of cells in a row is not the number of columns,
/// Interrupted (checked every 1024 rows), and the exceptions of OutputFile::write().
class CsvWriter {
 public:
  CsvWriter(OutputFile& output, const std::vector<Column>& columns);

  /// Redirects all further cells from text to columns in memory, as many as the table has.
  void give_to(std::vector<ReceivedColumn>& columns) { received_ = columns.data(); }

  /// Appends a cell: a number, a text or a boolean.
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

  /// Appends `rows` rows given as text, with cells and line ends in the format of this class.
  void rows_of_text(std::string_view text, std::uint64_t rows);

  /// Writes the buffered text to the output; call before commit() of the output.
  void flush();

  std::uint64_t rows() const { return rows_; }
  /// Number of NaN cells in each column, of the cells written as text.
  const std::vector<std::uint64_t>& nans() const { return nans_; }

 private:
  /// A cell's value in the type of a column in memory.
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
  ReceivedColumn* received_ = nullptr;  // in place of text, if not null
};

/// A table read from CSV: text cells, converted to numbers on request. Faults are reported by line
/// and column. The text of a cell appears in a message only after require() has succeeded: a file
/// of other content may be one that the user must not read.
class CsvTable {
 public:
  const std::vector<std::string>& names() const { return names_; }
  std::size_t rows() const { return lines_.size(); }

  /// Throws WrongInput unless all these columns exist.
  void require(const std::vector<std::string>& columns);

  /// Text of a cell. Throws WrongInput if the column does not exist.
  const std::string& text(std::size_t row, std::string_view column) const;
  /// Number in a cell, also `inf` or `nan`. Throws WrongInput, with file and line, for other text.
  double number(std::size_t row, std::string_view column) const;
  std::vector<double> numbers(std::string_view column) const;
  /// Finite number in a cell. Throws WrongInput for an empty cell or any other content.
  double finite(std::size_t row, const std::string& column) const;
  /// Column of finite, strictly ascending numbers. Throws WrongInput if it is not.
  std::vector<double> ascending(const std::string& column) const;
  /// Throws WrongInput for fewer than `fewest` rows; `what` names the data in the message.
  void require_rows(std::size_t fewest, const std::string& what) const;

  /// Exception with file, line and message for a fault in a row.
  WrongInput fault(std::size_t row, const std::string& message) const;

 private:
  friend CsvTable parse_csv(std::string_view text, const std::string& name);
  std::size_t index(std::string_view column) const;
  double number_at(std::size_t row, std::size_t column) const;

  std::string name_;
  std::vector<std::string> names_;
  std::vector<std::string> cells_;  // row after row
  std::vector<std::size_t> lines_;
  bool known_ = false;  // whether require() succeeded
};

/// Reads a CSV file with a header row, LF or CRLF line ends and quoted fields, which may contain
/// line ends. Blank lines, lines that begin with # and separators at line ends are ignored. Columns
/// are separated by commas or, if the header has none outside quotes, by semicolons or tabs; then
/// numbers may have decimal commas. If the first row has numbers, the last comment before it is the
/// header. Throws WrongInput, `file:line: …`, for malformed, ambiguous or unreadable files.
CsvTable read_csv(const std::filesystem::path& file);

/// Parses a table from a text; messages give `name` as the file.
CsvTable parse_csv(std::string_view text, const std::string& name);

}  // namespace holdfast::program
