#pragma once

#include <algorithm>
#include <cstdint>

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

}  // namespace holdfast::program
