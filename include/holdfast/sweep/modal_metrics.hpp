#pragma once

#include <functional>
#include <vector>

#include "holdfast/control/sampling_clock.hpp"
#include "holdfast/motion/modal/modal_motion.hpp"
#include "holdfast/plant/plant_poles.hpp"
#include "holdfast/sweep/event_metrics.hpp"
#include "holdfast/sweep/motion_metrics.hpp"

namespace holdfast {

/// The metrics of sweep/motion_metrics.hpp for one motion of a conductor by its modes, z and z₂
/// being the conductor at the absorber and the absorber. Work: that of ModalMotion.
/// @param loop      of which nothing is checked
/// @param poles     all of `plant_poles` of its modes and absorber
/// @param state     the initial one, of `modal_plant`
/// @param duration  s, ≥ 0
/// @param pause     called every 2¹⁴ samples; may throw to end the motion
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
