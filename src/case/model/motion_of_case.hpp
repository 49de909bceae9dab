#pragma once

#include <string>

#include "case/model/loop_of_case.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "holdfast/motion/modal/modal_motion.hpp"
#include "io/text/text.hpp"
#include "jobs/motion/motion_run.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/job_context.hpp"

namespace holdfast::program {

/// Calls `visit` with the motion of a case of two masses from its initial state: the stepper of the
/// paper's model where that is all there is to the case, else an EventMotion.
template <class Visit>
auto with_two_mass_motion_of(const Case& the_case, const MotionChoice& choice, const Visit& visit) {
  const Vector<double, 4> state = initial_state_of(the_case);
  if (is_of_the_paper(the_case, choice.switching)) {
    const IdealLoop<double> loop = ideal_loop_of(the_case);
    return visit(harmonically_forced_motion(choice.controlled ? loop : uncontrolled(loop), state));
  }
  const ImplementedLoop loop = implemented_loop_of(the_case, choice.switching);
  return visit(event_motion(choice.controlled ? loop : uncontrolled(loop), state));
}

/// The event-driven motion of a modal case, as conductor and absorber at its place show it: states
/// are [z1, v1, z2, v2].
class MotionAtAbsorber {
 public:
  using Motion = EventMotion<DriveContact<ControlledPlant>>;

  explicit MotionAtAbsorber(const Motion& motion) : motion_(motion) {}

  EventSample sense() {
    const auto full = motion_.sense();
    EventSample sample;
    sample.index = full.index;
    sample.time = full.time;
    sample.state = motion_.readings().both_sides(full.state);
    sample.control_force = full.control_force;
    sample.engaged = full.engaged;
    sample.mode = full.mode;
    return sample;
  }
  void advance() { motion_.advance(); }
  void displace_conductor(double by) { motion_.displace_conductor(by); }

  std::int64_t index() const { return motion_.index(); }
  double time() const { return motion_.time(); }
  Vector<double, 4> state() const { return motion_.readings().both_sides(motion_.state()); }
  PortReadings<TwoMass<double>> readings() const { return {}; }
  const Motion& motion() const { return motion_; }

 private:
  Motion motion_;
};

/// The motion of a modal case in the paper's model, of which alone a kick has a shape; without
/// control of any.
/// Throws NoAnswer where two natural motions of it cannot be told apart.
inline ModalMotion modal_motion_of(const Case& the_case, bool controlled) {
  ModalLoop loop = modal_loop_of(the_case);
  if (!controlled) loop.sampling.processing_delay = 0.0;
  static_cast<void>(conductor_with_absorber_of(the_case));
  return *modal_motion(controlled ? loop : uncontrolled(loop),
                       modal_state(loop.modes, initial_state_of(the_case)));
}

/// The same of any plant: of a modal case a ModalMotion, else a MotionAtAbsorber. What it visits
/// has states [z1, v1, z2, v2].
template <class Visit>
auto with_motion_of(const Case& the_case, const MotionChoice& choice, const Visit& visit) {
  if (!is_modal(the_case)) return with_two_mass_motion_of(the_case, choice, visit);
  if (is_of_the_paper(the_case, choice.switching))
    return visit(modal_motion_of(the_case, choice.controlled));
  return visit(MotionAtAbsorber(
      event_motion(conductor_loop_of(the_case, choice), modal_state_of(the_case))));
}

/// Throws WrongInput where the conductor itself is to be displaced in its motion and the motion is
/// not of the paper's model.
inline void require_displaceable(const Case& the_case, Switching switching,
                                 const std::string& option) {
  if (!is_modal(the_case) || is_of_the_paper(the_case, switching)) return;
  throw WrongInput(option + " goes with " + modal_words(the_case) +
                   " in the paper's model alone: switching at samples, its law of the backlash, "
                   "one harmonic, an ideal computer and drive");
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

inline void require_resolved(const MotionAtAbsorber& motion, bool quiet) {
  require_resolved(motion.motion(), quiet);
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
