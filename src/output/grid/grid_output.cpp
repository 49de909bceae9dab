#include "output/grid/grid_output.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "io/file/output.hpp"
#include "output/grid/cell_writer.hpp"
#include "output/table.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

constexpr double largest_integer = 9007199254740992.0;  // 2^53
constexpr std::size_t most_words = 128;                 // a signed byte each in netCDF

/// Whether a grid can have the column: a known datatype, and valid words.
bool is_writable(const CellColumn& column) {
  const std::string& datatype = column.column.datatype;
  if (column.words.size() > most_words) return false;
  for (const std::string& word : column.words)
    if (word.empty() || word.find_first_of(" \t\r\n") != std::string::npos) return false;
  if (datatype == "string") return !column.words.empty();
  return datatype == "integer" || (datatype == "double" && column.words.empty());
}

const GridLayout& require_writable(const GridLayout& layout) {
  const bool whole = std::all_of(layout.axes.begin(), layout.axes.end(),
                                 [](const GridAxis& axis) { return axis.count() > 0; });
  if (layout.axes.empty() || !whole) throw std::logic_error("a grid without cells");
  for (const CellColumn& column : layout.columns) {
    if (!is_writable(column))
      throw std::logic_error("a grid cannot have the column " + column.column.name);
  }
  return layout;
}

/// Whether every value is one that the column may have.
bool fits(const CellColumn& column, const double* values, std::int64_t cells) {
  if (values == nullptr) return cells == 0;
  if (column.column.datatype == "double") return true;
  const bool worded = !column.words.empty();
  const double least = worded ? 0.0 : -largest_integer;
  const double most = worded ? static_cast<double>(column.words.size()) - 1.0 : largest_integer;
  return std::all_of(values, values + cells, [=](double value) {
    return value >= least && value <= most && value == std::trunc(value);
  });
}

}  // namespace

std::int64_t GridLayout::cells() const {
  std::int64_t product = 1;
  for (const GridAxis& axis : axes) {
    const auto count = static_cast<std::int64_t>(axis.count());
    if (count > 0 && product > std::numeric_limits<std::int64_t>::max() / count)
      throw WrongInput("the axes have more cells than can be counted: give fewer values");
    product *= count;
  }
  return product;
}

GridOutput::GridOutput(const JobContext& context, const GridLayout& layout)
    : columns_(require_writable(layout).columns), cells_(layout.cells()) {
  if (!is_netcdf_name(context.output) && !is_store_name(context.output))
    require_text_meant(context, cells_, "cells",
                       "give an --output that ends in .nc (netCDF) or .zarr (Zarr store)");
  if (is_received(context))
    writer_ = memory_cells(context, layout);
  else if (is_store_name(context.output))
    writer_ = zarr_cells(context, layout);
  else if (is_netcdf_name(context.output))
    writer_ = netcdf_cells(context, layout);
  else
    writer_ = csv_cells(context, layout);
}

GridOutput::~GridOutput() = default;

void GridOutput::append(std::int64_t cells, const std::vector<const double*>& columns) {
  throw_if_interrupted();
  if (columns.size() != columns_.size() || cells < 0 || cells > cells_ - cells_done_)
    throw std::logic_error("the grid received too many cells, or a wrong number of columns");
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!fits(columns_[i], columns[i], cells))
      throw std::logic_error("inadmissible value in the column " + columns_[i].column.name);
  }
  writer_->append(static_cast<std::size_t>(cells), columns);
  cells_done_ += cells;
}

void GridOutput::commit() {
  if (cells_done_ != cells_) {
    throw std::logic_error("a grid of " + std::to_string(cells_) + " cells received " +
                           std::to_string(cells_done_));
  }
  writer_->commit();
}

}  // namespace holdfast::program
