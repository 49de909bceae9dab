#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "case/axes/axis.hpp"
#include "io/text/csv.hpp"

namespace holdfast::program {

struct CaseKey;

/// An axis of a chart or a sweep.
struct GridAxis {
  Column column;
  std::variant<Axis, LogAxis, std::vector<double>> values;

  std::size_t count() const;
  /// Value number `index`, 0 ≤ index < count().
  double at(std::size_t index) const;
};

/// The index along one axis of a cell of their product, cells being numbered with the first axis
/// slowest.
std::size_t index_along(const std::vector<GridAxis>& axes, std::size_t axis, std::size_t cell);

/// An axis over a key of the case, as a table names and describes it; units as N.s/m.
GridAxis grid_axis(const CaseKey& key, const KeyValues& axis);
GridAxis grid_axis(const KeyAxis& axis);

}  // namespace holdfast::program
