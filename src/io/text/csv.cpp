#include "io/text/csv.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "io/file/input.hpp"
#include "io/text/text.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 18;

bool needs_quotes(std::string_view text) {
  return text.find_first_of(",\"\r\n") != std::string_view::npos;
}

void append_quoted(std::string& buffer, std::string_view text) {
  buffer += '"';
  for (const char character : text) {
    if (character == '"') buffer += '"';
    buffer += character;
  }
  buffer += '"';
}

}  // namespace

std::string csv_cell(std::string_view text) {
  std::string cell;
  if (!needs_quotes(text)) return cell.append(text);
  append_quoted(cell, text);
  return cell;
}

CsvWriter::CsvWriter(OutputFile& output, const std::vector<Column>& columns)
    : output_(output), width_(columns.size()) {
  buffer_.reserve(buffer_size + 4096);
  for (const Column& column : columns) text_cell(column.name);
  end_line();
}

void CsvWriter::separate() {
  if (cells_in_row_++ > 0) buffer_ += ',';
}

void CsvWriter::text_cell(double value) {
  separate();
  std::array<char, longest_number> digits;  // NOLINT: put_number fills it
  buffer_.append(digits.data(), put_number(digits.data(), value));
}

void CsvWriter::text_cell(std::string_view text) {
  separate();
  // An empty cell alone on its line would read as a blank line.
  const bool blank_line = text.empty() && width_ == 1;
  if (blank_line || needs_quotes(text)) {
    append_quoted(buffer_, text);
  } else {
    buffer_ += text;
  }
}

void CsvWriter::end_text_row() {
  end_line();
  count_row();
  if (buffer_.size() >= buffer_size) flush();
}

void CsvWriter::end_line() {
  if (cells_in_row_ != width_) {
    throw std::logic_error("a row of " + std::to_string(cells_in_row_) + " cells in a table of " +
                           std::to_string(width_) + " columns");
  }
  buffer_ += "\r\n";
  cells_in_row_ = 0;
}

void CsvWriter::rows_of_text(std::string_view text, std::uint64_t rows) {
  throw_if_interrupted();
  flush();
  output_.write(text);
  rows_ += rows;
}

void CsvWriter::flush() {
  output_.write(buffer_);
  buffer_.clear();
}

namespace {

/// One row of text cells and the line on which it begins; no cells at the end of the text.
struct CsvRow {
  std::vector<std::string> cells;
  std::size_t line = 0;
};

/// Takes rows off the front of a CSV text.
class CsvScanner {
 public:
  CsvScanner(std::string_view text, const std::string& name) : text_(text), name_(name) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text_.substr(0, 3) == byte_order_mark) position_ = 3;
  }

  CsvRow next_row() {
    while (take_line_end()) {
    }
    CsvRow row;
    row.line = line_;
    if (at_end()) return row;
    do {
      row.cells.push_back(next_cell());
    } while (take(','));
    if (!at_end() && !take_line_end()) refuse("text after a closing quote");
    return row;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw WrongInput(name_ + ":" + std::to_string(line_) + ": " + why);
  }

  bool at_end() const { return position_ == text_.size(); }

  bool take(char character) {
    if (at_end() || text_[position_] != character) return false;
    ++position_;
    return true;
  }

  bool take_line_end() {
    const bool carriage_return = take('\r');
    const bool line_feed = take('\n');
    if (carriage_return || line_feed) ++line_;
    return carriage_return || line_feed;
  }

  std::string next_cell() {
    if (take('"')) return quoted_cell();
    const std::size_t end = std::min(text_.find_first_of(",\r\n", position_), text_.size());
    std::string cell(text_.substr(position_, end - position_));
    if (cell.find('"') != std::string::npos) refuse("a quote inside a cell without quotes");
    position_ = end;
    return cell;
  }

  std::string quoted_cell() {
    const std::size_t first_line = line_;
    std::string cell;
    for (;;) {
      const std::size_t quote = text_.find('"', position_);
      if (quote == std::string_view::npos) {
        line_ = first_line;
        refuse("a quote is not closed");
      }
      cell += text_.substr(position_, quote - position_);
      line_ += static_cast<std::size_t>(
          std::count(text_.begin() + static_cast<std::ptrdiff_t>(position_),
                     text_.begin() + static_cast<std::ptrdiff_t>(quote), '\n'));
      position_ = quote + 1;
      if (!take('"')) return cell;
      cell += '"';
    }
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t position_ = 0;
  std::size_t line_ = 1;
};

