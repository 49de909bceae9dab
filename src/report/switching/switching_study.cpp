#include "report/switching/switching_study.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "case/model/loop_of_case.hpp"
#include "case/model/moving_loop.hpp"
#include "holdfast/chaos/classification.hpp"
#include "holdfast/motion/dense_output.hpp"
#include "holdfast/motion/instant.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "holdfast/orbit/event/event_orbit.hpp"
#include "jobs/motion/case_motion.hpp"
#include "jobs/motion/motion_run.hpp"
#include "jobs/orbit/certified_orbit.hpp"
#include "output/row_blocks.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

ImplementedLoop loop_of(const StudiedLoop& studied) {
  ImplementedLoop loop = implemented_loop_of(studied.the_case, studied.reading.switching);
  loop.digital.hold = studied.reading.hold;
  return loop;
}

EventMotion<> motion_of(const StudiedLoop& studied) {
  return event_motion(loop_of(studied), initial_state_of(studied.the_case));
}

/// Whether a state is beyond the divergence_bound() of its loop, as one without a number is.
bool is_beyond(const Vector<double, 4>& state, double bound) {
  return !(state.cwiseAbs().maxCoeff() < bound);
}

/// Counts how often each mode begins.
class ModeCounter {
 public:
  explicit ModeCounter(const EventMotion<>& motion) : motion_(&motion) {}

  /// From here on they count. Call before the sample is taken.
  void start() {
    started_ = true;
    before_ = motion_->counts().entered;
  }

  /// A motion that switches at samples counts no modes itself.
  void take(const EventSample& sample) {
    if (started_ && sample.mode != mode_) ++at_samples_[static_cast<std::size_t>(sample.mode)];
    mode_ = sample.mode;
  }

  std::array<double, 3> counts() const {
    std::array<double, 3> counts{};
    for (std::size_t k = 0; k < counts.size(); ++k) {
      const bool sampled = !motion_->contact().changes_between_samples();
      counts[k] =
          static_cast<double>(sampled ? at_samples_[k] : motion_->counts().entered[k] - before_[k]);
    }
    return counts;
  }

 private:
  const EventMotion<>* motion_;
  bool started_ = false;
  ContactMode mode_ = ContactMode::engaged;
  std::array<std::int64_t, 3> at_samples_{}, before_{};
};

/// F (N), in the sample that the motion has just left behind.
double transmitted_force(const EventMotion<>& motion, ContactMode mode, const ContactInstant& now) {
  if (mode == ContactMode::gap && motion.contact().changes_between_samples()) return 0.0;
  if (mode != ContactMode::stick) return now.command;
  // Force that keeps Δż at zero: the acceleration that the plant would have without a force, over
  // that per newton of it.
  const int gap = static_cast<int>(ContactMode::gap);
  const AffineDynamics& free = motion.dynamics(gap);
  const AffineDynamics& engaged = motion.dynamics(static_cast<int>(ContactMode::engaged));
  const double acceleration = velocity_row().dot(free.state * now.state + free.force * now.force);
  return -acceleration / velocity_row().dot(engaged.command);
}

/// Collects a window of a motion, sample by sample.
class WindowRecorder {
 public:
  WindowRecorder(double begin, double end, int instants)
      : window_{begin, end, {}, {}}, count_(instants) {}

  /// Takes the motion since a sample.
  template <class Trace>
  void take(const EventMotion<>& motion, const Trace& trace, const EventSample& sample,
            double previous_command) {
    for (const auto& part : trace.parts()) {
      const double begin = std::max(sample.time + part.begin, window_.begin);
      const double end = std::min(sample.time + part.begin + part.length, window_.end);
      if (begin < end) add_phase({begin, end, part.mode});
    }
    const double delay = motion.loop().sampling.processing_delay;
    for (; next_ < count_ && next_time() < motion.time(); ++next_) {
      const double after = std::max(next_time() - sample.time, 0.0);
      const double command = after < delay ? previous_command : motion.previous_command();
      const ContactInstant now{trace.state(after), command, motion.force().at(after)};
      window_.instants.push_back(
          {next_time(), now.state, command, transmitted_force(motion, trace.mode(after), now)});
    }
  }

  MotionWindow window() && { return std::move(window_); }

 private:
  double next_time() const {
    return window_.begin + (window_.end - window_.begin) * next_ / (count_ - 1);
  }

  void add_phase(const ContactPhase& phase) {
    if (!window_.phases.empty() && window_.phases.back().mode == phase.mode)
      window_.phases.back().end = phase.end;
    else
      window_.phases.push_back(phase);
  }

  MotionWindow window_;
  int count_, next_ = 0;
};

