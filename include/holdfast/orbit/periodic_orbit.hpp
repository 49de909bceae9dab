#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "holdfast/core/rational.hpp"
#include "holdfast/math/linalg/multipliers.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/orbit/cyclic_system.hpp"
#include "holdfast/orbit/itinerary_maps.hpp"
#include "holdfast/orbit/loop_orbit.hpp"
#include "holdfast/orbit/switching_borders.hpp"

namespace holdfast {

/// A periodic motion of the sampled loop with backlash. It is the periodic solution for a given
/// itinerary, the sequence of contacts at the samples. The outcome of the search states whether the
/// backlash rule, applied along this solution, gives the same itinerary.
struct PeriodicOrbit : LoopOrbit<5> {
  Itinerary itinerary;            ///< contact at each sample of a period: 1 engaged, 0 backlash
  BacklashMemory<double> memory;  ///< memory of the backlash law before the first sample
  Borders borders;                ///< nearest gap end and nearest reversal, with their distances

  /// The share, 0 … 1, of the samples at which the drive transmits its force.
  double engaged_fraction() const {
    const auto engaged = std::count(itinerary.begin(), itinerary.end(), std::uint8_t{1});
    return static_cast<double>(engaged) / static_cast<double>(itinerary.size());
  }

  /// The least distance from a switching surface, relative to the orbit's size. The distance of Δz
  /// is divided by the largest displacement, that of Δż by the largest velocity. +∞: no surface.
  double border_share() const {
    const StateScale extent(states);
    return std::min(extent.share_of_displacement(borders.displacement.distance),
                    extent.share_of_velocity(borders.velocity.distance));
  }
};

/// The result of a search for a periodic orbit of a loop that switches at its samples.
using OrbitResult = OrbitResultOf<PeriodicOrbit>;

/// The periodic solution of a loop whose contacts are those of a given itinerary in every period.
/// @tparam Maps  ItineraryMaps or ModalItineraryMaps
template <class Maps>
struct PeriodicSolution {
  /// The observed part of a state, z̃ = [z; u_{j−1}]: z = [z₁, ż₁, z₂, ż₂] and the last command.
  using Seen = std::decay_t<decltype(std::declval<Maps>().seen(std::declval<Maps>().rest()))>;

