#include "io/text/csv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "io/file/whole_file.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 18;

bool needs_quotes(std::string_view text) {
  return begins_with(text, "#") || text.find_first_of(",\"\r\n") != std::string_view::npos;
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
    : output_(output), width_(columns.size()), nans_(columns.size()) {
  buffer_.reserve(buffer_size + 4096);
  for (const Column& column : columns) text_cell(column.name);
  end_line();
}

void CsvWriter::separate() {
  if (cells_in_row_++ > 0) buffer_ += ',';
}

void CsvWriter::text_cell(double value) {
  if (std::isnan(value) && cells_in_row_ < width_) ++nans_[cells_in_row_];
  separate();
  std::array<char, longest_number> digits;  // NOLINT: put_number fills it
  buffer_.append(digits.data(), put_number(digits.data(), value + 0.0));  // −0 + 0 = 0
}

void CsvWriter::text_cell(std::string_view text) {
  separate();
  // An empty cell in quotes: alone on its line it would read as a blank line.
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

/// Separator of the first line outside quotes: comma, else semicolon, else tab; default: comma.
char separator_of(std::string_view text) {
  constexpr std::string_view known = ",;\t";
  bool quoted = false;
  std::size_t first = known.size();
  for (const char character : text) {
    if (character == '"') quoted = !quoted;
    if (quoted) continue;
    if (character == '\r' || character == '\n') break;
    first = std::min(first, known.find(character));
  }
  return known[first % known.size()];
}

/// Reader of the rows of a CSV text; skips blank lines and comments.
class CsvScanner {
 public:
  CsvScanner(std::string_view text, const std::string& name) : text_(text), name_(name) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text_.substr(0, 3) == byte_order_mark) position_ = 3;
    const std::string_view wide = text_.substr(0, 2);
    if (wide == "\xFF\xFE" || wide == "\xFE\xFF") refuse("is UTF-16; save it as UTF-8");
  }

  char separator() const { return separator_; }

  /// Names of the columns; if the first line has numbers, taken from the comment before it.
  std::vector<std::string> header() {
    skip_idle_lines();
    const std::string_view rest = text_.substr(position_);
    if (!comment_.empty() && rest.find_first_of("+-.0123456789") == 0) {
      separator_ = separator_of(comment_);
      return CsvScanner(comment_, name_).header();
    }
    separator_ = separator_of(rest);
    std::vector<std::string> names = next_row().cells;
    for (std::string& name : names) name = trimmed(name);
    while (!names.empty() && names.back().empty()) names.pop_back();
    return names;
  }

  CsvRow next_row() {
    skip_idle_lines();
    CsvRow row;
    row.line = line_;
    if (at_end()) return row;
    do {
      row.cells.push_back(next_cell());
    } while (take(separator_));
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

  void skip_idle_lines() {
    while (take_line_end() || take('#')) {
      if (text_[position_ - 1] != '#') continue;
      comment_ = text_.substr(position_, end_of_cell("\r\n") - position_);
      position_ += comment_.size();
    }
  }

  std::size_t end_of_cell(std::string_view ends) const {
    return std::min(text_.find_first_of(ends, position_), text_.size());
  }

  void skip_blanks() {
    position_ = std::min(text_.find_first_not_of(' ', position_), text_.size());
  }

  /// The next cell; blanks around its quotes are skipped.
  std::string next_cell() {
    const std::size_t begin = position_;
    skip_blanks();
    if (take('"')) {
      std::string cell = quoted_cell();
      skip_blanks();
      return cell;
    }
    position_ = begin;
    const std::size_t end = end_of_cell(std::string{separator_, '\r', '\n'});
    std::string cell(text_.substr(position_, end - position_));
    if (cell.find('"') != std::string::npos) refuse("quote in a cell that begins without a quote");
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
  std::string_view comment_;  // the last comment
  char separator_ = ',';
};

/// The cell "0,5" as "0.5"; nullopt if the result is not a number.
std::optional<std::string> with_point(std::string cell) {
  const std::size_t comma = cell.find(',');
  if (comma == std::string::npos) return std::nullopt;
  cell[comma] = '.';
  if (!parse_number(trimmed(cell))) return std::nullopt;
  return cell;
}

/// Whether the comma may separate thousands, as in "1,234".
bool may_be_grouped(std::string_view cell) {
  const std::size_t comma = cell.find(',');
  return comma >= 1 && comma <= 3 && cell.front() != '0' && cell.size() == comma + 4;
}

/// Replaces decimal commas by points in a table separated by semicolons or tabs. Throws WrongInput
/// if the commas may separate thousands.
void take_decimal_commas(std::vector<std::string>& cells, char separator, const std::string& file) {
  bool has_comma = false, has_point = false, is_decimal = separator == ';';
  for (std::string& cell : cells) {
    const bool is_number = parse_number(trimmed(cell)).has_value();
    has_point = has_point || (is_number && cell.find('.') != std::string::npos);
    const auto pointed = is_number ? std::nullopt : with_point(cell);
    if (!pointed) continue;
    has_comma = true;
    is_decimal = is_decimal || !may_be_grouped(trimmed(cell));
    cell = *pointed;
  }
  if (has_comma && (has_point || !is_decimal))
    throw WrongInput(file + ": some of its numbers have commas" +
                     (has_point ? " and some have points" : ", which may separate thousands") +
                     "; write a decimal point, and nothing between thousands");
}

bool is_blank(const std::vector<std::string>& cells) {
  return std::all_of(cells.begin(), cells.end(),
                     [](const std::string& cell) { return trimmed(cell).empty(); });
}

/// Throws WrongInput for equal names, with the columns' positions; the names may be confidential.
void refuse_repeated_names(const std::vector<std::string>& names, const std::string& file) {
  std::vector<std::pair<std::string_view, std::size_t>> sorted;
  for (std::size_t i = 0; i < names.size(); ++i) sorted.emplace_back(names[i], i);
  std::sort(sorted.begin(), sorted.end());
  const auto same =
      std::adjacent_find(sorted.begin(), sorted.end(),
                         [](const auto& a, const auto& b) { return a.first == b.first; });
  if (same == sorted.end()) return;
  throw WrongInput(file + ":1: the columns " + std::to_string(same->second + 1) + " and " +
                   std::to_string(std::next(same)->second + 1) + " have the same name; rename one");
}

}  // namespace

std::size_t CsvTable::index(std::string_view column) const {
  const auto found = std::find(names_.begin(), names_.end(), column);
  if (found == names_.end()) {
    throw WrongInput(
        name_ + ": has no column \"" + std::string(column) +
        "\", columns found: " + std::to_string(names_.size()) +
        (names_.size() == 1 ? "; separate columns by commas, semicolons or tabs" : ""));
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
    throw fault(row, (known_ ? names_[column] + " = \"" + cell + "\""
                             : "column " + std::to_string(column + 1)) +
                         " is not a number" + (with_point(cell) ? ": write a decimal point" : ""));
  }
  return *value;
}

double CsvTable::finite(std::size_t row, const std::string& column) const {
  if (trimmed(text(row, column)).empty()) throw fault(row, column + " is missing");
  const double value = number(row, column);
  if (!std::isfinite(value))
    throw fault(row, column + " = " + format_number(value) + ": must be finite");
  return value;
}

void CsvTable::require_rows(std::size_t fewest, const std::string& what) const {
  if (rows() < fewest)
    throw WrongInput(name_ + ": " + what + " needs at least " + std::to_string(fewest) +
                     " rows, but has " + std::to_string(rows()));
}

std::vector<double> CsvTable::ascending(const std::string& column) const {
  std::vector<double> values;
  for (std::size_t row = 0; row < rows(); ++row) {
    values.push_back(finite(row, column));
    if (row > 0 && values[row] <= values[row - 1])
      throw fault(row, column + " = " + format_number(values[row]) + " must exceed " +
                           format_number(values[row - 1]) + " of the row before");
  }
  return values;
}

WrongInput CsvTable::fault(std::size_t row, const std::string& message) const {
  return WrongInput(name_ + ":" + std::to_string(lines_[row]) + ": " + message);
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
  table.names_ = scanner.header();
  const std::size_t width = table.names_.size();
  if (width == 0) throw WrongInput(name + ": has no header row; begin with a row of column names");
  refuse_repeated_names(table.names_, name);
  for (CsvRow row = scanner.next_row(); !row.cells.empty(); row = scanner.next_row()) {
    if (width > 1 && is_blank(row.cells)) continue;
    while (row.cells.size() > width && trimmed(row.cells.back()).empty()) row.cells.pop_back();
    table.lines_.push_back(row.line);
    if (row.cells.size() != width)
      throw table.fault(table.rows() - 1,
                        "has " + std::to_string(row.cells.size()) + " cells, the header has " +
                            std::to_string(width) +
                            (row.cells.size() > width && scanner.separator() == ','
                                 ? ": with decimal commas, separate columns by semicolons"
                                 : ""));
    for (std::string& cell : row.cells) table.cells_.push_back(std::move(cell));
  }
  if (scanner.separator() != ',') take_decimal_commas(table.cells_, scanner.separator(), name);
  return table;
}

}  // namespace holdfast::program
