#include "report/page/vibration.hpp"

#include <algorithm>
#include <cmath>

#include "case/model/linear_loop.hpp"
#include "case/model/plant_of_case.hpp"
#include "jobs/motion/cell_motion.hpp"

namespace holdfast::program {
namespace {

double steady_peak_without_control(const Case& the_case, InstructionSet set) {
  const double duration = duration_of(the_case);
  const MovingLoop alone = motion_without_control(the_case, duration);
  return metrics_of({alone}, duration, set).front().steady_peak;
}

}  // namespace

double duration_of(const Case& the_case) { return std::min(20.0, end_of_force(the_case)); }

Question question_about(const Case& the_case, InstructionSet set) {
  constexpr double motions = 150.0;  // that the answers compare
  require_bearable(motions * duration_of(the_case) / the_case.control.sampling_period);
  return {the_case, set, motion_of_the_case(the_case), steady_peak_without_control(the_case, set),
          LinearLoop(the_case).radius(gains_of(the_case))};
}

std::vector<LoopVibration> vibrations_of(const std::vector<Case>& cases, const Question& question,
                                         Switching switching) {
  const double duration = duration_of(cases.front());
  std::vector<MovingLoop> motions;
  motions.reserve(cases.size());
  for (const Case& the_case : cases) motions.push_back(cell_motion(the_case, switching, duration));
  std::vector<LoopVibration> vibrations;
  vibrations.reserve(cases.size());
  for (const MotionMetrics& metrics : metrics_of(motions, duration, question.set))
    vibrations.push_back(
        {metrics.steady_peak, question.free, metrics.engaged_fraction, metrics.force_peak});
  return vibrations;
}

}  // namespace holdfast::program
