#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "io/grid/cell_writer.hpp"
#include "io/text/csv.hpp"
#include "io/text/csv_lines.hpp"
#include "io/text/number_text.hpp"
#include "io/text/table.hpp"

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
      place = put_number(place, static_cast<std::int64_t>(value));
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
