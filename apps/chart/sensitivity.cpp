#include "holdfast/stability/sensitivity/sensitivity.hpp"

#include <cmath>

#include "case/case_keys.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/design/max_delay.hpp"
#include "holdfast/stability/polynomial/loop_polynomial.hpp"
#include "holdfast/stability/sensitivity/amplitude_sensitivity.hpp"
#include "holdfast/stability/sensitivity/max_delay_sensitivity.hpp"
#include "holdfast/stability/sensitivity/minimum_radius_sensitivity.hpp"
#include "job.hpp"
#include "jobs/charts/names.hpp"
#include "jobs/design/case_sensitivity.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

/// One answer, its unit, and how it moves.
struct Sensitivities {
  std::string name, unit;
  double value;
  LoopSensitivity sensitivity;
};

/// The loop and the excitation that the answers are about.
struct Question {
  TwoMass<double> plant;
  Sampling<double> sampling;
  PdGains<double> gains;
  double frequency;
  ForceHold hold;
};

void add_radius(const Question& q, std::vector<Sensitivities>& answers) {
  const double excess = loop_polynomial(sampled_loop(q.plant, q.sampling)).excess(q.gains);
  answers.push_back(
      {"spectral_radius", "", 1.0 + excess, radius_sensitivity(q.plant, q.sampling, q.gains)});
}

/// The ends of the stable interval of D about the case's own.
void add_stable_interval(const Question& q, std::vector<Sensitivities>& answers) {
  const double p = q.gains.proportional;
  const auto polynomial = characteristic_polynomial(sampled_loop(q.plant, q.sampling));
  const auto add = [&](const char* name, double d) {
    if (!std::isfinite(d)) return;
    answers.push_back(
        {name, "N.s/m", d,
         boundary_gain_sensitivity(q.plant, q.sampling, {p, d}, FreeGain::differential)});
  };
  for (const Interval<double>& interval : stable_differential_gains(polynomial, p)) {
    if (!interval.contains(q.gains.differential)) continue;
    add("stable_differential_gain_min", interval.lower);
    add("stable_differential_gain_max", interval.upper);
  }
}

void add_minimum_radius(const Question& q, std::vector<Sensitivities>& answers) {
  const double p = q.gains.proportional;
  const MinimumRadius least = minimum_radius(sampled_loop(q.plant, q.sampling), p);
  const auto moved = minimum_radius_sensitivity(q.plant, q.sampling, {p, least.differential_gain});
  answers.push_back({"least_radius", "", least.radius, moved.radius});
  answers.push_back(
      {"least_radius_gain", "N.s/m", least.differential_gain, moved.differential_gain});
}

void add_minimum_amplitude(const Question& q, std::vector<Sensitivities>& answers) {
  // No gain on the boundary: it decays at least half as fast as the fastest, its radius being held.
  const MinimumRadius fastest =
      minimum_radius(sampled_loop(q.plant, q.sampling), q.gains.proportional);
  const AmplitudeOptions question{q.sampling, q.hold, std::sqrt(std::min(1.0, fastest.radius)), 0.0,
                                  true};
  const auto least = minimum_amplitude(q.plant, question, q.frequency, q.gains.proportional);
  if (!std::isfinite(least.differential_gain)) return;
  const auto moved = amplitude_sensitivity(q.plant, question, q.frequency, q.gains.proportional);
  answers.push_back({"least_amplitude_ratio", "", least.ratio_to_uncontrolled, moved.ratio});
  answers.push_back(
      {"least_amplitude_gain", "N.s/m", least.differential_gain, moved.differential_gain});
}

void add_largest_period(const Question& q, DelayCriterion criterion, const char* name,
                        std::vector<Sensitivities>& answers) {
  MaxDelayOptions question;
  question.watch = throw_if_interrupted;
  question.frequency = q.frequency;
  question.proportional_gain = q.gains.proportional;
  question.criterion = criterion;
  question.hold = q.hold;
  question.relative_to_true_force = true;
  question.delay_fraction = q.sampling.processing_delay / q.sampling.period;
  const MaxDelay answer = max_sampling_period(q.plant, question);
  if (answer.outcome != MaxDelayOutcome::found) return;
  const auto moved = max_delay_sensitivity(q.plant, question, answer);
  LoopSensitivity sensitivity = moved.sampling_period;
  // The answer keeps the case's δ/τ, which moves with both.
  sensitivity[LoopParameter::processing_delay] = moved.by_delay_fraction / q.sampling.period;
  sensitivity[LoopParameter::sampling_period] =
      -question.delay_fraction * moved.by_delay_fraction / q.sampling.period;
  answers.push_back({name, "s", answer.sampling_period, sensitivity});
}

std::vector<Sensitivities> answers_of(const Question& q) {
  std::vector<Sensitivities> answers;
  add_radius(q, answers);
  add_stable_interval(q, answers);
  add_minimum_radius(q, answers);
  add_minimum_amplitude(q, answers);
  add_largest_period(q, DelayCriterion::stable, "max_stable_period", answers);
  add_largest_period(q, DelayCriterion::attenuates, "max_attenuating_period", answers);
  return answers;
}

void write(Table& table, const Question& q, const Sensitivities& answer, bool tuned) {
  const LoopSensitivity moved =
      tuned ? with_tuned_gain(answer.sensitivity, q.frequency) : answer.sensitivity;
  const auto relative = logarithmic(moved, {q.plant, q.sampling, q.gains}, answer.value);
  for (int k = 0; k < loop_parameters; ++k) {
    const char* key = name_in(parameter_keys, static_cast<LoopParameter>(k));
    table.row(answer.name, answer.value, answer.unit, key, find_case_key(key)->unit,
              moved.entries[k], relative.entries[k]);
  }
}

/// The same of a modal case, by differences.
void write_of_modes(const JobContext& context, bool follows) {
  Table table(context, columns_of("sensitivity"));
  for (const CaseSensitivity& answer : case_sensitivities(context.case_data, follows)) {
    if (!std::isfinite(answer.value)) continue;
    for (const auto& [key, derivative] : answer.keys)
      table.row(answer.name, answer.value, answer.unit, key, find_case_key(key)->unit, derivative,
                derivative * case_value(context.case_data, key) / answer.value);
  }
  table.require_numbers();
  table.commit();
}

/// One row for every answer and parameter, ∂answer/∂parameter and ∂ ln|answer|/∂ ln|parameter|.
/// Answers that the case does not have (no stable gain, no largest period) have no rows.
struct SensitivityQuestion {
  bool tuned = false;

  void add_to(const Job& job) { job.add("--tuned", tuned); }

  void run(const JobContext& context) const {
    const Case& the_case = context.case_data;
    const bool follows = tuned || the_case.control.proportional_gain_tuned;
    if (is_modal(the_case)) return write_of_modes(context, follows);
    const Question question{plant_of(the_case), sampling_of(the_case), gains_of(the_case),
                            excitation_of(the_case).frequency, force_hold_of(the_case)};
    Table table(context, columns_of("sensitivity"));
    for (const Sensitivities& answer : answers_of(question))
      write(table, question, answer, follows);
    table.require_numbers();
    table.commit();
  }
};

}  // namespace

void add_sensitivity(CLI::App& program) { add_job<SensitivityQuestion>(program, "sensitivity"); }

}  // namespace holdfast::program
