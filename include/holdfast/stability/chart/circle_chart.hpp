#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "holdfast/core/interval.hpp"
#include "holdfast/stability/boundary/resolved_circle.hpp"
#include "holdfast/stability/chart/chart.hpp"

namespace holdfast {

/// Stable (1) or not (0) for every cell of a grid of gains, of a loop of any order; P slowest.
///
/// The stable intervals of D of each row, by `ResolvedCircle`. Of the two masses `stability_chart`
/// of the characteristic polynomial says the same a hundred times as fast.
/// @param circle  of the loop
/// @param grid    of gains
/// @throws InvalidParameter where the grid is not admissible
template <class Scalar>
std::vector<std::uint8_t> stability_chart(const ResolvedCircle<Scalar>& circle,
                                          const GainGrid& grid) {
  validate(grid);
  const std::int64_t width = grid.differential.count;
  std::vector<std::uint8_t> stable(static_cast<std::size_t>(grid.cells()));
  for (std::int64_t i = 0; i < grid.proportional.count; ++i) {
    const PdGains<Scalar> row{Scalar(grid.proportional.at(i)), Scalar(0)};
    for (const auto& interval : circle.stable_gains(FreeGain::differential, row)) {
      const std::int64_t first = grid.differential.first_above(static_cast<double>(interval.lower));
      const std::int64_t last =
          grid.differential.first_not_below(static_cast<double>(interval.upper));
      if (first < last)
        std::fill(stable.begin() + (i * width + first), stable.begin() + (i * width + last),
                  std::uint8_t{1});
    }
  }
  return stable;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template std::vector<std::uint8_t> stability_chart(const ResolvedCircle<double>&,
                                                          const GainGrid&);
#endif

}  // namespace holdfast
