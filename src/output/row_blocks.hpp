#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "case/job_context.hpp"
#include "process/interrupt.hpp"
#include "process/progress.hpp"

#ifdef HOLDFAST_HAS_SIMD
#include "holdfast/simd/parallel_rows.hpp"
#endif

namespace holdfast::program {

#ifdef HOLDFAST_HAS_SIMD
using simd::parallel_rows;
#else
/// Replacement of simd::parallel_rows in a build without oneTBB: computes the tiles one by one.
template <class Kernel, class Compute>
void parallel_rows(std::int64_t rows, std::int64_t tile, int, const Kernel& kernel,
                   const Compute& compute) {
  for (std::int64_t first = 0; first < rows; first += tile) {
    Kernel own = kernel;
    compute(own, first, std::min(tile, rows - first));
  }
}
#endif

/// Calls `compute(i)` for i = 0 … count − 1 in parallel on the job's threads. Each call is a step
/// of the job's progress. Throws Interrupted, and the exceptions of `compute`.
template <class Compute>
void side_by_side(const JobContext& context, const std::string& job, std::int64_t count,
                  const Compute& compute) {
  Progress progress(static_cast<std::uint64_t>(count), job, progress_wanted(context));
  parallel_rows(count, 1, context.threads, 0, [&](int&, std::int64_t i, std::int64_t) {
    if (interrupted()) return;
    compute(i);
    progress.advance();
  });
  throw_if_interrupted();
}

/// Function that distributes tiles of states or cells to threads, the `for_tiles` of the library.
inline auto tiles_on(const JobContext& context) {
  return [&context](std::size_t count, std::size_t tile, const auto& job) {
    parallel_rows(static_cast<std::int64_t>(count), static_cast<std::int64_t>(tile),
                  context.threads, 0, [&](int&, std::int64_t first, std::int64_t number) {
                    throw_if_interrupted();
                    job(static_cast<std::size_t>(first), static_cast<std::size_t>(number));
                  });
  };
}

}  // namespace holdfast::program
