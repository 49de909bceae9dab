#pragma once

#include <optional>
#include <type_traits>

#include "holdfast/chaos/chaos_indicators.hpp"
#include "holdfast/chaos/lyapunov_spectrum.hpp"
#include "holdfast/chaos/modal_lyapunov.hpp"
#include "holdfast/chaos/motion_classification.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/modal/modal_motion.hpp"
#include "holdfast/motion/modal/natural_motions.hpp"
#include "holdfast/orbit/modal/modal_orbit_search.hpp"
#include "holdfast/plant/plant_poles.hpp"

namespace holdfast {

namespace detail {

/// The indicators of the motion of a conductor by its modes, from what conductor and absorber show.
/// @tparam Loop  ModalLoop
template <class Loop>
ChaosIndicators indicators_of_motion(const Loop& loop, ModalMotion motion,
                                     const IndicatorOptions& options) {
  ModalSpectrum tangent(NaturalMotions(loop, plant_poles(loop.modes, loop.absorber)), loop.gains,
                        loop.sampling.processing_delay > 0.0);
  bool engaged = true, counted = false;
  const auto seen = [&] {
    Vector<double, 5> state;
    state << motion.state(), motion.memory().previous_force;
    return state;
  };
  const auto advance = [&](Vector<double, 5>& state) {
    engaged = motion.sense().engaged;
    motion.advance();
    state = seen();
  };
  const auto take_tangent = [&](const Vector<double, 5>&, bool counts) {
    if (counts && !counted) tangent.restart();
    counted = counts;
    tangent.push(engaged);
  };
  ChaosIndicators indicators = indicators_of_system<5>(
      seen(), advance, [](const Vector<double, 5>& state) { return state[0]; }, options,
      take_tangent, [&] { return engaged; });
  if (!indicators.diverged_at) indicators.largest_exponent = largest_exponent(tangent.spectrum());
  return indicators;
}

}  // namespace detail

/// Says what the motion of a conductor by its modes is, as classify_motion() of an IdealLoop does;
/// undecided where its natural motions are not all found.
/// @param loop           with its excitation and backlash
/// @param initial_state  of `modal_plant`, [q₁, q̇₁, …, z₂, ż₂]
/// @param limits         of the search for an orbit
/// Work: that of find_periodic_orbit(), and 0.2 million multiply-adds a natural motion for each
/// thousand samples that are looked at.
/// @throws InvalidParameter where one of them is not admissible
/// @tparam Loop  ModalLoop; a template so that only who calls it compiles it
template <class Loop, std::enable_if_t<std::is_same_v<Loop, ModalLoop>, int> = 0>
SampledClassification classify_motion(const Loop& loop, const ModalMotion::Full& initial_state,
                                      const OrbitLimits& limits = {}) {
  const std::optional<ModalMotion> motion = modal_motion(loop, initial_state);
  if (!motion) {
    SampledClassification unknown;
    unknown.classification.rests_on = "Two natural motions of the plant cannot be told apart.";
    return unknown;
  }
  SampledClassification found;
  found.search = find_periodic_orbit(loop, initial_state, limits);
  if (detail::is_decided_by_search(found, "it reproduces its own contacts")) return found;
  IndicatorOptions options =
      detail::indicator_options(loop.excitation.frequency * loop.sampling.period);
  options.forcing_incommensurate = found.search.outcome == OrbitOutcome::incommensurate;
  const auto look = [&](const IndicatorOptions& plan) {
    return std::optional(detail::indicators_of_motion(loop, *motion, plan));
  };
  detail::weigh(found, *motion, options, {loop.excitation.amplitude > 0.0}, look);
  return found;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template SampledClassification classify_motion(const ModalLoop&, const ModalMotion::Full&,
                                                      const OrbitLimits&);
#endif

}  // namespace holdfast
