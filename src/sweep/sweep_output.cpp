#include "sweep/sweep_output.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "io/grid/netcdf_file.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

constexpr double largest_integer = 9007199254740992.0;  // 2^53

bool is_one_word(const std::string& text) {
  return !text.empty() && text.find_first_of(" \t\r\n") == std::string::npos;
}

/// Whether the datatype is one that a sweep writes, with words as it wants them.
bool is_writable(const CellColumn& column) {
  const std::string& datatype = column.column.datatype;
  if (column.words.size() > NetcdfFile::most_flags) return false;
  if (!std::all_of(column.words.begin(), column.words.end(), is_one_word)) return false;
  if (datatype == "string") return !column.words.empty();
  return datatype == "integer" || (datatype == "double" && column.words.empty());
}

bool has_values(const GridAxis& axis) { return axis.count() > 0; }

const SweepLayout& require_writable(const SweepLayout& layout) {
  const bool whole = std::all_of(layout.axes.begin(), layout.axes.end(), has_values);
  if (layout.axes.empty() || !whole) throw std::logic_error("a sweep without cells");
  for (const CellColumn& column : layout.columns) {
    if (!is_writable(column))
      throw std::logic_error("a sweep cannot write the column " + column.column.name);
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

std::int64_t SweepLayout::cells() const {
  std::int64_t product = 1;
  for (const GridAxis& axis : axes) {
    const auto count = static_cast<std::int64_t>(axis.count());
    if (count > 0 && product > std::numeric_limits<std::int64_t>::max() / count)
      throw WrongInput("the axes have more cells than can be counted");
    product *= count;
  }
  return product;
}

SweepOutput::SweepOutput(const JobContext& context, SweepLayout layout)
    : columns_(require_writable(layout).columns),
      cells_(layout.cells()),
      writer_(cell_writer(context, std::move(layout.axes), columns_, CellPortions::any)) {}

void SweepOutput::append(std::int64_t cells, const std::vector<const double*>& columns) {
  throw_if_interrupted();
  if (columns.size() != columns_.size() || cells < 0 || cells > cells_ - cells_done_)
    throw std::logic_error("cells that do not fit their sweep");
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!fits(columns_[i], columns[i], cells))
      throw std::logic_error("values that do not fit the column " + columns_[i].column.name);
  }
  writer_->append(static_cast<std::size_t>(cells), columns);
  cells_done_ += cells;
}

void SweepOutput::commit() {
  if (cells_done_ != cells_) {
    throw std::logic_error("a sweep of " + std::to_string(cells_) + " cells has " +
                           std::to_string(cells_done_));
  }
  writer_->commit();
}

}  // namespace holdfast::program
