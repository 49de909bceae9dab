#include "jobs/design/best_gains.hpp"

#include <algorithm>
#include <cmath>

#include "case/case_keys.hpp"
#include "case/model/linear_loop.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/sweep/sweep_motion.hpp"
#include "jobs/design/gain_margins.hpp"
#include "jobs/motion/cell_motion.hpp"
#include "process/interrupt.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

constexpr double noticeable = 1.05;      // of what the play adds
constexpr double settled_within = 20.0;  // s, twice the time that a motion is given to settle

bool have_one_answer(const IdealLoop<double>& one, const IdealLoop<double>& other) {
  return numbers_of(one.plant) == numbers_of(other.plant) &&
         one.sampling.period == other.sampling.period &&
         one.sampling.processing_delay == other.sampling.processing_delay &&
         one.gains.proportional == other.gains.proportional &&
         one.excitation.frequency == other.excitation.frequency && one.hold == other.hold;
}

AmplitudeOptions settling_within(double duration, const Sampling<double>& sampling,
                                 ForceHold hold) {
  return {sampling, hold, std::exp(-10.0 * sampling.period / duration), usual_margin, true, true};
}

}  // namespace

AmplitudeOptions amplitude_options_of(const Case& the_case, std::optional<double> largest_radius,
                                      std::optional<double> margin) {
  return {sampling_of(the_case),
          force_hold_of(the_case),
          largest_radius.value_or(1.0),
          margin.value_or(largest_radius ? 0.0 : usual_margin),
          true,
          is_two_masses(the_case)};
}

const MinimumAmplitude& BestGains::of(const IdealLoop<double>& loop) {
  // Neighbours in a sweep often differ in nothing that the gain depends on.
  if (!known_ || !have_one_answer(*known_, loop)) {
    answer_ = minimum_amplitude(loop.plant, settling_within(duration_, loop.sampling, loop.hold),
                                loop.excitation.frequency, loop.gains.proportional);
    known_ = loop;
  }
  return answer_;
}

MinimumAmplitude BestGains::of(const Case& the_case) const {
  const AmplitudeOptions options =
      is_two_masses(the_case)
          ? settling_within(duration_, sampling_of(the_case), force_hold_of(the_case))
          : amplitude_options_of(the_case);
  return LinearLoop(the_case).quietest(options, excitation_of(the_case).frequency,
                                       gains_of(the_case).proportional);
}

std::string play_warning(const Case& the_case, const PdGains<double>& gains, double ideal,
                         InstructionSet set) {
  const auto& backlash = the_case.backlash;
  if (!is_of_masses(motion_kind_of(the_case, Switching::sampled)) || !(backlash.width > 0.0) ||
      backlash.law == "none" || !std::isfinite(gains.differential) ||
      !(excitation_of(the_case).amplitude > 0.0))
    return "";
  const double duration = std::min(settled_within, end_of_force(the_case));
  const Case there = case_with(case_with(the_case, "control.proportional_gain", gains.proportional),
                               "control.differential_gain", gains.differential);
  require_bearable(2.0 * duration / the_case.control.sampling_period);
  const auto metrics = metrics_of(
      {cell_motion(there, Switching::sampled, duration), motion_without_control(there, duration)},
      duration, set);
  const double left = metrics[0].steady_peak / metrics[1].steady_peak;
  if (left <= noticeable * ideal) return "";
  return "D = " + format_rounded(gains.differential) + " N s/m leaves the share " +
         format_rounded(ideal) + " of the vibration if there is no play, but " +
         format_rounded(left) + " with the case's play of " + format_rounded(backlash.width) +
         " m, computed over " + format_rounded(duration) + " s";
}

MaxDelayOptions tuned_delay_question(const Case& the_case, double frequency) {
  MaxDelayOptions question;
  question.watch = throw_if_interrupted;
  question.criterion = DelayCriterion::attenuates;
  question.hold = force_hold_of(the_case);
  question.relative_to_true_force = true;
  question.delay_fraction = the_case.control.processing_delay / the_case.control.sampling_period;
  question.frequency = frequency;
  question.proportional_gain =
      has_own_plant(the_case) ? gains_of(the_case).proportional
                              : tuned_proportional_gain(the_case.plant.absorber_stiffness,
                                                        the_case.plant.absorber_mass, frequency);
  return question;
}

}  // namespace holdfast::program
