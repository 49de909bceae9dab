#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
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

/// What a chart tells of every cell: a real number, or yes or no.
struct GridColumn {
  Column column;
  /// For flags what 0 and 1 mean, one word each: "unstable stable"; "" for real numbers.
  std::string flag_meanings = {};

  bool holds_flags() const { return !flag_meanings.empty(); }
};

/// The values of one column along the fast axis, as many as that has: flags (0 or not) or reals.
using GridValues = std::variant<const std::uint8_t*, const double*>;

/// What a chart over two axes is made of.
struct GridLayout {
  GridAxis slow;
  GridAxis fast;
  std::vector<GridColumn> columns;
};

/// One way in which a chart becomes a file: its rows, those of the slow axis, in ascending order.
/// The rows it is given agree with the layout.
class GridWriter {
 public:
  virtual ~GridWriter() = default;
  GridWriter(const GridWriter&) = delete;
  GridWriter& operator=(const GridWriter&) = delete;
  GridWriter(GridWriter&&) = delete;
  GridWriter& operator=(GridWriter&&) = delete;

  virtual void append_row(const std::vector<GridValues>& row) = 0;
  virtual void commit() = 0;

 protected:
  GridWriter() = default;
};

}  // namespace holdfast::program
