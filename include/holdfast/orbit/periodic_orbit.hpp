#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "holdfast/core/rational.hpp"
#include "holdfast/math/linalg/multipliers.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/orbit/itinerary_maps.hpp"
#include "holdfast/orbit/loop_orbit.hpp"
#include "holdfast/orbit/periodic_solution.hpp"
#include "holdfast/orbit/switching_borders.hpp"

namespace holdfast {

/// A periodic motion of the sampled loop with backlash, solved exactly for its itinerary
/// and found to reproduce it: the certificate of a periodic motion.
struct PeriodicOrbit : LoopOrbit<5> {
  Itinerary itinerary;            ///< of one period, N samples
  BacklashMemory<double> memory;  ///< of the drive before the first sample
  Borders borders;                ///< the switching surfaces that it comes nearest to

  /// Share of the samples at which the drive transmits.
  double engaged_fraction() const {
    const auto engaged = std::count(itinerary.begin(), itinerary.end(), std::uint8_t{1});
    return static_cast<double>(engaged) / static_cast<double>(itinerary.size());
  }

  /// Its distance from the nearest switching surface as a share of its own size; infinite where it
  /// comes to none.
  double border_share() const {
    const StateScale extent(states);
    return std::min(extent.share_of_displacement(borders.displacement.distance),
                    extent.share_of_velocity(borders.velocity.distance));
  }
};

/// An itinerary with its solution, verified or not.
using OrbitCandidate = OrbitCandidateOf<PeriodicOrbit>;

namespace detail {

/// Whether the orbit comes so near to a surface that rounding may decide.
/// @param state_error  of the states, as a share of their extent
inline bool touches_surface(const PeriodicOrbit& orbit, double state_error) {
  const SurfaceRounding rounding = surface_rounding(StateScale(orbit.states), state_error);
  return std::abs(orbit.borders.displacement.distance) <= rounding.displacement ||
         std::abs(orbit.borders.velocity.distance) <= rounding.velocity;
}

template <class Scalar>
std::vector<Matrix<Scalar, 5>> maps_of(const std::vector<AffineMap<Scalar>>& blocks) {
  std::vector<Matrix<Scalar, 5>> maps;
  maps.reserve(blocks.size());
  for (const auto& block : blocks) maps.push_back(block.map);
  return maps;
}

}  // namespace detail

/// Solves for the orbit of an itinerary and verifies it.
///
/// @param loop       the loop with its excitation
/// @param ratio      of forcing_ratio(loop)
/// @param maps       of the same loop and ratio
/// @param itinerary  N samples, N ≥ 1 a multiple of q, the first one at phase 0 of the forcing
/// @param law        the backlash before the first sample, as the motion that led here left it
/// Work: about 500 multiply-adds a sample; memory about 70 bytes a sample.
/// @tparam Scalar  `double`; a template so that only who calls it compiles it
template <class Scalar>
OrbitCandidate orbit_of_itinerary(const IdealLoop<Scalar>& loop, const Rational& ratio,
                                  const ItineraryMaps<Scalar>& maps, const Itinerary& itinerary,
                                  const Backlash<Scalar>& law) {
  const std::vector<AffineMap<Scalar>> blocks = affine_blocks(maps, itinerary);
  auto solution = periodic_solution(maps, itinerary, condensed_boundary(blocks));
  if (!solution) return {CandidateOutcome::singular, std::nullopt};
  const SwitchingPattern pattern = switching_pattern(solution->states, law);
  PeriodicOrbit orbit{{ratio, loop.sampling.period, std::move(solution->states),
                       multipliers_of_product(detail::maps_of(blocks)), solution->closure_error},
                      itinerary,
                      pattern.memory,
                      {}};
  orbit.borders = borders_of(pattern, orbit.states, loop.backlash_width);
  const auto outcome = detail::touches_surface(orbit, solution->state_error)
                           ? CandidateOutcome::on_surface
                       : has_itinerary(pattern, itinerary) ? CandidateOutcome::verified
                                                           : CandidateOutcome::other_itinerary;
  return {outcome, std::move(orbit)};
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template OrbitCandidate orbit_of_itinerary(const IdealLoop<double>&, const Rational&,
                                                  const ItineraryMaps<double>&, const Itinerary&,
                                                  const Backlash<double>&);
#endif

}  // namespace holdfast
