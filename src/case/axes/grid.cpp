#include "case/axes/grid.hpp"

#include <string>

#include "case/case_keys.hpp"

namespace holdfast::program {
namespace {

std::string table_unit(std::string unit) {
  std::replace(unit.begin(), unit.end(), ' ', '.');
  return unit;
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

std::size_t index_along(const std::vector<GridAxis>& axes, std::size_t axis, std::size_t cell) {
  for (std::size_t faster = axes.size() - 1; faster > axis; --faster) cell /= axes[faster].count();
  return cell % axes[axis].count();
}

GridAxis grid_axis(const CaseKey& key, const KeyValues& axis) {
  return {{key.name, table_unit(key.unit), key.description}, axis.values};
}

GridAxis grid_axis(const KeyAxis& axis) {
  return grid_axis(*find_case_key(axis.key), {axis.key, axis.axis});
}

}  // namespace holdfast::program
