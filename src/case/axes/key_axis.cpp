#include "case/axes/key_axis.hpp"

#include <algorithm>
#include <string>

namespace holdfast::program {
namespace {

std::string table_unit(std::string unit) {
  std::replace(unit.begin(), unit.end(), ' ', '.');
  return unit;
}

}  // namespace

GridAxis grid_axis(const CaseKey& key, const KeyValues& axis) {
  return {{key.name, table_unit(key.unit), key.description}, axis.values};
}

GridAxis grid_axis(const KeyAxis& axis) {
  return grid_axis(*find_case_key(axis.key), {axis.key, axis.axis});
}

}  // namespace holdfast::program
