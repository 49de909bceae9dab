#include <cmath>
#include <string>
#include <vector>

#include "case/case_keys.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/design/max_delay.hpp"
#include "holdfast/stability/polynomial/loop_polynomial.hpp"
#include "holdfast/stability/sensitivity/amplitude_sensitivity.hpp"
#include "holdfast/stability/sensitivity/max_delay_sensitivity.hpp"
#include "holdfast/stability/sensitivity/minimum_radius_sensitivity.hpp"
#include "holdfast/stability/sensitivity/sensitivity.hpp"
#include "io/text/table.hpp"
#include "job.hpp"

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
         boundary_gain_sensitivity(q.plant, q.sampling, {p, d}, BoundaryGain::differential)});
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
  const AmplitudeOptions question{q.sampling, q.hold};
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
  question.frequency = q.frequency;
  question.proportional_gain = q.gains.proportional;
  question.criterion = criterion;
  question.hold = q.hold;
  question.delay_fraction = q.sampling.processing_delay / q.sampling.period;
  const MaxDelay answer = max_sampling_period(q.plant, question);
  if (answer.outcome != MaxDelayOutcome::found) return;
  const auto moved = max_delay_sensitivity(q.plant, question, answer);
  LoopSensitivity sensitivity = moved.sampling_period;
  // The answer keeps the case's δ/τ, which moves with both.
  sensitivity.processing_delay = moved.by_delay_fraction / q.sampling.period;
  sensitivity.sampling_period =
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

/// The keys of the case file in the order of `LoopSensitivity`.
const char* const sensitivity_keys[loop_parameters] = {
    "plant.conductor_mass",     "plant.conductor_stiffness", "plant.conductor_damping",
    "plant.absorber_mass",      "plant.absorber_stiffness",  "plant.absorber_damping",
    "control.sampling_period",  "control.processing_delay",  "control.proportional_gain",
    "control.differential_gain"};

void write(Table& table, const Question& q, const Sensitivities& answer, bool tuned) {
  const LoopSensitivity moved =
      tuned ? with_tuned_gain(answer.sensitivity, q.frequency) : answer.sensitivity;
  const auto slopes = entries_of(moved);
  const auto relative = entries_of(logarithmic(moved, q.plant, q.sampling, q.gains, answer.value));
  for (int k = 0; k < loop_parameters; ++k) {
    // Adding zero leaves no "-0" in the table.
    table.row(answer.name, answer.value, answer.unit, sensitivity_keys[k],
              find_case_key(sensitivity_keys[k])->unit, slopes[k] + 0.0, relative[k] + 0.0);
  }
}

/// One row for every answer and parameter, ∂answer/∂parameter and ∂ ln|answer|/∂ ln|parameter|.
/// Answers that the case does not have (no stable gain, no largest period) have no rows.
void run(const JobContext& context, bool tuned) {
  const Case& the_case = context.case_data;
  const Question question{plant_of(the_case), sampling_of(the_case), gains_of(the_case),
                          excitation_of(the_case).frequency, force_hold_of(the_case)};
  Table table(context, {{"answer", "", "what moves", "string"},
                        {"value", "", "of the answer"},
                        {"unit", "", "of the answer", "string"},
                        {"parameter", "", "key of the case file", "string"},
                        {"parameter_unit", "", "of the parameter", "string"},
                        {"derivative", "", "of the answer by the parameter, in their units"},
                        {"relative", "", "per cent of the answer per per cent of the parameter"}});
  const bool follows = tuned || the_case.control.proportional_gain_tuned;
  for (const Sensitivities& answer : answers_of(question)) write(table, question, answer, follows);
  table.commit();
}

}  // namespace

void add_sensitivity(CLI::App& program) {
  const Job job(program, "sensitivity", question::gains,
                "How the answers move with each parameter: stable gains, best gains, largest "
                "sampling period");
  const auto tuned = std::make_shared<bool>(false);
  job->add_flag(
      "--tuned", *tuned,
      "P follows the absorber's stiffness and mass by Eq. 6 instead of being held, as it does "
      "in a case whose gain is \"tuned\"");
  job->final_callback([job, tuned] { run(job.context(), *tuned); });
}

}  // namespace holdfast::program
