#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "holdfast/phase_space/basins.hpp"
#include "holdfast/simd/pack.hpp"
#include "holdfast/simd/parallel_rows.hpp"

namespace holdfast::simd {

/// Finds the attractor of each initial state by `holdfast::find_basins`, with SIMD and threads.
///
///     const BasinMap map = simd::find_basins(loop, states);
///     for (const auto& attractor : map.attractors) use(attractor.orbit.period());
///
/// @param loop            sampled loop with its excitation and backlash
/// @param initial_states  list of finite states [z₁, ż₁, z₂, ż₂] (m, m/s, m, m/s); may be empty
/// @param limits          longest period and number of samples of each search for a periodic orbit
/// @param threads         number of threads ≥ 1, or 0 for all cores; no effect on the result
/// @throws InvalidParameter where loop, states or limits are not admissible
inline BasinMap find_basins(const IdealLoop<double>& loop,
                            const std::vector<Vector<double, 4>>& initial_states,
                            const OrbitLimits& limits = {}, int threads = 0) {
  const auto for_tiles = [threads](std::size_t count, std::size_t tile, const auto& job) {
    parallel_rows(static_cast<std::int64_t>(count), static_cast<std::int64_t>(tile), threads, 0,
                  [&job](int&, std::int64_t first, std::int64_t number) {
                    job(static_cast<std::size_t>(first), static_cast<std::size_t>(number));
                  });
  };
  return holdfast::find_basins<Pack<double>>(loop, initial_states, limits, for_tiles);
}

}  // namespace holdfast::simd