StudiedLoop without_control(Case the_case, double duration) {
  the_case.control.proportional_gain = the_case.control.differential_gain = 0.0;
  the_case.control.proportional_gain_tuned = false;
  the_case.backlash.law = "none";
  return {the_case, readings[exact_switching], duration};
}

}  // namespace

SteadyMotion steady_motion(const StudiedLoop& studied) {
  EventMotion<> motion = motion_of(studied);
  const double bound = divergence_bound(studied.the_case, 0.0);
  SteadyMotion steady;
  EventOrbitMeasures measures(motion);
  ModeCounter counter(motion);
  const double half = 0.5 * studied.duration;
  const std::int64_t samples =
      samples_within(studied.duration, studied.the_case.control.sampling_period);
  bool is_steady = false;
  double largest = 0.0;
  for (std::int64_t j = 0; j < samples; ++j) {
    throw_if_interrupted();  // at each: a stiff plant takes a millisecond a sample
    if (!is_steady && not_before(motion.time(), half)) {
      is_steady = true;
      counter.start();
    }
    const EventSample sample = motion.sense();
    steady.diverges = is_beyond(sample.state, bound);
    steady.accumulates = motion.counts().accumulates;
    if (steady.diverges || steady.accumulates) return steady;
    counter.take(sample);
    if (is_steady) largest = std::max(largest, std::abs(sample.state[0]));
    if (j + 1 == samples) break;
    measures.begin();
    is_steady ? motion.advance(measures) : motion.advance();
  }
  steady.largest_of_samples = largest;
  steady.largest_displacement = std::max(largest, measures.largest_displacement());
  const double half_cycles = motion.loop().force.harmonics.front().frequency * studied.duration;
  for (std::size_t k = 0; k < 3; ++k)
    steady.phases_per_half_cycle[k] = counter.counts()[k] / half_cycles;
  return steady;
}

FoundPeriod period_of(const StudiedLoop& studied) {
  JobContext context;
  context.quiet = true;
  context.case_data = studied.the_case;
  context.case_data.excitation.hold = studied.reading.hold_word();
  try {
    const auto period = [&](const auto& moving) -> FoundPeriod {
      const auto orbit = certified_orbit(context, moving, longest_studied_period);
      return {attractor_type_text(AttractorType::periodic, orbit.period_samples()),
              orbit.period_samples(), orbit.forcing_periods(), orbit.period(),
              orbit.largest_multiplier()};
    };
    return std::visit(period, moving_loop_of(context.case_data, {studied.reading.switching}));
  } catch (const NoAnswer& reason) {
    FoundPeriod failed;
    failed.verdict = reason.what();
    return failed;
  }
}

std::int64_t shortest_period(const StudiedLoop& studied) {
  const auto ratio = forcing_ratio(loop_of(studied).digital);
  return ratio ? ratio->denominator : 0;
}

std::vector<StudiedMotion> study(const std::vector<StudiedLoop>& loops, int threads) {
  std::vector<StudiedMotion> motions(loops.size());
  parallel_rows(static_cast<std::int64_t>(loops.size()), 1, threads, 0,
                [&](int, std::int64_t first, std::int64_t) {
                  const auto k = static_cast<std::size_t>(first);
                  motions[k] = {loops[k], steady_motion(loops[k]), period_of(loops[k])};
                });
  return motions;
}

MotionWindow window_of(const StudiedLoop& studied, double begin, double end, int instants) {
  EventMotion<> motion = motion_of(studied);
  const double bound = divergence_bound(studied.the_case, 0.0);
  DenseOutput trace(motion);
  WindowRecorder recorder(begin, end, instants);
  while (motion.time() <= end) {
    throw_if_interrupted();
    const double previous_command = motion.previous_command();
    const EventSample sample = motion.sense();
    if (is_beyond(sample.state, bound)) throw NoAnswer("the motion diverges");
    if (motion.counts().accumulates) throw NoAnswer("the contact changes too often to follow");
    const bool seen = sample.time + motion.period() > begin;
    if (!seen) {
      motion.advance();
      continue;
    }
    trace.begin();
    motion.advance(trace);
    recorder.take(motion, trace, sample, previous_command);
  }
  return std::move(recorder).window();
}

double swing_without_control(const Case& the_case, double duration) {
  CaseMotion motion(motion_without_control(the_case, duration));
  double largest = 0.0;
  for (; motion.time() < duration; motion.advance()) {
    const EventSample sample = motion.sense();
    if (not_before(motion.time(), 0.5 * duration))
      largest = std::max(largest, std::abs(relative_displacement(sample.state)));
  }
  return 2.0 * largest;
}

double amplitude_without_control(const Case& the_case, double duration) {
  return steady_motion(without_control(the_case, duration)).largest_displacement;
}

}  // namespace holdfast::program
