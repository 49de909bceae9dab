#include "csv_grid.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include "table.hpp"

namespace holdfast::program {
namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 18;
/// Beyond that many values a row is so long that the texts would cost more memory than time.
constexpr std::size_t most_texts = std::size_t{1} << 20;
constexpr std::size_t longest_number = 24;  // "-2.2250738585072014e-308"
constexpr std::size_t longest_cell = 32;

/// The digits that CsvWriter writes, and the place behind them.
char* put_number(char* place, double value) {
  if (!std::isnan(value)) return std::to_chars(place, place + longest_number, value).ptr;
  std::memcpy(place, "nan", 3);  // to_chars would tell the sign of a NaN
  return place + 3;
}

/// A number with the comma behind it.
struct CellText {
  std::array<char, longest_cell - 1> characters;
  std::uint8_t size;
};
static_assert(sizeof(CellText) == longest_cell);

CellText text_of(double value) {
  CellText text{};
  char* end = put_number(text.characters.data(), value);
  *end++ = ',';
  text.size = static_cast<std::uint8_t>(end - text.characters.data());
  return text;
}

/// One column along the fast axis; the other pointer is null.
struct Values {
  const std::uint8_t* flags = nullptr;
  const double* reals = nullptr;
};

std::vector<Values> values_of(const std::vector<GridValues>& row) {
  std::vector<Values> result;
  for (const GridValues& column : row) {
    if (const auto* flags = std::get_if<const std::uint8_t*>(&column)) {
      result.push_back({*flags, nullptr});
    } else {
      result.push_back({nullptr, std::get<const double*>(column)});
    }
  }
  return result;
}

char* put_values(char* place, const std::vector<Values>& columns, std::size_t index) {
  for (const Values& column : columns) {
    if (column.flags != nullptr) {
      *place++ = column.flags[index] != 0 ? '1' : '0';
    } else {
      place = put_number(place, column.reals[index]);
    }
    *place++ = ',';
  }
  return place;
}

std::vector<Column> csv_columns(const GridLayout& layout) {
  std::vector<Column> columns = {layout.slow.column, layout.fast.column};
  for (const GridColumn& values : layout.columns) columns.push_back(values.column);
  return columns;
}

class CsvGrid : public GridWriter {
 public:
  CsvGrid(const JobContext& context, GridLayout layout)
      : layout_(std::move(layout)),
        table_(context, csv_columns(layout_)),
        fast_texts_(std::min(layout_.fast.count(), most_texts)),
        buffer_(buffer_size + (layout_.columns.size() + 3) * longest_cell) {
    for (std::size_t i = 0; i < fast_texts_.size(); ++i) {
      fast_texts_[i] = text_of(layout_.fast.at(i));
    }
  }

  void append_row(const std::vector<GridValues>& row) override {
    const std::vector<Values> columns = values_of(row);
    const CellText slow = text_of(layout_.slow.at(row_++));
    const std::size_t count = layout_.fast.count();
    for (std::size_t i = 0; i < count; ++i) {
      const CellText fast = i < fast_texts_.size() ? fast_texts_[i] : text_of(layout_.fast.at(i));
      // Whole texts, whatever their length: a copy of fixed size is two instructions, and what is
      // behind the digits is written over.
      char* place = buffer_.data() + used_;
      std::memcpy(place, &slow, sizeof(slow));
      place += slow.size;
      std::memcpy(place, &fast, sizeof(fast));
      place = put_values(place + fast.size, columns, i);
      place[-1] = '\r';  // in the place of the last comma
      *place++ = '\n';
      used_ = static_cast<std::size_t>(place - buffer_.data());
      ++lines_;
      if (used_ >= buffer_size) hand_over();
    }
  }

  void commit() override {
    hand_over();
    table_.commit();
  }

 private:
  void hand_over() {
    table_.writer().rows_of_text(std::string_view(buffer_.data(), used_), lines_);
    used_ = 0;
    lines_ = 0;
  }

  GridLayout layout_;
  Table table_;
  std::vector<CellText> fast_texts_;
  std::vector<char> buffer_;
  std::size_t used_ = 0;
  std::uint64_t lines_ = 0;  // in the buffer
  std::size_t row_ = 0;
};

}  // namespace

std::unique_ptr<GridWriter> csv_grid(const JobContext& context, GridLayout layout) {
  return std::make_unique<CsvGrid>(context, std::move(layout));
}

}  // namespace holdfast::program
