#pragma once

#include <cstdint>

#include <string>

#include "sweep/sweep_plan.hpp"
#include "sweep/tiles/tile_result.hpp"

namespace holdfast::program {

/// Computes the cells of one tile; a cell that diverges or is not admissible is a value among the
/// others. What a cell gets does not depend on its neighbours. Throws Interrupted.
TileResult compute_tile(const SweepPlan& plan, std::int64_t tile);

/// The instruction set for which that was compiled, on which the last digits of a cell depend:
/// "sse2", "avx512f".
std::string arithmetic();

}  // namespace holdfast::program
