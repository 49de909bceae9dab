#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "holdfast/core/axis.hpp"
#include "holdfast/core/log_axis.hpp"
#include "io/text/csv.hpp"

namespace holdfast::program {

/// An axis of a chart or a sweep.
struct GridAxis {
  Column column;
  std::variant<Axis, LogAxis, std::vector<double>> values;

  std::size_t count() const;
  /// Value number `index`, 0 ≤ index < count().
  double at(std::size_t index) const;
};

}  // namespace holdfast::program
