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

/// Classifies the motion of a conductor given by its modes, like classify_motion() of an IdealLoop;
/// undecided where two of the plant's natural motions cannot be separated numerically.
/// @param loop           the loop with its excitation and backlash
/// @param initial_state  state of `modal_plant`, [q₁, q̇₁, …, z₂, ż₂]
/// @param limits         limits of the search for an orbit
/// Work: that of find_periodic_orbit(), and 0.2 million multiply-adds per natural motion and
/// thousand samples examined.
/// @throws InvalidParameter where an argument is not admissible
template <class Loop, std::enable_if_t<std::is_same_v<Loop, ModalLoop>, int> = 0>
SampledClassification classify_motion(const Loop& loop, const ModalMotion::Full& initial_state,
                                      const OrbitLimits& limits = {}) {
  const std::optional<ModalMotion> motion = modal_motion(loop, initial_state);
  if (!motion) {
    SampledClassification unknown;
    unknown.classification.rests_on = "Two natural motions of the plant cannot be told apart.";
    return unknown;
  }
  const auto look = [&](const IndicatorOptions& plan) {
    bool engaged = true;
    detail::ModalTangents<double> tangents(loop, engaged);
    return detail::indicators_of_samples(*motion, plan, engaged, tangents);
  };
  return detail::classify_sampled(loop, find_periodic_orbit(loop, initial_state, limits), *motion,
                                  look);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template SampledClassification classify_motion(const ModalLoop&, const ModalMotion::Full&,
                                                      const OrbitLimits&);
#endif

}  // namespace holdfast
