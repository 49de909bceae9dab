#include "jobs/motion/case_motion.hpp"

#include "holdfast/motion/trajectory.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

static_assert(is_motion_v<CaseMotion>);

template <class Contact>
const SwitchCounts& counts_of(const EventMotion<Contact>& motion) {
  return motion.counts();
}
// Counts of a motion that switches at samples alone.
template <class Motion>
const SwitchCounts& counts_of(const Motion&) {
  static const SwitchCounts none;
  return none;
}

template <int States>
ContactMode mode_of(const EventSampleOf<States>& sample) {
  return sample.mode;
}
ContactMode mode_of(const MotionSample<double>& sample) {
  return sample.engaged ? ContactMode::engaged : ContactMode::gap;
}

}  // namespace

CaseMotion::CaseMotion(const MovingLoop& moving)
    : motion_(
          std::visit([](const auto& one) { return decltype(motion_)(motion_of(one)); }, moving)) {}
CaseMotion::CaseMotion(const Case& the_case, const MotionChoice& choice)
    : CaseMotion(moving_loop_of(the_case, choice)) {}

EventSample CaseMotion::sense() {
  EventSample sample;
  std::visit(
      [&](auto& motion) {
        const auto taken = motion.sense();
        sample.index = taken.index;
        sample.time = taken.time;
        sample.control_force = taken.control_force;
        sample.engaged = taken.engaged;
        sample.mode = mode_of(taken);
      },
      motion_);
  sample.state = state();
  return sample;
}

void CaseMotion::advance() {
  std::visit([](auto& motion) { motion.advance(); }, motion_);
}
void CaseMotion::displace_conductor(double by) {
  std::visit([&](auto& motion) { motion.displace_conductor(by); }, motion_);
}
std::int64_t CaseMotion::index() const {
  return std::visit([](const auto& motion) -> std::int64_t { return motion.index(); }, motion_);
}
double CaseMotion::time() const {
  return std::visit([](const auto& motion) { return motion.time(); }, motion_);
}
CaseMotion::State CaseMotion::state() const {
  return std::visit(
      [](const auto& motion) -> State { return motion.readings().both_sides(motion.state()); },
      motion_);
}
const SwitchCounts& CaseMotion::counts() const {
  return std::visit([](const auto& motion) -> const SwitchCounts& { return counts_of(motion); },
                    motion_);
}

namespace {

void require_resolved(const SwitchCounts& counts, double time, bool quiet) {
  if (counts.accumulates) {
    throw NoAnswer("the contact of the drive changes more than " +
                   std::to_string(EventMotion<>::most_switches) +
                   " times within one sampling period, before t = " + format_number(time) +
                   " s: the motion ends there; give a shorter duration");
  }
  if (counts.grazing > 0)
    report_warning(std::to_string(counts.grazing) +
                       " change(s) of contact depend on rounding errors, since z2 - z1 or v2 - v1 "
                       "only touches its switching threshold; compare a slightly changed case",
                   quiet);
}

}  // namespace

void tell_of_end(const JobContext& context, const ReachedState& end, bool controlled, double kick) {
  require_resolved(end.counts, end.time, context.quiet);
  report_warning(divergence_warning(context.case_data, controlled, kick, end.time, end.size),
                 context.quiet);
}

}  // namespace holdfast::program
