#pragma once

#ifndef __EMSCRIPTEN__
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>
#endif

#include <algorithm>
#include <cstdint>

#include "holdfast/core/compiler.hpp"

namespace holdfast::simd {

/// Computes the rows of a chart on several threads. A tile is a group of successive rows that one
/// thread computes. In a browser a single thread computes all tiles in turn.
///
/// Tiles begin at multiples of `tile`, and each has its own copy of `kernel`. The results therefore
/// do not depend on the number of threads. An exception thrown in a tile is rethrown to the caller.
/// @param rows     number of rows, ≥ 0
/// @param tile     number of rows of a tile, ≥ 1; the last tile may have fewer
/// @param threads  number of threads ≥ 1, or 0 for one per core of the machine
/// @param kernel   working object of `compute`, for instance its buffers; copied for each tile
/// @param compute  called for each tile as compute(copy of kernel, first row, number of rows)
template <class Kernel, class Compute>
void parallel_rows(std::int64_t rows, std::int64_t tile, int threads, const Kernel& kernel,
                   const Compute& compute) {
  const std::int64_t tiles = (rows + tile - 1) / tile;
  const auto do_tile = [&](std::int64_t index) {
    Kernel own = kernel;
    compute(own, index * tile, std::min(tile, rows - index * tile));
  };
#ifdef __EMSCRIPTEN__
  (void)threads;
  for (std::int64_t index = 0; index < tiles; ++index) do_tile(index);
#else
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, tiles),
                      [&](const tbb::blocked_range<std::int64_t>& range) {
                        for (std::int64_t index = range.begin(); index < range.end(); ++index)
                          do_tile(index);
                      });
  });
#endif
}

}  // namespace holdfast::simd
