#include "io/grid/csv_grid.hpp"

#include <cstdint>
#include <utility>
#include <vector>

#include "io/text/csv_lines.hpp"
#include "io/text/number_text.hpp"
#include "io/text/table.hpp"

namespace holdfast::program {
namespace {

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
        lines_(table_.writer(), (layout_.columns.size() + 3) * sizeof(CellText)),
        fast_texts_(layout_.fast) {}

  void append_row(const std::vector<GridValues>& row) override {
    const std::vector<Values> columns = values_of(row);
    const CellText slow = cell_text(layout_.slow.at(row_++));
    const std::size_t count = layout_.fast.count();
    for (std::size_t i = 0; i < count; ++i) {
      char* place = put_text(lines_.place(), slow);
      place = put_text(place, fast_texts_.at(i));
      lines_.end_line(put_values(place, columns, i));
    }
  }

  void commit() override {
    lines_.hand_over();
    table_.commit();
  }

 private:
  GridLayout layout_;
  Table table_;
  CsvLines lines_;
  AxisTexts fast_texts_;
  std::size_t row_ = 0;
};

}  // namespace

std::unique_ptr<GridWriter> csv_grid(const JobContext& context, GridLayout layout) {
  return std::make_unique<CsvGrid>(context, std::move(layout));
}

}  // namespace holdfast::program
