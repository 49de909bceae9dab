#pragma once

#include <cstdint>
#include <vector>

#include "holdfast/core/axis.hpp"
#include "holdfast/stability/affine_polynomial.hpp"
#include "holdfast/stability/mobius_zhukovsky.hpp"
#include "holdfast/stability/routh_hurwitz.hpp"

namespace holdfast {

/// A rectangle of gains: P slowest, D fastest.
struct GainGrid {
  Axis proportional;  ///< P (N/m)
  Axis differential;  ///< D (N s/m)

  PdGains<double> at(std::int64_t p_index, std::int64_t d_index) const {
    return {proportional.at(p_index), differential.at(d_index)};
  }
};

/// Calls `visit(gains, stable)` for every cell of the grid, P slowest; nothing is stored.
///
/// Work per cell: one affine polynomial (2 (Degree + 1) multiply-adds) and Hurwitz's
/// conditions.
/// @param polynomial  in a variable whose stable half-plane is Re < 0:
/// `characteristic_polynomial(plant)`
///                    for the continuous loop, the same of the sampled loop after `in_half_plane`
template <int Degree, class Visitor>
void visit_stability_chart(const AffinePolynomial<double, Degree>& polynomial, const GainGrid& grid,
                           Visitor&& visit) {
  for (std::int64_t i = 0; i < grid.proportional.count; ++i) {
    for (std::int64_t j = 0; j < grid.differential.count; ++j) {
      const PdGains<double> gains = grid.at(i, j);
      Polynomial<double, Degree> p = polynomial.at(gains);
      if (p[Degree] < 0) p = -p;
      visit(gains, hurwitz_conditions<double, Degree + 1>(p).satisfied());
    }
  }
}

/// Stable (true) or not, for every cell of the grid, P slowest.
template <int Degree>
std::vector<bool> stability_chart(const AffinePolynomial<double, Degree>& polynomial,
                                  const GainGrid& grid) {
  std::vector<bool> stable;
  stable.reserve(static_cast<std::size_t>(grid.proportional.count * grid.differential.count));
  visit_stability_chart(polynomial, grid,
                        [&stable](const PdGains<double>&, bool cell) { stable.push_back(cell); });
  return stable;
}

}  // namespace holdfast
