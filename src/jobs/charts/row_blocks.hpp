#pragma once

#include <algorithm>
#include <cstdint>

#include "process/interrupt.hpp"
#include "process/progress.hpp"
#ifdef HOLDFAST_HAS_SIMD
#include "holdfast/simd/parallel_rows.hpp"
#endif

namespace holdfast::program {

#ifdef HOLDFAST_HAS_SIMD
using simd::parallel_rows;
#else
/// Without oneTBB: the same tiles one after the other.
template <class Kernel, class Compute>
void parallel_rows(std::int64_t rows, std::int64_t tile, int, const Kernel& kernel,
                   const Compute& compute) {
  for (std::int64_t first = 0; first < rows; first += tile) {
    Kernel own = kernel;
    compute(own, first, std::min(tile, rows - first));
  }
}
#endif

/// Rows that a thread takes at a time. It depends on the chart alone, as the results may not depend
/// on the number of threads.
inline std::int64_t rows_of_tile(std::int64_t columns) { return columns <= 65536 ? 32 : 8; }

/// Rows that are held in memory: many tiles, so that no thread waits long for the last one, but no
/// more than some tens of megabytes where rows are of a usual length.
inline std::int64_t rows_of_block(std::int64_t columns) {
  const std::int64_t tiles = (std::int64_t{1} << 21) / (columns * rows_of_tile(columns));
  return rows_of_tile(columns) * std::clamp(tiles, std::int64_t{1}, std::int64_t{16});
}

/// Does the rows of a chart block by block: `compute(kernel, first, count, offset)` on many
/// threads, `offset` being the first row's place in the block, then `drain(first, count)` on this
/// one. Throws Interrupted.
template <class Kernel, class Compute, class Drain>
void for_row_blocks(std::int64_t rows, std::int64_t columns, int threads, Progress& progress,
                    const Kernel& kernel, const Compute& compute, const Drain& drain) {
  for (std::int64_t block = 0; block < rows; block += rows_of_block(columns)) {
    throw_if_interrupted();
    const std::int64_t count = std::min(rows_of_block(columns), rows - block);
    parallel_rows(count, rows_of_tile(columns), threads, kernel,
                  [&](Kernel& own, std::int64_t first, std::int64_t tile) {
                    if (!interrupted()) compute(own, block + first, tile, first);
                  });
    throw_if_interrupted();
    drain(block, count);
    progress.advance(static_cast<std::uint64_t>(count));
  }
}

}  // namespace holdfast::program
