#include "jobs/motion/motion_run.hpp"

#include "io/text/text.hpp"
#include "process/errors.hpp"

namespace holdfast::program {

void refuse_diverging(double time) {
  throw NoAnswer("the motion diverges: it leaves the range of numbers at t = " +
                 format_number(time) + " s; a shorter --duration shows how it grows");
}

void require_completed(TrajectoryOutcome outcome, double time) {
  if (outcome == TrajectoryOutcome::diverged) refuse_diverging(time);
}

}  // namespace holdfast::program
