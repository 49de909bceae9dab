#include <algorithm>
#include <cmath>

#include "case/model/cable_of_case.hpp"
#include "case/model/modal/conductor_modes.hpp"
#include "case/model/span/span_of_case.hpp"
#include "holdfast/span/wind/wind_history.hpp"
#include "job.hpp"
#include "jobs/span/aeolian_amplitudes.hpp"
#include "jobs/span/span_words.hpp"

namespace holdfast::program {
namespace {

std::string range_word(BalanceRange range) {
  if (range == BalanceRange::within) return "";
  return range == BalanceRange::below ? "at_most" : "at_least";
}

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

/// The case's span in a wind that sheds its vortices at a frequency (Hz), with a wake at every
/// place along it, the turbulence of the site and self-damping by the first law that is known; from
/// rest but for a hundredth of the diameter in the mode nearest to the shedding. Throws WrongInput
/// for a conductor without diameter, and for a frequency or duration (s) that would take hours.
WindHistory wind_history_of(const Case& the_case, bool controlled, double frequency,
                            double duration) {
  require_diameter(the_case, "a time history in the wind");
  const WindHistorySetting setting = setting_of(the_case, controlled, frequency, duration);
  const double work =
      2.0 * setting.modes * setting.stations * duration * frequency * setting.steps_per_cycle;
  if (setting.modes > 1000 || work > most_work)
    throw WrongInput("--history " + format_number(frequency) + ", --duration " +
                     format_number(duration) + ": mode " + std::to_string(setting.modes * 2 / 3) +
                     " of the span vibrates there, and the history would take hours; give a lower "
                     "frequency, a shorter --duration, or a part of the span (conductor.span)");
  return wind_history(setting);
}

/// The answer of the history beside the energy balance, in one sentence.
std::string history_text(const WindHistory& history, const std::vector<AeolianRow>& balance,
                         double diameter) {
  double lowest = balance.front().damped.amplitude.amplitude, highest = lowest;
  bool is_bound = false;
  for (const AeolianRow& row : balance) {
    is_bound = is_bound || row.damped.amplitude.range == BalanceRange::below;
    lowest = std::min(lowest, row.damped.amplitude.amplitude);
    highest = std::max(highest, row.damped.amplitude.amplitude);
  }
  return "where it vibrates most, the span has " + format_rounded(history.amplitude / diameter) +
         " diameters (root mean square times 1.41) at " + format_rounded(history.frequency) +
         " Hz in mode " + std::to_string(history.mode) + "; the energy balance gives " +
         range_text(format_rounded(lowest / diameter), format_rounded(highest / diameter)) +
         (is_bound ? ", where 0.01 is the lower limit of the laws of the wind" : "");
}

struct AeolianQuestion {
  std::string frequency = "3:150:148";
  bool no_control = false;
  std::optional<double> history;
  double duration = 120.0;

  void add_to(const Job& job) {
    job.add("--frequency", frequency);
    job.add("--history", history);
    job.add("--duration", duration);
    job.add("--no-control", no_control);
  }

  void run(const JobContext& context) const {
    const Case& the_case = context.case_data;
    if (history) return write_history(context);
    const Axis axis = parse_frequencies("--frequency", frequency);
    require_measured(the_case, axis.min, axis.max);
    report_warning(absent_absorber_note(the_case), context.quiet);
    const AeolianBalance balance(the_case, !no_control);
    report_warning(self_damping_note(the_case), context.quiet);
    report_warning(unknown_strain_note(balance), context.quiet);
    require_text_meant(context, axis.count, "rows", "give fewer by --frequency");
    Table table(context, columns_of("aeolian"));
    RangeCount ranges;
    for (std::int64_t k = 0; k < axis.count; ++k) {
      throw_if_interrupted();
      for (const AeolianRow& row : balance.rows(axis.at(k))) {
        table.row(row.frequency, row.wind_speed, row.wind_law, row.damping_law,
                  row.bare.amplitude.amplitude, row.damped.amplitude.amplitude, row.bare.strain,
                  row.damped.strain, range_word(row.damped.amplitude.range),
                  range_word(row.bare.amplitude.range));
        ranges.add(row, balance.has_devices());
      }
    }
    report_warning(ranges.text(), context.quiet);
    report_warning(instability_note(the_case, !no_control), context.quiet);
    table.commit();
  }

 private:
  void write_history(const JobContext& context) const {
    const Case& the_case = context.case_data;
    require_measured(the_case, *history, *history);
    report_warning(absent_absorber_note(the_case), context.quiet);
    report_warning(self_damping_note(the_case), context.quiet);
    Table table(context, columns_of("aeolian-history"));
    const WindHistory found = wind_history_of(the_case, !no_control, *history, duration);
    for (std::size_t k = 0; k < found.times.size(); ++k)
      table.row(found.times[k], found.displacements[k]);
    const AeolianBalance balance(the_case, !no_control);
    report_warning(history_text(found, balance.rows(*history), balance.diameter()), context.quiet);
    table.commit();
  }
};

}  // namespace

void add_aeolian(CLI::App& program) { add_job<AeolianQuestion>(program, "aeolian"); }

}  // namespace holdfast::program
