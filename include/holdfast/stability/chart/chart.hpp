#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "holdfast/core/axis.hpp"
#include "holdfast/math/poly/routh_hurwitz.hpp"
#include "holdfast/stability/boundary/row_crossings.hpp"
#include "holdfast/stability/polynomial/affine_polynomial.hpp"

namespace holdfast {

/// A rectangle of gains: P slowest, D fastest.
struct GainGrid {
  Axis proportional;  ///< P (N/m)
  Axis differential;  ///< D (N s/m)

  /// The gains of a cell, each index from 0 to one less than the count of its axis.
  PdGains<double> at(std::int64_t p_index, std::int64_t d_index) const {
    return {proportional.at(p_index), differential.at(d_index)};
  }

  /// Number of cells, values of P times values of D.
  std::int64_t cells() const { return proportional.count * differential.count; }
};

/// Rows of the chart of stable gains, each of a fixed P.
///
/// Along a row stability changes only where it crosses the boundary (`RowCrossings`), so a row
/// costs its few crossings, one Hurwitz test in each gap between them and the filling of memory. A
/// cell that round-off cannot tell from the boundary is not stable.
///
/// Work per row: about 40 multiply-adds for each arc of the boundary and 60 for each gap, whatever
/// the number of cells.
template <int Degree>
class StabilityRows {
 public:
  /// @param polynomial    in a variable whose stable half-plane is Re < 0:
  /// `characteristic_polynomial(plant)` for the continuous loop, that of the sampled loop after
  /// `in_half_plane`
  /// @param differential  the cells of a row
  StabilityRows(const AffinePolynomial<double, Degree>& polynomial, const Axis& differential)
      : polynomial_(polynomial), differential_(differential), crossings_(polynomial) {}

  /// Writes 1 (stable) or 0 for every cell of the row.
  /// @param proportional_gain  P (N/m), finite
  /// @param stable             as many entries as the row has cells
  void fill(double proportional_gain, std::uint8_t* stable) {
    const Polynomial<double, Degree> row =
        polynomial_.base + proportional_gain * polynomial_.proportional;
    std::int64_t first = 0;
    for (const RowCrossing<double>& crossing : crossings_.at(proportional_gain)) {
      const auto [before, after] = cells_about(crossing, first);
      fill_gap(row, first, before, stable);
      std::fill(stable + before, stable + after, std::uint8_t{0});
      first = after;
    }
    fill_gap(row, first, differential_.count, stable);
  }

 private:
  /// Index of the first cell on the crossing and of the first one beyond it.
  std::pair<std::int64_t, std::int64_t> cells_about(const RowCrossing<double>& crossing,
                                                    std::int64_t first) const {
    const double value = crossing.differential, uncertainty = crossing.uncertainty;
    const std::int64_t before = std::max(first, differential_.first_not_below(value - uncertainty));
    return {before, std::max(before, differential_.first_above(value + uncertainty))};
  }

  /// No boundary passes between these cells: the middle one stands for all.
  void fill_gap(const Polynomial<double, Degree>& row, std::int64_t first, std::int64_t last,
                std::uint8_t* stable) const {
    if (first >= last) return;
    const double d = differential_.at(first + (last - first) / 2);
    const bool inside = is_hurwitz<double, Degree + 1>(row + d * polynomial_.differential);
    std::fill(stable + first, stable + last, static_cast<std::uint8_t>(inside));
  }

  AffinePolynomial<double, Degree> polynomial_;
  Axis differential_;
  RowCrossings<double, Degree> crossings_;
};

/// Stable (1) or not (0) for every cell of the grid, P slowest.
template <int Degree>
std::vector<std::uint8_t> stability_chart(const AffinePolynomial<double, Degree>& polynomial,
                                          const GainGrid& grid) {
  std::vector<std::uint8_t> stable(static_cast<std::size_t>(grid.cells()));
  StabilityRows<Degree> rows(polynomial, grid.differential);
  for (std::int64_t i = 0; i < grid.proportional.count; ++i) {
    rows.fill(grid.proportional.at(i), stable.data() + i * grid.differential.count);
  }
  return stable;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template class StabilityRows<4>;
extern template class StabilityRows<5>;
#endif

}  // namespace holdfast
