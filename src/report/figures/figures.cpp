#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <utility>

#include "case/model/cable_of_case.hpp"
#include "case/model/decay/cable_decay.hpp"
#include "case/model/linear_loop.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/modal/conductor_modes.hpp"
#include "case/model/plant_of_case.hpp"
#include "case/model/span/span_of_case.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/math/signal/decay_measures.hpp"
#include "holdfast/span/end_response.hpp"
#include "jobs/span/span_words.hpp"
#include "process/errors.hpp"
#include "report/figures/figure.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

double frequency_of(const Case& the_case) { return effective_excitation(the_case).frequency; }

MapAxis axis_over(const std::string& key, double min, double max, bool logarithmic = false) {
  return {key, min, max, logarithmic, label_of(key), scale_of(key)};
}

/// Axis of sampling periods between two fractions of the forcing period.
MapAxis period_axis(const Case& the_case, double from, double to) {
  const double forcing_period = 1.0 / frequency_of(the_case);
  const double shortest = std::max(from * forcing_period, the_case.control.processing_delay);
  return axis_over("control.sampling_period", shortest,
                   std::max(to * forcing_period, 10.0 * shortest), true);
}

/// Range of z₂ − z₁ (m) in the steady motion without control; a play as wide is never crossed.
double swing_without_control(const Case& the_case) {
  using Complex = std::complex<double>;
  const TwoMass<double> plant = plant_of(the_case);
  const double omega = 2.0 * pi<double> * frequency_of(the_case);
  const Complex link(plant.absorber_stiffness, omega * plant.absorber_damping);
  const Complex absorber = link - plant.absorber_mass * omega * omega;
  const Complex conductor(plant.conductor_stiffness - plant.conductor_mass * omega * omega,
                          omega * plant.conductor_damping);
  // m₂: absorber·z₂ = link·z₁; both masses: conductor·z₁ − m₂ω² z₂ = F.
  const Complex both = conductor - plant.absorber_mass * omega * omega * link / absorber;
  const Complex relative = (link / absorber - 1.0) / both;
  return 2.0 * effective_excitation(the_case).amplitude * std::abs(relative);
}

MapAxis backlash_axis(const Case& the_case) {
  const double swing = swing_without_control(the_case);
  const double widest = swing > 0.0 ? rounded_up(swing) : 1e-3;  // at rest any width does
  MapAxis axis = axis_over("backlash.width", 0.0, widest);
  if (widest < 1e-4) {
    axis.label = replaced(axis.label, "(mm)", "(µm)");
    axis.scale = 1e6;
  }
  return axis;
}

/// Axis of excitation frequencies between two multiples of the case's frequency; with [wind] an
/// axis of wind speeds, to which the frequency of the vortices is proportional.
MapAxis frequency_axis(const Case& the_case, double from, double to) {
  const double of_case = the_case.wind ? the_case.wind->speed : frequency_of(the_case);
  return axis_over(the_case.wind ? "wind.speed" : "excitation.frequency", from * of_case,
                   to * of_case);
}

/// Duration (s) of a number of forcing periods, as text with four digits.
std::string duration_of(const Case& the_case, double forcing_periods) {
  const double exact = forcing_periods / frequency_of(the_case);
  const double unit = std::pow(10.0, std::floor(std::log10(exact)) - 3.0);
  return format_rounded(std::round(exact / unit) * unit);
}

/// Panel of a map for the D with which a motion settles in the first half of its duration
/// (`BestGains`): heading for gnuplot, and options of the job sweep.
Values settling_panel(const std::string& duration) {
  const double settling_time = 0.5 * std::strtod(duration.c_str(), nullptr);
  return {{"heading", "{/:Italic D}\u00a0that settles in " + rounded(settling_time, 4) + " s"},
          {"options", "--duration " + duration}};
}

/// Replacements of @KEY@ for a map with these axes and panels.
Values values_of_chart(const MapAxis& x, const MapAxis& y, const std::vector<Values>& panels,
                       Values values) {
  values.emplace_back("panels", std::to_string(panels.size()));
  return joined(joined(std::move(values), values_of("x", x, "$1")), values_of("y", y, "$2"));
}

Figure delay_backlash_figure(const Case& the_case, bool builtin) {
  const std::string patient = duration_of(the_case, 600.0), quick = duration_of(the_case, 200.0);
  const std::vector<Values> panels = {settling_panel(patient), settling_panel(quick)};
  const bool rests = effective_excitation(the_case).amplitude == 0.0;
  const Values words = {{"frequency", rounded(frequency_of(the_case), 4) + " Hz"},
                        {"patient", patient},
                        {"quick", quick},
                        {"moves", rests ? "@at rest@" : ""},
                        {"seen", builtin ? "@seen in delay-backlash@" : ""}};
  return listed_figures("delay-backlash",
                        values_of_chart(period_axis(the_case, 0.005, 0.4), backlash_axis(the_case),
                                        panels, words),
                        panels)
      .front();
}

