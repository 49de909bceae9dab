#pragma once

#include <functional>
#include <vector>

#include "holdfast/control/sampling_clock.hpp"
#include "holdfast/motion/modal/modal_motion.hpp"
#include "holdfast/plant/plant_poles.hpp"
#include "holdfast/sweep/event_metrics.hpp"
#include "holdfast/sweep/motion_metrics.hpp"

namespace holdfast {

/// The metrics (MotionMetrics) of one motion of a conductor given by its modes. Here z₁ is the
/// conductor's displacement at the absorber. Work: that of ModalMotion.
/// @param loop      the loop with its excitation and backlash; it is not validated
/// @param poles     all `plant_poles` of the loop's modes and absorber
/// @param state     initial state [q₁, q̇₁, …, z₂, ż₂] of `modal_plant`; q_n: coordinate of mode n
/// @param duration  length of the motion (s), ≥ 0
/// @param pause     function pause(), called every 2¹⁴ samples; may throw to stop
/// @throws InvalidParameter where the duration or the sampling is not admissible
inline MotionMetrics modal_metrics(const ModalLoop& loop, const std::vector<PlantPole>& poles,
                                   const ModalMotion::Full& state, double duration,
                                   const std::function<void()>& pause = {}) {
  const detail::SampleSpan span =
      detail::sample_span(0, duration, SamplingClock(loop.sampling.period, {}));
  ModalMotion motion(loop, poles, state);
  return detail::metrics_of_motion(motion, span, pause);
}

}  // namespace holdfast
