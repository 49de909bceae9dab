#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "case/case_keys.hpp"
#include "case/model/linear_loop.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "job.hpp"
#include "jobs/design/best_gains.hpp"
#include "output/row_blocks.hpp"

namespace holdfast::program {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Name and unit of an answer in the table.
struct Answered {
  const char* name;
  const char* unit;
};
constexpr std::array<Answered, 9> answered = {{{"spectral_radius", ""},
                                               {"stable_differential_gain_min", "N.s/m"},
                                               {"stable_differential_gain_max", "N.s/m"},
                                               {"least_radius", ""},
                                               {"least_radius_gain", "N.s/m"},
                                               {"least_amplitude_ratio", ""},
                                               {"least_amplitude_gain", "N.s/m"},
                                               {"max_stable_period", "s"},
                                               {"max_attenuating_period", "s"}}};
using AnswerValues = std::array<double, answered.size()>;

/// Largest sampling period (s) at the case's P and ratio δ/τ; NaN if none is found.
double longest_period(const Case& the_case, const LinearLoop& loop, DelayCriterion criterion) {
  MaxDelayOptions question = tuned_delay_question(the_case, excitation_of(the_case).frequency);
  question.proportional_gain = gains_of(the_case).proportional;
  question.criterion = criterion;
  const MaxDelay longest = loop.longest_period(question);
  return longest.outcome == MaxDelayOutcome::found ? longest.sampling_period : unknown;
}

AnswerValues answers_of(const Case& the_case) {
  throw_if_interrupted();
  const PdGains<double> gains = gains_of(the_case);
  const LinearLoop loop(the_case);
  AnswerValues values;
  values.fill(unknown);
  values[0] = loop.radius(gains);
  for (const auto& interval : loop.stable_gains(FreeGain::differential, gains))
    if (interval.contains(gains.differential)) {
      values[1] = interval.lower;
      values[2] = interval.upper;
    }
  const MinimumRadius fastest = loop.fastest(gains.proportional);
  values[3] = fastest.radius;
  values[4] = fastest.differential_gain;
  const MinimumAmplitude quietest = loop.quietest(
      amplitude_options_of(the_case), excitation_of(the_case).frequency, gains.proportional);
  values[5] = quietest.ratio_to_uncontrolled;
  values[6] = quietest.differential_gain;
  if (loop.walks()) return values;
  values[7] = longest_period(the_case, loop, DelayCriterion::stable);
  values[8] = longest_period(the_case, loop, DelayCriterion::attenuates);
  return values;
}

/// Keys on which the plant and the loop of the case depend.
std::vector<std::string> keys_of(const Case& the_case) {
  const bool own = has_own_plant(the_case), masses = is_two_masses(the_case);
  const bool conductor = !own && !masses, endless = is_infinite(the_case);
  const bool tight = std::isfinite(the_case.conductor.tension);
  std::vector<std::string> keys;
  const auto add = [&](bool counts, const char* key) {
    if (counts) keys.emplace_back(key);
  };
  add(masses, "plant.conductor_mass");
  add(masses, "plant.conductor_stiffness");
  add(masses, "plant.conductor_damping");
  add(!own, "plant.absorber_mass");
  add(!own, "plant.absorber_stiffness");
  add(!own, "plant.absorber_damping");
  add(conductor, "absorber.clamp_mass");
  add(conductor && !endless, "absorber.position");
  add(conductor, "conductor.mass_per_length");
  add(conductor, tight ? "conductor.tension" : "conductor.sag");
  add(conductor && !endless, "conductor.damping_ratio");
  add(true, "control.sampling_period");
  add(true, "control.processing_delay");
  add(true, "control.proportional_gain");
  add(true, "control.differential_gain");
  add(std::isfinite(the_case.control.measurement_filter), "control.measurement_filter");
  add(std::isfinite(the_case.control.drive_bandwidth), "control.drive_bandwidth");
  add(std::isfinite(the_case.control.drive_bandwidth) &&
          std::isfinite(the_case.control.drive_damping),
      "control.drive_damping");
  return keys;
}

/// The case with one key changed; a tuned P follows Eq. 6, any other P is kept.
Case moved(const Case& the_case, const std::string& key, double value) {
  Case other = the_case;
  set_case_value(other, key, value);
  settle_sag(other);
  check_case(other);
  return other;
}

/// Size of a change of a key whose value is 0, to which the step of the difference is relative.
double unit_of(const Case& the_case, const std::string& key) {
  if (key == "control.processing_delay") return the_case.control.sampling_period;
  if (key == "absorber.clamp_mass") return 0.01;
  return 1.0;
}

/// Whether the loop is of the same kind after a key has changed; false for an inadmissible value.
bool keeps_kind(const Case& the_case, const std::string& key, double value) {
  try {
    return has_closed_forms(moved(the_case, key, value)) == has_closed_forms(the_case);
  } catch (const WrongInput&) {
    return false;
  }
}

/// Derivatives ∂answers/∂key by central differences with a step of 10⁻⁴ of the value if they agree
/// with one-sided ones to 0.1 %, else by Richardson extrapolation with half that step: five digits
/// or more. NaN where both steps disagree by more than 1 %, as at a kink. One-sided if need be.
AnswerValues slopes(const Case& the_case, const std::string& key, const AnswerValues& here) {
  constexpr double step = 1e-4, agreement = 0.01;
  if (the_case.control.proportional_gain_tuned && key == "control.proportional_gain")
    return AnswerValues{};
  const double value = case_value(the_case, key);
  double by = step * (value != 0.0 ? std::abs(value) : unit_of(the_case, key));
  const bool above = keeps_kind(the_case, key, value + by);
  const bool below = keeps_kind(the_case, key, value - by), one_sided = !(above && below);
  AnswerValues result;
  result.fill(unknown);
  if (!above && !below) return result;
  if (!above) by = -by;
  const auto at = [&](double share) {
    return answers_of(moved(the_case, key, value + share * by));
  };
  // A derivative that is nothing beside the answer's own size is round-off.
  const auto agree = [&](double one, double other, double share, double size) {
    return std::abs(one - other) <= share * std::abs(one) + 1e-6 * std::abs(size / by) * step;
  };
  const AnswerValues far = at(1.0), far_below = one_sided ? here : at(-1.0);
  bool straight = !one_sided;
  for (std::size_t k = 0; k < result.size(); ++k) {
    result[k] = (far[k] - far_below[k]) / (2.0 * by);
    if (std::isfinite(here[k]) &&
        !agree(result[k], (far[k] - here[k]) / by, 0.1 * agreement, here[k]))
      straight = false;
  }
  if (straight) return result;
  const AnswerValues near = at(0.5), near_below = one_sided ? here : at(-0.5);
  for (std::size_t k = 0; k < result.size(); ++k) {
    const double width = one_sided ? by : 2.0 * by;
    const double coarse = (far[k] - far_below[k]) / width;
    const double fine = (near[k] - near_below[k]) / (0.5 * width);
    result[k] = one_sided ? 2.0 * fine - coarse : (4.0 * fine - coarse) / 3.0;
    if (!agree(fine, coarse, agreement, here[k])) result[k] = unknown;
  }
  return result;
}

/// Writes ∂answer/∂parameter and ∂ ln|answer|/∂ ln|parameter|, a row per answer and parameter.
/// Answers that the case does not have (no stable gain, no largest period) have no rows.
void write_sensitivity(const JobContext& context) {
  const Case& the_case = context.case_data;
  Table table(context, columns_of("sensitivity"));
  const AnswerValues here = answers_of(the_case);
  const std::vector<std::string> keys = keys_of(the_case);
  std::vector<AnswerValues> by_key(keys.size());
  side_by_side(context, "sensitivity", static_cast<std::int64_t>(keys.size()), [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    by_key[k] = slopes(the_case, keys[k], here);
  });
  for (std::size_t k = 0; k < here.size(); ++k) {
    if (!std::isfinite(here[k])) continue;
    for (std::size_t i = 0; i < keys.size(); ++i)
      table.row(answered[k].name, here[k], answered[k].unit, keys[i], find_case_key(keys[i])->unit,
                by_key[i][k], by_key[i][k] * case_value(the_case, keys[i]) / here[k]);
  }
  table.require_numbers();
  table.commit();
}

}  // namespace

void add_sensitivity(CLI::App& program) { add_job(program, "sensitivity", write_sensitivity); }

}  // namespace holdfast::program