std::vector<Values> backlash_panels(const Case& the_case, const std::string& duration) {
  std::vector<Values> panels = {
      {{"heading", "without backlash"},
       {"options", "--duration " + duration + " --set backlash.width=0"}}};
  const double width = the_case.backlash.width;
  if (width > 0.0)
    panels.push_back(
        {{"heading", "backlash\u00a0{/:Italic r}_0\u00a0= " + rounded(1e3 * width, 4) + " mm"},
         {"options", "--duration " + duration}});
  return panels;
}

/// Map over frequency and sampling period, with the limit of Fig. 5 of Kollár 2022.
Figure frequency_delay_figure(const Case& the_case, bool builtin) {
  const double lowest = 0.5, highest = 5.0, frequency = frequency_of(the_case);
  const std::string duration = duration_of(the_case, 2000.0);
  const std::vector<Values> panels = backlash_panels(the_case, duration);
  const MapAxis period = period_axis(the_case, 0.01, 1.0);
  const double abscissa = the_case.wind ? the_case.wind->speed / frequency : 1.0;
  const bool delayed = the_case.control.processing_delay > 0.0;
  const Values words = {{"duration", duration},
                        {"abscissa", format_number(abscissa)},
                        {"limit", shown_on(period, "$3")},
                        {"delayed", delayed ? "@same delay@" : ""},
                        {"seen", builtin ? "@seen in frequency-delay@" : ""}};
  Figure figure =
      listed_figures(
          "frequency-delay",
          values_of_chart(frequency_axis(the_case, lowest, highest), period, panels, words), panels)
          .front();
  figure.tables.push_back(
      {figure.name + "-limit", words_of("max-delay --criterion attenuates --frequency " +
                                        format_number(lowest * frequency) + ":" +
                                        format_number(highest * frequency) + ":91")});
  return figure;
}

/// Maps, by the job sweep, of the delays, backlashes and frequencies for which control reduces the
/// vibration, around the frequency f of the case's excitation (with [wind]: of the vortices).
///
/// Sampling periods are fractions of 1/f, but not shorter than the processing delay. The widest
/// backlash is as wide as the range of z₂ − z₁ without control. Durations are multiples of 1/f.
std::vector<Figure> success_figures(const Case& the_case, bool builtin) {
  return {delay_backlash_figure(the_case, builtin), frequency_delay_figure(the_case, builtin)};
}

double rms_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// Replacements of @KEY@ that tell how well plant and cable agree in a free vibration.
Values judged(const DecayRecord& plant, const DecayRecord& cable) {
  constexpr double same_frequency = 0.02, same_motion = 0.2;
  std::vector<double> difference = cable.displacements;
  for (std::size_t k = 0; k < difference.size(); ++k) difference[k] -= plant.displacements[k];
  const double misfit = rms_of(difference) / rms_of(cable.displacements);
  const double of_plant = decay_measures(plant).period, of_cable = decay_measures(cable).period;
  const double drift = std::abs(of_plant / of_cable - 1.0);  // NaN where one has no period
  const char* verdict = drift > same_frequency    ? "@other frequency@"
                        : misfit <= same_motion   ? "@plant agrees@"
                        : drift <= same_frequency ? "@other decay@"
                                                  : "@no frequency@";
  return {{"judged", verdict},
          {"misfit", format_rounded(std::round(100.0 * misfit))},
          {"of plant", rounded(1.0 / of_plant, 4)},
          {"of cable", rounded(1.0 / of_cable, 4)},
          {"factor", rounded(std::max(of_plant / of_cable, of_cable / of_plant), 3)},
          {"apart after", rounded(0.5 / std::abs(1.0 / of_plant - 1.0 / of_cable), 2)}};
}

/// Replacements as by judged(), for the plant of a case; empty text if the cable is not simulated.
Values judged_plant(const Case& the_case, const CableDecayOptions& options) {
  try {
    const CableDecay cable = cable_decay(the_case, options);
    return judged(plant_decay(plant_of(the_case), options.force, true, cable), cable.record);
  } catch (const Refusal&) {
    return {{"judged", ""}};  // the figure's table says why
  }
}

/// Figures of the loop of any case but the built-in one.
std::vector<Figure> figures_of_loop(const Case& the_case) {
  Values values = window_of_gains(the_case);
  values.emplace_back("greatest frequency", greatest_frequency(the_case));
  // On a conductor each period is walked to, with all roots at every step.
  values.emplace_back("count of periods", has_closed_forms(the_case) ? "115" : "20");
  return listed_figures("loop", values);
}

