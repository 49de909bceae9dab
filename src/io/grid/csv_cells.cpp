#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

#include "io/grid/cell_writer.hpp"
#include "io/text/csv.hpp"
#include "io/text/table.hpp"
#include "io/text/text.hpp"

namespace holdfast::program {
namespace {

std::vector<Column> columns_of(const std::vector<GridAxis>& axes,
                               const std::vector<CellColumn>& columns) {
  std::vector<Column> all;
  all.reserve(axes.size() + columns.size());
  for (const GridAxis& axis : axes) all.push_back(axis.column);
  for (const CellColumn& column : columns) all.push_back(column.column);
  return all;
}

/// A number with the comma behind it, to be copied into many lines.
struct CellText {
  std::array<char, 31> characters;
  std::uint8_t size;
};
static_assert(sizeof(CellText) == 32);

CellText cell_text(double value) {
  CellText text{};
  char* end = put_number(text.characters.data(), value);
  *end++ = ',';
  text.size = static_cast<std::uint8_t>(end - text.characters.data());
  return text;
}

/// Copies the whole text, of any length, and returns the place behind its comma: a copy of
/// fixed size is two instructions, and what is behind the digits will be written over. There must
/// be room for sizeof(CellText) characters.
char* put_text(char* place, const CellText& text) {
  std::memcpy(place, &text, sizeof(text));
  return place + text.size;
}

/// The texts of an axis' values: each is formed once, unless the axis is so long that keeping the
/// texts would cost more memory than it saves time.
class AxisTexts {
 public:
  explicit AxisTexts(const GridAxis& axis)
      : axis_(axis), texts_(std::min(axis.count(), most_texts_)) {
    for (std::size_t i = 0; i < texts_.size(); ++i) texts_[i] = cell_text(axis_.at(i));
  }

  CellText at(std::size_t index) const {
    return index < texts_.size() ? texts_[index] : cell_text(axis_.at(index));
  }

 private:
  static constexpr std::size_t most_texts_ = std::size_t{1} << 16;

  GridAxis axis_;
  std::vector<CellText> texts_;
};

/// Lines of a CSV table that are formed as text in place and handed over many at a time.
class CsvLines {
 public:
  /// @param longest_line  characters that a line may take, and those copied beyond its end
  CsvLines(CsvWriter& writer, std::size_t longest_line)
      : writer_(writer), buffer_(buffer_size_ + longest_line) {}

  /// Where the next line begins.
  char* place() { return buffer_.data() + used_; }

  /// @param end  behind the comma of the line's last cell
  void end_line(char* end) {
    end[-1] = '\r';  // in the place of the last comma
    *end++ = '\n';
    used_ = static_cast<std::size_t>(end - buffer_.data());
    ++lines_;
    if (used_ >= buffer_size_) hand_over();
  }

  void hand_over() {
    writer_.rows_of_text({buffer_.data(), used_}, lines_);
    used_ = 0;
    lines_ = 0;
  }

 private:
  static constexpr std::size_t buffer_size_ = std::size_t{1} << 18;

  CsvWriter& writer_;
  std::vector<char> buffer_;
  std::size_t used_ = 0;
  std::uint64_t lines_ = 0;  // in the buffer
};

/// How the values of a column become text.
class ColumnText {
 public:
  explicit ColumnText(const CellColumn& column) : whole_(column.column.datatype == "integer") {
    const bool number = column.column.datatype != "string";
    for (const std::string& word : column.words)
      words_.push_back(number ? std::to_string(words_.size()) : csv_cell(word));
  }

  /// Writes the value with a comma and returns the place behind.
  char* put(char* place, double value) const {
    if (!words_.empty()) {
      const std::string& word = words_[static_cast<std::size_t>(value)];
      place = std::copy(word.begin(), word.end(), place);
    } else if (whole_) {
      place = std::to_chars(place, place + longest_number, static_cast<std::int64_t>(value)).ptr;
    } else {
      place = put_number(place, value);
    }
    *place++ = ',';
    return place;
  }

  /// Of a value and its comma.
  std::size_t longest() const {
    std::size_t size = longest_number;
    for (const std::string& word : words_) size = std::max(size, word.size());
    return size + 1;
  }

 private:
  bool whole_;
  std::vector<std::string> words_;  // as in the file
};

/// Of the axes and the values; what put_text() copies beyond an axis' text has room behind.
std::size_t longest_line(std::size_t axes, const std::vector<ColumnText>& columns) {
  std::size_t size = (axes + 2) * sizeof(CellText);
  for (const ColumnText& column : columns) size += column.longest();
  return size;
}

class CsvCells : public CellWriter {
 public:
  CsvCells(const JobContext& context, std::vector<GridAxis> axes,
           const std::vector<CellColumn>& columns)
      : table_(context, columns_of(axes, columns)),
        columns_(columns.begin(), columns.end()),
        lines_(table_.writer(), longest_line(axes.size(), columns_)),
        axes_(std::move(axes)),
        fast_texts_(axes_.back()),
        indices_(axes_.size(), 0),
        ends_(axes_.size() - 1, 0) {
    form_slow_texts(0);
  }

  void append(std::size_t cells, const std::vector<const double*>& columns) override {
    for (std::size_t cell = 0; cell < cells; ++cell) {
      char* place = std::copy(slow_texts_.begin(), slow_texts_.end(), lines_.place());
      place = put_text(place, fast_texts_.at(indices_.back()));
      for (std::size_t i = 0; i < columns_.size(); ++i)
        place = columns_[i].put(place, columns[i][cell]);
      lines_.end_line(place);
      go_to_next_cell();
    }
  }

  void commit() override {
    lines_.hand_over();
    table_.commit();
  }

 private:
  void go_to_next_cell() {
    if (++indices_.back() < axes_.back().count()) return;
    std::size_t changed = axes_.size() - 1;
    indices_[changed] = 0;
    while (changed-- > 0) {
      if (++indices_[changed] < axes_[changed].count()) return form_slow_texts(changed);
      indices_[changed] = 0;
    }
  }

  /// Of the axes from that one on, all but the fast one.
  void form_slow_texts(std::size_t axis) {
    slow_texts_.resize(axis > 0 ? ends_[axis - 1] : 0);
    for (; axis < ends_.size(); ++axis) {
      const CellText text = cell_text(axes_[axis].at(indices_[axis]));
      slow_texts_.append(text.characters.data(), text.size);
      ends_[axis] = slow_texts_.size();
    }
  }

  Table table_;
  std::vector<ColumnText> columns_;
  CsvLines lines_;
  std::vector<GridAxis> axes_;
  AxisTexts fast_texts_;
  std::vector<std::size_t> indices_;  // of the next cell
  std::string slow_texts_;            // of the next cell, each with its comma
  std::vector<std::size_t> ends_;     // of each text in them
};

}  // namespace

std::unique_ptr<CellWriter> csv_cells(const JobContext& context, std::vector<GridAxis> axes,
                                      const std::vector<CellColumn>& columns) {
  return std::make_unique<CsvCells>(context, std::move(axes), columns);
}

}  // namespace holdfast::program
