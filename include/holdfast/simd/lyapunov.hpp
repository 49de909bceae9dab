#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "holdfast/chaos/itinerary_blocks.hpp"
#include "holdfast/chaos/lyapunov_run.hpp"
#include "holdfast/control/loop_input.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/excitation/forcing.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/simd/lyapunov_group.hpp"
#include "holdfast/simd/pack.hpp"
#include "holdfast/simd/parallel_rows.hpp"

namespace holdfast::simd {

namespace detail {

template <class Forcing>
std::vector<LyapunovResult> lyapunov_spectra(const MotionFamily<Forcing>& family,
                                             const std::shared_ptr<const ItineraryBlocks>& blocks,
                                             const std::vector<Vector<double, 4>>& initial_states,
                                             const LyapunovRun& run, int threads) {
  using Group = LyapunovGroup<MotionFamily<Forcing>>;
  std::vector<LyapunovResult> results(initial_states.size());
  parallel_rows(static_cast<std::int64_t>(initial_states.size()),
                static_cast<std::int64_t>(lanes_of_group), threads, Group(family, blocks, run),
                [&](Group& group, std::int64_t first, std::int64_t count) {
                  group.compute(initial_states.data() + first, static_cast<std::size_t>(count),
                                results.data() + first);
                });
  return results;
}

}  // namespace detail

/// The Lyapunov exponents of one loop along the motions from many initial states, several a
/// register and on several threads.
///
///     const auto results = simd::lyapunov_spectra(loop, states, {100000, 1000});
///
/// Each is that of `run_lyapunov` along its motion but for rounding. Where f τ = p/q, the forcing
/// is exactly periodic.
/// @param loop              the loop with its excitation and backlash
/// @param initial_states    each [z₁, ż₁, z₂, ż₂] (m, m/s, m, m/s)
/// @param run               how long, and with what accuracy, each is averaged
/// @param tangent_sampling  sampling of the loop whose S and S* are the tangents
/// @param threads           ≥ 1, or 0 for all cores; the results do not depend on it
/// @return in the order of the initial states
/// @throws InvalidParameter where `loop`, `run` or `tangent_sampling` is not admissible
inline std::vector<LyapunovResult> lyapunov_spectra(
    const IdealLoop<double>& loop, const std::vector<Vector<double, 4>>& initial_states,
    const LyapunovRun& run, const Sampling<double>& tangent_sampling, int threads = 0) {
  validate(loop);
  validate(run);
  validate(tangent_sampling);
  const SampledLoop<double> sampled = sampled_loop(loop.plant, loop.sampling);
  const auto blocks = std::make_shared<const ItineraryBlocks>(
      sampled_loop(loop.plant, tangent_sampling), loop.gains);
  const HarmonicInput<double> input =
      harmonic_input(loop.plant, sampled, loop.hold, loop.excitation.angular_frequency());
  if (const auto ratio = forcing_ratio(loop)) {
    using Forcing = PeriodicForcing<double>;
    const detail::MotionFamily<Forcing> family{sampled, loop,
                                               Forcing(input, loop.excitation.amplitude, *ratio)};
    return detail::lyapunov_spectra(family, blocks, initial_states, run, threads);
  }
  using Forcing = HarmonicForcing<double>;
  const detail::MotionFamily<Forcing> family{sampled, loop,
                                             Forcing(input, loop.excitation, loop.sampling.period)};
  return detail::lyapunov_spectra(family, blocks, initial_states, run, threads);
}

/// The same with the tangents of the motion itself.
inline std::vector<LyapunovResult> lyapunov_spectra(
    const IdealLoop<double>& loop, const std::vector<Vector<double, 4>>& initial_states,
    const LyapunovRun& run, int threads = 0) {
  return lyapunov_spectra(loop, initial_states, run, loop.sampling, threads);
}

}  // namespace holdfast::simd