std::vector<Figure> figures_of_cable(const Case& the_case) {
  if (!plant_is_reduced(the_case)) return {};
  const CableDecayOptions options = usual_decay(the_case);
  const Values values = {{"removed", format_number(options.force)},
                         {"removed about", rounded(options.force, 4)},
                         {"duration", format_number(options.duration)}};
  return joined(listed_figures("cable", joined(values, judged_plant(the_case, options))),
                listed_figures("amplitudes"));
}

/// Whether the paper's ranges of P, D and absorber stiffness contain those of the case.
bool is_of_papers_size(const Case& the_case) {
  const PdGains<double> gains = gains_of(the_case);
  const double size = std::max(std::abs(gains.proportional), plant_of(the_case).absorber_stiffness);
  if (!(size > 0.0)) return true;
  return Interval<double>{-1000.0, 200.0}.contains(gains.proportional) &&
         Interval<double>{-40.0, 20.0}.contains(gains.differential) &&
         Interval<double>{50.0, 1200.0}.contains(size);
}

/// Number of modes that vibrate in the wind: at least twenty, limited by computing time.
std::int64_t modes_shown(const Case& the_case, const Axis& frequencies) {
  const TautString<double> string = string_of(the_case);
  const double lowest = string.wave_speed() / (2.0 * string.span);
  return static_cast<std::int64_t>(std::clamp(std::ceil(frequencies.max / lowest), 20.0, 200.0));
}

}  // namespace

Values window_of_gains(const Case& the_case) {
  const PdGains<double> gains = gains_of(the_case);
  const TwoMass<double> plant = plant_of(the_case);
  const auto about = [](double centre, double reach) {
    return format_number(centre - reach) + ":" + format_number(centre + reach);
  };
  const double p_reach = std::max(std::abs(gains.proportional), plant.absorber_stiffness);
  const double d_reach =
      std::max({2.0 * std::abs(gains.differential), 5.0 * plant.absorber_damping, p_reach / 100.0});
  return {{"P", about(gains.proportional, p_reach)}, {"D", about(gains.differential, d_reach)}};
}

std::string shown_gains(const JobContext& context, const std::string& option,
                        const std::string& range) {
  const bool is_given = std::any_of(context.options.begin(), context.options.end(),
                                    [&](const auto& given) { return given.first == option; });
  if (is_given || is_of_papers_size(context.case_data)) return range;
  const bool has_count = std::count(range.begin(), range.end(), ':') == 2;
  return filled(option == "--p" ? "@P@" : "@D@", window_of_gains(context.case_data)) +
         (has_count ? range.substr(range.rfind(':')) : "");
}

std::string greatest_frequency(const Case& the_case) {
  const double forcing = frequency_of(the_case);
  const double seen = 0.5 / the_case.control.sampling_period;
  return format_rounded(forcing > 0.0 ? std::min(4.5 * forcing, seen) : seen);
}

std::vector<Figure> figures_of(const Case& the_case, bool builtin) {
  if (builtin)
    return joined(joined(listed_figures("paper"), listed_figures("amplitudes")),
                  success_figures(the_case, true));
  if (is_two_masses(the_case)) {
    // The maps choose the D of two masses under an ideal drive for every cell.
    const auto maps =
        has_closed_forms(the_case) ? success_figures(the_case, false) : std::vector<Figure>{};
    return joined(joined(figures_of_cable(the_case), figures_of_loop(the_case)), maps);
  }
  if (is_infinite(the_case)) return figures_of_loop(the_case);
  return joined(joined(listed_figures("amplitudes"), listed_figures("conductor")),
                figures_of_loop(the_case));
}

std::string frequencies_text(const Axis& axis) {
  return format_rounded(axis.min) + ":" + format_rounded(axis.max) + ":" +
         std::to_string(axis.count);
}

Values span_values(const Case& the_case) {
  return {{"diameter", format_number(the_case.conductor.diameter)}};
}

std::vector<Figure> span_figures(const Case& the_case) {
  const Axis axis = aeolian_frequencies(the_case);
  const std::string range = format_rounded(axis.min) + ":" + format_rounded(axis.max);
  const Values values =
      joined(span_values(the_case), {{"frequencies", frequencies_text(axis)},
                                     {"frequency range", range},
                                     {"modes", std::to_string(modes_shown(the_case, axis))}});
  std::vector<Figure> figures = listed_figures("span vibration", values);
  const auto devices = span_devices_of(the_case);
  const auto ends = span_ends(devices, the_case.conductor.span);
  if (!ends[0].devices.empty())
    figures = joined(std::move(figures), listed_figures("span left end", values));
  if (!ends[1].devices.empty())
    figures = joined(std::move(figures), listed_figures("span right end", values));
  if (ends[0].devices.empty() && ends[1].devices.empty())
    figures = joined(std::move(figures), listed_figures("span without devices", values));
  return joined(std::move(figures), listed_figures("span life", values));
}

}  // namespace holdfast::program
