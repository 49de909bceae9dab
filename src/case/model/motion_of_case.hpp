#pragma once

#include <string>

#include "case/model/loop_of_case.hpp"
#include "io/text/text.hpp"
#include "jobs/motion/motion_run.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/job_context.hpp"

namespace holdfast::program {

/// A case as the motion sees it, with the switching that was asked for and with or without control.
struct MotionChoice {
  Switching switching = Switching::sampled;
  bool controlled = true;
};

/// Calls `visit` with the motion of the case from its initial state: the stepper of the paper's
/// model where that is all there is to the case, else an EventMotion.
template <class Visit>
auto with_motion_of(const Case& the_case, const MotionChoice& choice, Visit&& visit) {
  const Vector<double, 4> state = initial_state_of(the_case);
  if (is_of_the_paper(the_case, choice.switching)) {
    const IdealLoop<double> loop = ideal_loop_of(the_case);
    return visit(harmonically_forced_motion(choice.controlled ? loop : uncontrolled(loop), state));
  }
  const ImplementedLoop loop = implemented_loop_of(the_case, choice.switching);
  return visit(event_motion(choice.controlled ? loop : uncontrolled(loop), state));
}

/// Throws NoAnswer where a motion's changes of contact accumulate, so that it is not to be trusted;
/// warns where rounding decided some of them.
template <class Motion>
void require_resolved(const Motion&, bool) {}

template <class Contact>
void require_resolved(const EventMotion<Contact>& motion, bool quiet) {
  const SwitchCounts& counts = motion.counts();
  if (counts.accumulates) {
    throw NoAnswer("the contact changes more than " +
                   std::to_string(EventMotion<Contact>::most_switches) +
                   " times within one sampling period, at t = " + format_number(motion.time()) +
                   " s at the latest: the motion cannot be followed further");
  }
  if (counts.grazing > 0)
    report_warning(
        std::to_string(counts.grazing) +
            " change(s) of contact are decided by rounding: Delta z or its velocity only "
            "touches where the contact would change",
        quiet);
}

/// At the end of a motion: what require_resolved() says of it, and a warning where it diverges, as
/// a motion within the range of numbers may too.
/// @param kick  displacement on its way, m
template <class Motion>
void tell_of_end(const JobContext& context, const Motion& motion, bool controlled = true,
                 double kick = 0.0) {
  require_resolved(motion, context.quiet);
  const double size = motion.state().cwiseAbs().maxCoeff();
  report_warning(divergence_warning(context.case_data, controlled, kick, motion.time(), size),
                 context.quiet);
}

}  // namespace holdfast::program
