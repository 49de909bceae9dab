#include "jobs/span/wind_history_of_case.hpp"

#include <algorithm>
#include <cmath>

#include "case/model/cable_of_case.hpp"
#include "case/model/modal/conductor_modes.hpp"
#include "case/model/span/span_of_case.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

/// Multiplications of a run that take about a quarter of an hour.
constexpr double most_work = 1e13;

WindHistorySetting setting_of(const Case& the_case, bool controlled, double frequency,
                              double duration) {
  WindHistorySetting setting{};
  setting.string = string_of(the_case);
  setting.diameter = the_case.conductor.diameter;
  setting.strouhal = strouhal_of(the_case);
  setting.devices = span_devices_of(the_case, controlled);
  setting.wind.mean_speed = frequency * setting.diameter / setting.strouhal;
  setting.wind.intensity = the_case.site.turbulence_intensity;
  setting.force = WakeOscillatorLaw{};
  const bool is_stranded = std::isfinite(the_case.conductor.rated_strength);
  setting.string.damping_ratio = is_stranded ? 0.0 : damping_ratio_of(the_case);
  if (is_stranded) {
    setting.rated_strength = the_case.conductor.rated_strength;
    setting.self_damping = self_damping_laws[0];
  }
  const double first = setting.string.wave_speed() / (2.0 * setting.string.span);
  const double nearest = std::max(1.0, std::round(frequency / first));
  constexpr double beyond = 1.5;
  setting.modes = static_cast<int>(std::ceil(beyond * nearest)) + 2;
  setting.stations = 4 * setting.modes;
  setting.duration = duration;
  setting.initial_amplitude = 0.01 * setting.diameter;
  // The antinode of the nearest mode that is nearest to mid-span.
  const double half_wave = setting.string.span / nearest;
  setting.place = (std::floor(nearest / 2.0) + 0.5) * half_wave;
  return setting;
}

}  // namespace

WindHistory wind_history_of(const Case& the_case, bool controlled, double frequency,
                            double duration) {
  require_diameter(the_case, "a time history in the wind");
  const WindHistorySetting setting = setting_of(the_case, controlled, frequency, duration);
  const double work =
      2.0 * setting.modes * setting.stations * duration * frequency * setting.steps_per_cycle;
  if (setting.modes > 1000 || work > most_work)
    throw WrongInput("--history " + format_number(frequency) + ", --duration " +
                     format_number(duration) + ": the span has its mode " +
                     std::to_string(setting.modes * 2 / 3) +
                     " there, and the history would take hours; ask for a lower frequency, a "
                     "shorter history, or a part of the span (conductor.span)");
  return wind_history(setting);
}

std::string history_text(const WindHistory& history, const std::vector<AeolianRow>& balance,
                         double diameter) {
  double lowest = balance.front().damped.amplitude.amplitude, highest = lowest;
  bool is_bound = false;
  for (const AeolianRow& row : balance) {
    is_bound = is_bound || row.damped.amplitude.range == BalanceRange::below;
    lowest = std::min(lowest, row.damped.amplitude.amplitude);
    highest = std::max(highest, row.damped.amplitude.amplitude);
  }
  return "at its largest place it vibrates with " + format_rounded(history.amplitude / diameter) +
         " diameters (root mean square times 1.41) at " + format_rounded(history.frequency) +
         " Hz in mode " + std::to_string(history.mode) + "; the energy balance has " +
         range_text(format_rounded(lowest / diameter), format_rounded(highest / diameter)) +
         (is_bound ? ", where 0.01 is as little as the laws of the wind were measured for" : "");
}

}  // namespace holdfast::program
