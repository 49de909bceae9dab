#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "holdfast/plant/two_mass.hpp"
#include "holdfast/sweep/sweep_motion.hpp"

namespace holdfast::bench {

/// Motions at τ = 1 ms, r₀ about 0.5 mm; gains, gap, force and start differ from cell to cell.
inline std::vector<SweepMotion> sweep_cells(std::size_t cells = 256) {
  std::vector<SweepMotion> motions;
  for (std::size_t k = 0; k < cells; ++k) {
    const double x = static_cast<double>(k) / static_cast<double>(cells);
    const double y = std::sin(7.0 * static_cast<double>(k));
    motions.push_back({{kollar2022_plant(),
                        {0.001, 0.0},
                        {-557.0 + 20.0 * y, -13.0 + 2.0 * x},
                        {0.5 + 0.1 * y, 9.5 + x},
                        0.0005 * (1.0 + 0.5 * y)},
                       Vector<double, 4>(0.001 * y, 0.0, 0.0, 0.0)});
  }
  return motions;
}

}  // namespace holdfast::bench
