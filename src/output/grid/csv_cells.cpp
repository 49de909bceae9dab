#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "io/text/csv.hpp"
#include "output/grid/cell_writer.hpp"
#include "output/table.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

std::vector<Column> columns_of(const GridLayout& layout) {
  std::vector<Column> all;
  for (const GridAxis& axis : layout.axes) all.push_back(axis.column);
  for (const CellColumn& column : layout.columns) all.push_back(column.column);
  return all;
}

/// Appends a number and a comma; zero has no sign.
void append_number(std::string& text, double value) {
  std::array<char, longest_number> digits;  // NOLINT: put_number fills it
  text.append(digits.data(), put_number(digits.data(), value + 0.0)) += ',';
}

/// The texts of an axis' first values, each formed once. For a very long axis, keeping all texts
/// would cost more memory than it saves time.
std::vector<std::string> texts_of(const GridAxis& axis) {
  constexpr std::size_t most = std::size_t{1} << 16;
  std::vector<std::string> texts(std::min(axis.count(), most));
  for (std::size_t i = 0; i < texts.size(); ++i) append_number(texts[i], axis.at(i));
  return texts;
}

/// Conversion of a column's values to text.
class ColumnText {
 public:
  explicit ColumnText(const CellColumn& column) : whole_(column.column.datatype == "integer") {
    for (const std::string& word : column.words)
      words_.push_back((whole_ ? std::to_string(words_.size()) : csv_cell(word)) + ",");
  }

  void append(std::string& text, double value) const {
    if (!words_.empty()) {
      text += words_[static_cast<std::size_t>(value)];
    } else if (whole_) {
      text.append(std::to_string(static_cast<std::int64_t>(value))) += ',';
    } else {
      append_number(text, value);
    }
  }

 private:
  bool whole_;
  std::vector<std::string> words_;  // as in the file, with their commas
};

/// Writer of cells as CSV; forms many lines as text before it passes them to the table.
class CsvCells final : public CellWriter {
 public:
  CsvCells(const JobContext& context, const GridLayout& layout)
      : table_(context, columns_of(layout)),
        axes_(layout.axes),
        columns_(layout.columns.begin(), layout.columns.end()),
        fast_texts_(texts_of(axes_.back())) {
    text_.reserve(text_size_ + 4096);
  }

  void append(std::size_t cells, const std::vector<const double*>& columns) override {
    for (std::size_t cell = 0; cell < cells; ++cell) {
      append_axes();
      for (std::size_t i = 0; i < columns_.size(); ++i) columns_[i].append(text_, columns[i][cell]);
      text_.back() = '\r';  // in the place of the last comma
      text_ += '\n';
      ++lines_;
      if (text_.size() >= text_size_) hand_over();
    }
  }

  void commit() override {
    hand_over();
    table_.commit();
  }

 private:
  static constexpr std::size_t text_size_ = std::size_t{1} << 18;

  /// Appends the axes of the next cell.
  void append_axes() {
    if (fast_ == 0) form_slow_texts();
    text_ += slow_texts_;
    if (fast_ < fast_texts_.size())
      text_ += fast_texts_[fast_];
    else
      append_number(text_, axes_.back().at(fast_));
    ++next_;
    if (++fast_ == axes_.back().count()) fast_ = 0;
  }

  void form_slow_texts() {
    slow_texts_.clear();
    for (std::size_t axis = 0; axis + 1 < axes_.size(); ++axis)
      append_number(slow_texts_, axes_[axis].at(index_along(axes_, axis, next_)));
  }

  void hand_over() {
    table_.writer().rows_of_text(text_, lines_);
    text_.clear();
    lines_ = 0;
  }

  Table table_;
  std::vector<GridAxis> axes_;
  std::vector<ColumnText> columns_;
  std::vector<std::string> fast_texts_;  // of the last axis
  std::string slow_texts_;               // of the other axes at the next cell
  std::size_t next_ = 0;                 // cell
  std::size_t fast_ = 0;                 // its index along the last axis
  std::string text_;
  std::uint64_t lines_ = 0;  // in the text
};

}  // namespace

std::unique_ptr<CellWriter> csv_cells(const JobContext& context, const GridLayout& layout) {
  return std::make_unique<CsvCells>(context, layout);
}

}  // namespace holdfast::program
