#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "holdfast/core/axis.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/math/poly/routh_hurwitz.hpp"
#include "holdfast/stability/boundary/root_pair_curve.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"

namespace holdfast {

/// Rectangular grid of the gains P and D. Its cells are ordered row by row: one P per row.
struct GainGrid {
  Axis proportional;  ///< values of the proportional gain P (N/m), one per row
  Axis differential;  ///< values of the differential gain D (N s/m), one per column

  /// The gains of the cell in row `p_index` and column `d_index`, both counted from 0.
  PdGains<double> at(std::int64_t p_index, std::int64_t d_index) const {
    return {proportional.at(p_index), differential.at(d_index)};
  }

  /// The number of cells: number of values of P times number of values of D.
  /// @throws InvalidParameter unless the number is 1 … 10¹⁵
  std::int64_t cells() const {
    require_within(
        "number of cells of a chart",
        static_cast<double>(proportional.count) * static_cast<double>(differential.count), "", 1.0,
        1e15);
    return proportional.count * differential.count;
  }
};

/// Validates a grid. @throws InvalidParameter unless each axis has finite ends with min ≤ max and
/// at least one value, and the grid has at most 10¹⁵ cells
inline void validate(const GainGrid& grid) {
  validate(grid.proportional, "proportional gain P", "N/m");
  validate(grid.differential, "differential gain D", "N s/m");
  grid.cells();
}

/// Computes a stability chart in the plane of P and D row by row; a row has one value of P.
///
/// Stability changes along a row only at its crossings with the stability boundary. The cells
/// between two crossings therefore need one Hurwitz test. Cells within round-off of the boundary
/// count as not stable. The crossing with each monotone arc of `RootPairCurve` is found by Newton's
/// method, which starts from the crossing of the previous row. Crossings with a root 0 or ∞ follow
/// from linear equations for D. For rows of constant D, exchange P and D in the polynomial.
///
/// Work per row: about 40 multiply-adds for each arc and 60 for each interval between crossings,
/// independent of the number of cells.
template <int Degree>
class StabilityRows {
 public:
  /// @param polynomial    characteristic polynomial whose stable roots have Re < 0: that of the
  ///                      continuous loop, or of the sampled loop after `in_half_plane`
  /// @param differential  values of D (N s/m), one for each cell of a row
  StabilityRows(const HalfPlanePolynomial<double, Degree>& polynomial, const Axis& differential)
      : polynomial_(polynomial), differential_(differential), curve_(polynomial) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    for (const MonotoneArc<double>& arc : curve_.arcs())
      branches_.push_back({arc, {unknown, 0.0}, 0.0});
  }

  /// Writes 1 (stable) or 0 (not stable) for each cell of the row at one P, in the order of D.
  /// @param proportional_gain  P (N/m), finite
  /// @param stable             array with one entry for each cell of the row
  void fill(double proportional_gain, std::uint8_t* stable) {
    const Polynomial<double, Degree> row =
        polynomial_.base + proportional_gain * polynomial_.proportional;
    find_crossings(proportional_gain);
    std::int64_t first = 0;
    for (const RowCrossing<double>& crossing : crossings_) {
      const auto& [value, uncertainty] = crossing;
      const std::int64_t on_it = differential_.first_not_below(value - uncertainty);
      const std::int64_t beyond_it = differential_.first_above(value + uncertainty);
      const std::int64_t before = std::max(first, on_it), after = std::max(before, beyond_it);
      fill_gap(row, first, before, stable);
      std::fill(stable + before, stable + after, std::uint8_t{0});
      first = after;
    }
    fill_gap(row, first, differential_.count, stable);
  }

 private:
  using Part = Vector<double, 3> ParityParts<double>::*;

  struct Branch {
    MonotoneArc<double> arc;
    RootPairCurve<double>::Place place;  // on the previous row
    double proportional_gain;            // P (N/m) of the previous row
  };

  /// Finds a row's crossings with the boundary, ascending in D: at most one per arc and per line.
  void find_crossings(double proportional_gain) {
    crossings_.clear();
    add_line(proportional_gain, &ParityParts<double>::even, 0);
    constexpr auto leading =
        Degree % 2 == 0 ? &ParityParts<double>::even : &ParityParts<double>::odd;
    add_line(proportional_gain, leading, 2);
    for (Branch& branch : branches_) {
      if (!branch.arc.passes(proportional_gain)) continue;
      const double change = proportional_gain - branch.proportional_gain;
      branch.place = curve_.place(branch.arc, proportional_gain,
                                  branch.place.square + branch.place.square_per_gain * change);
      branch.proportional_gain = proportional_gain;
      add(curve_.crossing(proportional_gain, branch.place.square));
    }
    std::sort(crossings_.begin(), crossings_.end(),
              [](const auto& a, const auto& b) { return a.differential < b.differential; });
  }

  void add(const RowCrossing<double>& crossing) {
    if (std::isfinite(crossing.differential)) crossings_.push_back(crossing);
  }

  /// Adds the D at which coefficient k of the even or odd part is 0, if it depends on D.
  void add_line(double proportional_gain, Part part, int k) {
    const double slope = (curve_.differential().*part)[k];
    if (slope == 0.0) return;
    const double base = (curve_.base().*part)[k];
    const double term = proportional_gain * (curve_.proportional().*part)[k];
    add({-(base + term) / slope,
         curve_.rounding * (std::abs(base) + std::abs(term)) / std::abs(slope)});
  }

  /// Fills the cells between two crossings; a Hurwitz test of the middle cell decides for all.
  void fill_gap(const Polynomial<double, Degree>& row, std::int64_t first, std::int64_t last,
                std::uint8_t* stable) const {
    if (first >= last) return;
    const double d = differential_.at(first + (last - first) / 2);
    const bool inside = is_hurwitz<double, Degree + 1>(row + d * polynomial_.differential);
    std::fill(stable + first, stable + last, static_cast<std::uint8_t>(inside));
  }

  HalfPlanePolynomial<double, Degree> polynomial_;
  Axis differential_;
  RootPairCurve<double> curve_;
  std::vector<Branch> branches_;
  std::vector<RowCrossing<double>> crossings_;
};

/// The stability chart of a grid: 1 (stable) or 0 (not stable) for each cell, row by row.
/// @param polynomial  `characteristic_polynomial` of the continuous or the sampled loop, with or
///                    without `in_half_plane`; not `PolynomialVariable::about_centre`
/// @param grid        grid of gains
/// @throws InvalidParameter where a coefficient is not finite or the grid is not admissible
template <int Degree, PolynomialVariable Variable,
          class = decltype(in_half_plane(
              std::declval<const AffinePolynomial<double, Degree, Variable>&>()))>
std::vector<std::uint8_t> stability_chart(
    const AffinePolynomial<double, Degree, Variable>& polynomial, const GainGrid& grid) {
  validate(polynomial);
  validate(grid);
  std::vector<std::uint8_t> stable(static_cast<std::size_t>(grid.cells()));
  StabilityRows<Degree> rows(in_half_plane(polynomial), grid.differential);
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
