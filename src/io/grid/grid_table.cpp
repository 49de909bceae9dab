#include "io/grid/grid_table.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "io/file/output.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

/// In netCDF a number is a double, whatever a table calls it.
std::vector<CellColumn> cell_columns(const JobContext& context, std::vector<CellColumn> columns) {
  for (CellColumn& cells : columns)
    if (cells.words.empty() && is_netcdf_name(context.output)) cells.column.datatype = "double";
  return columns;
}

}  // namespace

std::unique_ptr<CellWriter> cell_writer(const JobContext& context, std::vector<GridAxis> axes,
                                        const std::vector<CellColumn>& columns,
                                        CellPortions portions) {
  if (is_netcdf_name(context.output)) return netcdf_cells(context, axes, columns, portions);
  return csv_cells(context, std::move(axes), columns);
}

GridTable::GridTable(const JobContext& context, const GridAxis& slow, const GridAxis& fast,
                     const std::vector<CellColumn>& columns)
    : rows_(slow.count()),
      cells_of_row_(fast.count()),
      columns_(columns),
      flags_(columns.size()),
      writer_(cell_writer(context, {slow, fast}, cell_columns(context, columns),
                          CellPortions::lines)) {}

void GridTable::append_row(const std::vector<GridValues>& columns) {
  throw_if_interrupted();
  bool fits = columns.size() == columns_.size() && rows_done_ < rows_;
  for (std::size_t i = 0; fits && i < columns.size(); ++i) {
    fits = std::holds_alternative<const std::uint8_t*>(columns[i]) != columns_[i].words.empty();
  }
  if (!fits) throw std::logic_error("a row that does not fit its chart");
  std::vector<const double*> values;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (const auto* reals = std::get_if<const double*>(&columns[i])) {
      values.push_back(*reals);
      continue;
    }
    const std::uint8_t* flags = std::get<const std::uint8_t*>(columns[i]);
    flags_[i].resize(cells_of_row_);
    std::transform(flags, flags + cells_of_row_, flags_[i].begin(),
                   [](std::uint8_t flag) { return flag != 0 ? 1.0 : 0.0; });
    values.push_back(flags_[i].data());
  }
  writer_->append(cells_of_row_, values);
  ++rows_done_;
}

void GridTable::commit() {
  if (rows_done_ != rows_) {
    throw std::logic_error("a chart of " + std::to_string(rows_) + " rows has " +
                           std::to_string(rows_done_));
  }
  writer_->commit();
}

}  // namespace holdfast::program