/// Says which columns they are, not what they are called: the file may be none of the user's.
void refuse_repeated_names(const std::vector<std::string>& names, const std::string& file) {
  std::vector<std::pair<std::string_view, std::size_t>> sorted;
  for (std::size_t i = 0; i < names.size(); ++i) sorted.emplace_back(names[i], i);
  std::sort(sorted.begin(), sorted.end());
  const auto same =
      std::adjacent_find(sorted.begin(), sorted.end(),
                         [](const auto& a, const auto& b) { return a.first == b.first; });
  if (same == sorted.end()) return;
  throw WrongInput(file + ":1: the columns " + std::to_string(same->second + 1) + " and " +
                   std::to_string(std::next(same)->second + 1) + " have one name");
}

}  // namespace

bool CsvTable::has(std::string_view column) const {
  return std::find(names_.begin(), names_.end(), column) != names_.end();
}

std::size_t CsvTable::index(std::string_view column) const {
  const auto found = std::find(names_.begin(), names_.end(), column);
  if (found == names_.end()) {
    throw WrongInput(name_ + ": has no column \"" + std::string(column) + "\" among its " +
                     std::to_string(names_.size()));
  }
  return static_cast<std::size_t>(found - names_.begin());
}

void CsvTable::require(const std::vector<std::string>& columns) {
  for (const std::string& column : columns) index(column);
  known_ = true;
}

const std::string& CsvTable::text(std::size_t row, std::string_view column) const {
  return cells_.at(row * names_.size() + index(column));
}

double CsvTable::number_at(std::size_t row, std::size_t column) const {
  const std::string& cell = cells_.at(row * names_.size() + column);
  const auto value = parse_number(trimmed(cell));
  if (!value) {
    const std::string place = name_ + ":" + std::to_string(lines_[row]) + ": ";
    throw WrongInput(
        place +
        (known_ ? names_[column] + " = \"" + cell + "\"" : "column " + std::to_string(column + 1)) +
        " is not a number");
  }
  return *value;
}

double CsvTable::number(std::size_t row, std::string_view column) const {
  return number_at(row, index(column));
}

std::vector<double> CsvTable::numbers(std::string_view column) const {
  const std::size_t place = index(column);
  std::vector<double> values;
  values.reserve(rows());
  for (std::size_t row = 0; row < rows(); ++row) values.push_back(number_at(row, place));
  return values;
}

CsvTable read_csv(const std::filesystem::path& file) {
  return parse_csv(read_input(file), file.string());
}

CsvTable parse_csv(std::string_view text, const std::string& name) {
  CsvScanner scanner(text, name);
  CsvTable table;
  table.name_ = name;
  table.names_ = scanner.next_row().cells;
  if (table.names_.empty()) throw WrongInput(name + ": has no header row");
  refuse_repeated_names(table.names_, name);
  for (CsvRow row = scanner.next_row(); !row.cells.empty(); row = scanner.next_row()) {
    if (row.cells.size() != table.names_.size()) {
      throw WrongInput(name + ":" + std::to_string(row.line) + ": has " +
                       std::to_string(row.cells.size()) + " cells, the header has " +
                       std::to_string(table.names_.size()));
    }
    for (std::string& cell : row.cells) table.cells_.push_back(std::move(cell));
    table.lines_.push_back(row.line);
  }
  return table;
}

}  // namespace holdfast::program
