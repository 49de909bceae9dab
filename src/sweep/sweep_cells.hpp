#pragma once

#include <cstdint>

#include "sweep/sweep_plan.hpp"
#include "sweep/tiles/tile_result.hpp"

namespace holdfast::program {

/// Computes the cells of one tile; a cell that diverges or is not admissible is a value among the
/// others. What a cell gets does not depend on its neighbours; its last digits do on the
/// instruction set of the plan's context. Throws Interrupted.
TileResult compute_tile(const SweepPlan& plan, std::int64_t tile);

}  // namespace holdfast::program
