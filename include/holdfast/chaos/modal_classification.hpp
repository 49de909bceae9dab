#pragma once

#include <optional>
#include <type_traits>
#include <vector>

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

/// The tangent vectors of a conductor given by its modes, as indicators_of_system() requires them.
template <class Scalar>
struct ModalTangents : ModalSpectrum<Scalar> {
  const bool& engaged;

  template <class Loop>
  ModalTangents(const Loop& loop, const bool& transmits)
      : ModalSpectrum<Scalar>(loop), engaged(transmits) {}
  void push(const Vector<Scalar, 5>&) { ModalSpectrum<Scalar>::push(engaged); }
};

}  // namespace detail

/// Classifies the motion of a conductor given by its modes: by the periodic orbit on which it
/// settles or, without one, by its ChaosIndicators and the rules of `classify`. The motion is
/// undecided if two poles of the plant are too close to be separated numerically. Work: that of
/// find_periodic_orbit(), and 200 multiply-adds per NaturalMotion and sample.
/// @param loop           the loop with its excitation and backlash
/// @param initial_state  state [q₁, q̇₁, …, z₂, ż₂] of `modal_plant`; q_n: coordinate of mode n
/// @param limits         longest period (samples) and number of samples of the search for an orbit
/// @throws InvalidParameter where an argument is not admissible
template <class Loop, std::enable_if_t<std::is_same_v<Loop, ModalLoop>, int> = 0>
SampledClassification classify_motion(const Loop& loop, const ModalMotion::Full& initial_state,
                                      const OrbitLimits& limits = {}) {
  validate(loop);
  const std::vector<PlantPole> poles = plant_poles(loop.modes, loop.absorber);
  const std::optional<ModalMotion> motion = modal_motion(loop, poles, initial_state);
  if (!motion) {
    SampledClassification unknown;
    unknown.classification.rests_on =
        "Two natural motions of the plant are too close to be separated.";
    return unknown;
  }
  const auto look = [&](const IndicatorOptions& plan) {
    bool engaged = true;
    detail::ModalTangents<double> tangents(loop, engaged);
    return detail::indicators_of_samples(*motion, plan, engaged, tangents);
  };
  return detail::classify_sampled(loop, find_periodic_orbit(loop, poles, initial_state, limits),
                                  *motion, look);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template SampledClassification classify_motion(const ModalLoop&, const ModalMotion::Full&,
                                                      const OrbitLimits&);
#endif

}  // namespace holdfast
