#include "jobs/motion/case_motion.hpp"

#include <type_traits>

#include "case/model/modal/modal_plant_of_case.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/motion/modal/modal_motion.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "io/text/text.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"

namespace holdfast::program {
namespace {

static_assert(is_motion_v<CaseMotion>);

template <class Contact>
const SwitchCounts& counts_of(const EventMotion<Contact>& motion) {
  return motion.counts();
}
// Of a motion that switches at samples alone.
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

struct CaseMotion::Model {
  Model() = default;
  Model& operator=(const Model&) = delete;
  virtual ~Model() = default;
  virtual std::unique_ptr<Model> copy() const = 0;
  virtual EventSample sense() = 0;
  virtual void advance() = 0;
  virtual void displace_conductor(double by) = 0;
  virtual std::int64_t index() const = 0;
  virtual double time() const = 0;
  virtual State state() const = 0;
  virtual const SwitchCounts& counts() const = 0;

 protected:
  Model(const Model&) = default;
};

template <class Motion>
struct CaseMotion::ModelOf final : Model {
  explicit ModelOf(const Motion& given) : motion(given) {}
  std::unique_ptr<Model> copy() const override { return std::make_unique<ModelOf>(*this); }

  EventSample sense() override {
    const auto taken = motion.sense();
    EventSample sample;
    sample.index = taken.index;
    sample.time = taken.time;
    sample.state = state();
    sample.control_force = taken.control_force;
    sample.engaged = taken.engaged;
    sample.mode = mode_of(taken);
    return sample;
  }
  void advance() override { motion.advance(); }
  void displace_conductor(double by) override { motion.displace_conductor(by); }
  std::int64_t index() const override { return motion.index(); }
  double time() const override { return motion.time(); }
  State state() const override { return motion.readings().both_sides(motion.state()); }
  const SwitchCounts& counts() const override { return counts_of(motion); }

  Motion motion;
};

CaseMotion::CaseMotion(const Case& the_case, const MotionChoice& choice) {
  const auto take = [&](const auto& motion) {
    model_ = std::make_unique<ModelOf<std::decay_t<decltype(motion)>>>(motion);
  };
  const bool of_paper = is_of_the_paper(the_case, choice.switching);
  if (is_modal(the_case)) {
    if (of_paper)
      take(modal_motion_of(the_case, choice.controlled));
    else
      take(event_motion(conductor_loop_of(the_case, choice), modal_state_of(the_case)));
    return;
  }
  const State state = initial_state_of(the_case);
  if (of_paper) {
    const IdealLoop<double> loop = ideal_loop_of(the_case);
    take(harmonically_forced_motion(choice.controlled ? loop : uncontrolled(loop), state));
    return;
  }
  const ImplementedLoop loop = implemented_loop_of(the_case, choice.switching);
  take(event_motion(choice.controlled ? loop : uncontrolled(loop), state));
}

CaseMotion::CaseMotion(const CaseMotion& other) : model_(other.model_->copy()) {}
CaseMotion::~CaseMotion() = default;

EventSample CaseMotion::sense() { return model_->sense(); }
void CaseMotion::advance() { model_->advance(); }
void CaseMotion::displace_conductor(double by) { model_->displace_conductor(by); }
std::int64_t CaseMotion::index() const { return model_->index(); }
double CaseMotion::time() const { return model_->time(); }
CaseMotion::State CaseMotion::state() const { return model_->state(); }
const SwitchCounts& CaseMotion::counts() const { return model_->counts(); }

namespace {

void require_resolved(const SwitchCounts& counts, double time, bool quiet) {
  if (counts.accumulates) {
    throw NoAnswer("the contact changes more than " + std::to_string(EventMotion<>::most_switches) +
                   " times within one sampling period, at t = " + format_number(time) +
                   " s at the latest: the motion cannot be followed further");
  }
  if (counts.grazing > 0)
    report_warning(
        std::to_string(counts.grazing) +
            " change(s) of contact are decided by rounding: Delta z or its velocity only "
            "touches where the contact would change",
        quiet);
}

}  // namespace

void tell_of_end(const JobContext& context, const MotionEnd& end, bool controlled, double kick) {
  require_resolved(end.counts, end.time, context.quiet);
  report_warning(divergence_warning(context.case_data, controlled, kick, end.time, end.size),
                 context.quiet);
}

}  // namespace holdfast::program
