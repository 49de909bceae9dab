#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "holdfast/control/loop_map.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/stability/boundary/circle_crossings.hpp"
#include "holdfast/stability/chart/chart.hpp"

namespace holdfast {

/// Stable (1) or not (0) for every cell of a grid of gains, of a loop of any order; P slowest.
///
/// A row of constant P changes its stability only at its `circle_crossings`; the eigenvalues of the
/// map decide each gap between them. Of the two masses `stability_chart` of the characteristic
/// polynomial says the same a thousand times as fast.
/// @param map   the loop
/// @param grid  of gains
/// @throws InvalidParameter where the grid is not admissible
template <class Scalar>
std::vector<std::uint8_t> stability_chart(const LoopMap<Scalar>& map, const GainGrid& grid) {
  validate(grid);
  const std::int64_t width = grid.differential.count;
  std::vector<std::uint8_t> stable(static_cast<std::size_t>(grid.cells()));
  for (std::int64_t i = 0; i < grid.proportional.count; ++i) {
    const PdGains<Scalar> row{Scalar(grid.proportional.at(i)), Scalar(0)};
    for (const auto& interval : stable_gains(map, FreeGain::differential, row)) {
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
extern template std::vector<std::uint8_t> stability_chart(const LoopMap<double>&, const GainGrid&);
#endif

}  // namespace holdfast
