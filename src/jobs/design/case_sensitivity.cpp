#include "jobs/design/case_sensitivity.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "case/case_keys.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "jobs/design/best_gains.hpp"
#include "jobs/design/gain_margins.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

struct Answered {
  const char* name;
  const char* unit;
};
constexpr std::array<Answered, 7> answered = {{{"spectral_radius", ""},
                                               {"stable_differential_gain_min", "N.s/m"},
                                               {"stable_differential_gain_max", "N.s/m"},
                                               {"least_radius", ""},
                                               {"least_radius_gain", "N.s/m"},
                                               {"least_amplitude_ratio", ""},
                                               {"least_amplitude_gain", "N.s/m"}}};
using AnswerValues = std::array<double, answered.size()>;

AnswerValues answers_of(const Case& the_case) {
  throw_if_interrupted();
  const PdGains<double> gains = gains_of(the_case);
  AnswerValues values;
  values.fill(unknown);
  values[0] = ModalRadius(the_case)(gains);
  for (const auto& interval : circle_of(the_case).stable_gains(FreeGain::differential, gains))
    if (interval.contains(gains.differential)) {
      values[1] = interval.lower;
      values[2] = interval.upper;
    }
  const AmplitudeOptions options{sampling_of(the_case), force_hold_of(the_case), 1.0, usual_margin,
                                 true};
  const BestForPlant best(the_case, options);
  const MinimumRadius fastest = best.fastest(gains.proportional);
  values[3] = fastest.radius;
  values[4] = fastest.differential_gain;
  const MinimumAmplitude quietest =
      best.quietest(excitation_of(the_case).frequency, gains.proportional);
  values[5] = quietest.ratio_to_uncontrolled;
  values[6] = quietest.differential_gain;
  return values;
}

/// The keys that the plant and the loop of a modal case depend on.
std::vector<std::string> keys_of(const Case& the_case) {
  std::vector<std::string> keys = {"control.proportional_gain", "control.differential_gain",
                                   "control.sampling_period",   "control.processing_delay",
                                   "plant.absorber_mass",       "plant.absorber_stiffness",
                                   "plant.absorber_damping"};
  const auto add = [&](bool counts, const char* key) {
    if (counts) keys.emplace_back(key);
  };
  const bool masses = is_two_masses(the_case), endless = is_infinite(the_case);
  const bool tight = std::isfinite(the_case.conductor.tension);
  add(masses, "plant.conductor_mass");
  add(masses, "plant.conductor_stiffness");
  add(masses, "plant.conductor_damping");
  add(!masses, "absorber.clamp_mass");
  add(!masses && !endless, "absorber.position");
  add(!masses, "conductor.mass_per_length");
  add(!masses, tight ? "conductor.tension" : "conductor.sag");
  add(!masses && !endless, "conductor.damping_ratio");
  add(std::isfinite(the_case.control.measurement_filter), "control.measurement_filter");
  add(std::isfinite(the_case.control.drive_bandwidth), "control.drive_bandwidth");
  add(std::isfinite(the_case.control.drive_bandwidth) &&
          std::isfinite(the_case.control.drive_damping),
      "control.drive_damping");
  return keys;
}

/// The case with a key moved, P being held or following Eq. 6.
Case moved(const Case& the_case, const std::string& key, double value, bool follows) {
  Case other = the_case;
  const double held = gains_of(the_case).proportional;
  const auto tuned = [](Case of) {
    of.control.proportional_gain_tuned = true;
    return gains_of(of).proportional;
  };
  set_case_value(other, key, value);
  settle_sag(other);
  check_case(other);
  if (key == "control.proportional_gain") return other;
  other.control.proportional_gain_tuned = false;
  other.control.proportional_gain = held + (follows ? tuned(other) - tuned(the_case) : 0.0);
  return other;
}

/// What a key that is 0 is moved by: a part of what would be felt.
double unit_of(const Case& the_case, const std::string& key) {
  if (key == "control.processing_delay") return the_case.control.sampling_period;
  if (key == "absorber.clamp_mass") return 0.01;
  return 1.0;
}

/// ∂answers/∂key by two steps.
AnswerValues slopes(const Case& the_case, const std::string& key, const AnswerValues& here,
                    bool follows) {
  constexpr double step = 1e-4, agreement = 0.01;
  const double value = case_value(the_case, key);
  double by = step * (value != 0.0 ? std::abs(value) : unit_of(the_case, key));
  const auto is_there = [&](double share) {
    try {
      return is_modal(moved(the_case, key, value + share * by, follows));
    } catch (const WrongInput&) {
      return false;
    }
  };
  const bool above = is_there(1.0), below = is_there(-1.0), one_sided = !(above && below);
  AnswerValues result;
  result.fill(unknown);
  if (!above && !below) return result;
  if (!above) by = -by;
  const auto at = [&](double share) {
    return answers_of(moved(the_case, key, value + share * by, follows));
  };
  const AnswerValues far = at(1.0), near = at(0.5);
  const AnswerValues far_below = one_sided ? here : at(-1.0),
                     near_below = one_sided ? here : at(-0.5);
  for (std::size_t k = 0; k < result.size(); ++k) {
    const double width = one_sided ? by : 2.0 * by;
    const double coarse = (far[k] - far_below[k]) / width;
    const double fine = (near[k] - near_below[k]) / (0.5 * width);
    result[k] = one_sided ? 2.0 * fine - coarse : (4.0 * fine - coarse) / 3.0;
    // A derivative that is nothing beside the answer's own size is round-off.
    const double nothing = 1e-6 * std::abs(here[k] / by) * step;
    if (!(std::abs(fine - coarse) <= agreement * std::abs(fine) + nothing)) result[k] = unknown;
  }
  return result;
}

}  // namespace

std::vector<CaseSensitivity> case_sensitivities(const Case& the_case, bool tuned) {
  require_natural_motions(the_case);
  const AnswerValues here = answers_of(the_case);
  std::vector<CaseSensitivity> all;
  all.reserve(here.size());
  for (std::size_t k = 0; k < here.size(); ++k)
    all.push_back({answered[k].name, answered[k].unit, here[k], {}});
  for (const std::string& key : keys_of(the_case)) {
    const AnswerValues slope = slopes(the_case, key, here, tuned);
    for (std::size_t k = 0; k < here.size(); ++k) all[k].keys.push_back({key, slope[k]});
  }
  return all;
}

}  // namespace holdfast::program