  typename Maps::State first;  ///< state at the first sample
  std::vector<Seen> states;    ///< observed states z̃_j = [z_j; u_{j−1}], one for each sample
  /// Closure error ‖z_N − z₀‖ after one period from z₀ (z in m and m/s).
  typename Seen::Scalar closure_error;
  /// Estimated error of z̃₀ due to the closure error, relative to the largest values (StateScale).
  double state_error;
};

namespace detail {

/// The periodic solution: one Newton step from rest, then two steps of iterative refinement.
/// @param correction  function from the closure error of a state to the correction of that state
template <class Maps, class Correction>
PeriodicSolution<Maps> refined_solution(const Maps& maps, const Itinerary& itinerary,
                                        const Correction& correction) {
  PeriodicSolution<Maps> solution;
  solution.first = maps.rest();
  solution.states.resize(itinerary.size());
  typename Maps::State open = maps.rest(), change = open;
  for (int turn = 0; turn < 4; ++turn) {
    solution.first += change;
    open = maps.follow(solution.first, itinerary, solution.states) - solution.first;
    change = correction(open);
  }
  solution.closure_error = maps.seen(open).template head<4>().norm();
  solution.state_error = StateScale(solution.states).share_of(maps.seen(change));
  return solution;
}

}  // namespace detail

/// The fallback of periodic_solution() where maps_of_blocks() is empty. This default has no
/// solution (nullopt); an overload for ModalItineraryMaps solves for a drive that never transmits.
template <class Maps>
std::optional<PeriodicSolution<Maps>> solution_without_blocks(const Maps&, const Itinerary&) {
  return std::nullopt;
}

/// Computes the periodic solution, z̃_N = z̃₀, of an itinerary by (I − M) z̃₀ = g. M is the product
/// of the period's maps, g the state after one period from z̃₀ = 0. Two refinement steps follow.
/// @param maps       maps of the loop
/// @param itinerary  contacts of N samples, N a multiple of q (f τ = p/q), the first at phase 0
/// @param blocks     maps_of_blocks() of the itinerary
/// @return nullopt where 1 is a multiplier to working precision: there is then no periodic solution
///         or a continuum of them. Also nullopt where `blocks` is empty
template <class Maps>
std::optional<PeriodicSolution<Maps>> periodic_solution(
    const Maps& maps, const Itinerary& itinerary, const std::vector<typename Maps::Map>& blocks) {
  if (blocks.empty()) return solution_without_blocks(maps, itinerary);
  const typename Maps::System system(blocks);
  if (system.is_singular()) return std::nullopt;
  return detail::refined_solution(maps, itinerary, [&](const typename Maps::State& open) {
    const typename Maps::State scaled = open.cwiseQuotient(maps.units());
    return typename Maps::State(maps.units().cwiseProduct(system.correction(scaled)));
  });
}

/// The five Floquet multipliers of a two-mass loop over one period, from its maps_of_blocks().
template <class Scalar>
std::vector<Multiplier> multipliers_of(const ItineraryMaps<Scalar>&, const Itinerary&,
                                       const std::vector<Matrix<Scalar, 5>>& blocks) {
  return multipliers_of_product(blocks);
}

/// Computes the periodic solution of an itinerary. Then applies the backlash law along the solution
/// and compares the resulting contacts with the itinerary.
/// @param loop       the loop with its excitation
/// @param ratio      value of forcing_ratio(loop)
/// @param maps       maps of the same loop and ratio
/// @param itinerary  contacts of N ≥ 1 samples, N a multiple of q, the first one at phase 0
/// @param law        backlash law with its memory before the first sample
/// @return outcome `certified` if the contacts agree, even for a repelling orbit; otherwise
///         `on_surface`, `not_reproduced`, or `none_found` without an orbit
/// Work for two masses: about 500 multiply-adds per sample. Memory: about 70 bytes per sample.
/// @tparam Loop  IdealLoop, with ItineraryMaps, or ModalLoop, with ModalItineraryMaps
template <class Loop, class Maps, class Scalar>
OrbitResult orbit_of_itinerary(const Loop& loop, const Rational& ratio, const Maps& maps,
                               const Itinerary& itinerary, const Backlash<Scalar>& law) {
  const std::vector<typename Maps::Map> blocks = maps_of_blocks(maps, itinerary);
  auto solution = periodic_solution(maps, itinerary, blocks);
  if (!solution) return {};
  const SwitchingPattern pattern = switching_pattern(solution->states, law);
  PeriodicOrbit orbit{{ratio, loop.sampling.period, std::move(solution->states),
                       multipliers_of(maps, itinerary, blocks), solution->closure_error},
                      itinerary,
                      pattern.memory,
                      {}};
  orbit.borders = borders_of(pattern, orbit.states, loop.backlash_width);
  const bool touches = detail::touches_surface(StateScale(orbit.states), solution->state_error,
                                               std::abs(orbit.borders.displacement.distance),
                                               std::abs(orbit.borders.velocity.distance));
  return {detail::outcome_of(touches, has_itinerary(pattern, itinerary)), std::move(orbit)};
}

/// The comparison of an orbit with its recomputation by verify_orbit() in a number type `Precise`.
struct OrbitVerification {
  bool same_itinerary = false;  ///< whether the solution in `Precise` has the orbit's itinerary
  double displacement_difference =
      std::numeric_limits<double>::infinity();  ///< largest difference of z₁ or z₂ at a sample (m)
  double velocity_difference =
      std::numeric_limits<double>::infinity();  ///< largest difference of ż₁ or ż₂ (m/s)
  double closure_error = std::numeric_limits<double>::infinity();  ///< ‖z_N − z₀‖ in `Precise` (SI)
};

/// Recomputes an orbit, including all matrix exponentials, from its itinerary in type `Precise`.
///
///     verify_orbit<long double>(loop, orbit).same_itinerary
///
/// @param loop   the loop that the orbit was found for
/// @param orbit  certified orbit of that loop
/// @return the comparison; the differences are infinite where no unique solution is found
template <class Precise>
OrbitVerification verify_orbit(const IdealLoop<double>& loop, const PeriodicOrbit& orbit) {
  const ItineraryMaps<Precise> maps(converted<Precise>(loop), orbit.ratio);
  const auto solution =
      periodic_solution(maps, orbit.itinerary, maps_of_blocks(maps, orbit.itinerary));
  if (!solution) return {};
  const BacklashMemory<double>& memory = orbit.memory;
  const Backlash<Precise> law(Precise(loop.backlash_width),
                              {memory.inside, Precise(memory.lower), Precise(memory.upper),
                               Precise(memory.previous_velocity)});
  StateScale largest;
  for (std::size_t j = 0; j < orbit.states.size(); ++j)
    largest.include(
        Vector<Precise, 5>(solution->states[j] - orbit.states[j].template cast<Precise>()));
  return {has_itinerary(switching_pattern(solution->states, law), orbit.itinerary),
          largest.displacement, largest.velocity, static_cast<double>(solution->closure_error)};
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template std::optional<PeriodicSolution<ItineraryMaps<double>>> periodic_solution(
    const ItineraryMaps<double>&, const Itinerary&, const std::vector<Matrix<double, 5>>&);
extern template OrbitResult orbit_of_itinerary(const IdealLoop<double>&, const Rational&,
                                               const ItineraryMaps<double>&, const Itinerary&,
                                               const Backlash<double>&);
#endif

}  // namespace holdfast
