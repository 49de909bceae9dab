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

/// An axis over a key of the case, as a table names and describes it; units as N.s/m.
GridAxis grid_axis(const CaseKey& key, const KeyValues& axis);
GridAxis grid_axis(const KeyAxis& axis);

}  // namespace holdfast::program
