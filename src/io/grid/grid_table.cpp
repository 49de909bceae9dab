#include "io/grid/grid_table.hpp"

#include <stdexcept>
#include <string>
#include <utility>

#include "io/file/output.hpp"
#include "io/grid/csv_grid.hpp"
#include "io/grid/netcdf_grid.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

std::unique_ptr<GridWriter> writer_for(const JobContext& context, GridLayout layout) {
  if (is_netcdf_name(context.output)) return netcdf_grid(context, std::move(layout));
  return csv_grid(context, std::move(layout));
}

}  // namespace

std::size_t GridAxis::count() const {
  if (const auto* list = std::get_if<std::vector<double>>(&values)) return list->size();
  if (const auto* ratios = std::get_if<LogAxis>(&values))
    return static_cast<std::size_t>(ratios->count);
  return static_cast<std::size_t>(std::get<Axis>(values).count);
}

double GridAxis::at(std::size_t index) const {
  if (const auto* list = std::get_if<std::vector<double>>(&values)) return (*list)[index];
  const auto number = static_cast<std::int64_t>(index);
  if (const auto* ratios = std::get_if<LogAxis>(&values)) return ratios->at(number);
  return std::get<Axis>(values).at(number);
}

GridTable::GridTable(const JobContext& context, const GridAxis& slow, const GridAxis& fast,
                     const std::vector<GridColumn>& columns)
    : rows_(slow.count()), columns_(columns), writer_(writer_for(context, {slow, fast, columns})) {}

void GridTable::append_row(const std::vector<GridValues>& columns) {
  throw_if_interrupted();
  bool fits = columns.size() == columns_.size() && rows_done_ < rows_;
  for (std::size_t i = 0; fits && i < columns.size(); ++i) {
    fits = std::holds_alternative<const std::uint8_t*>(columns[i]) == columns_[i].holds_flags();
  }
  if (!fits) throw std::logic_error("a row that does not fit its chart");
  writer_->append_row(columns);
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
