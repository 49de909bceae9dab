#include "report/figures/sweep_figures.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

#include "case/case_file.hpp"
#include "case/model/plant_of_case.hpp"
#include "io/text/text.hpp"
#include "report/page/success_map.hpp"

namespace holdfast::program {
namespace {

double frequency_of(const Case& the_case) { return effective_excitation(the_case).frequency; }

/// Sampling periods between two fractions of the forcing period.
MapAxis period_axis(const Case& the_case, double from, double to) {
  const double forcing_period = 1.0 / frequency_of(the_case);
  const double shortest = std::max(from * forcing_period, the_case.control.processing_delay);
  return {"control.sampling_period", shortest, std::max(to * forcing_period, 10.0 * shortest), true,
          "sampling period τ (ms)",  1e3};
}

/// Both ends of the steady z₂ − z₁ without control apart (m): a backlash as wide swallows it.
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

/// A little above the value, with one digit.
double rounded_up(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)));
  return std::ceil(1.02 * value / unit) * unit;
}

MapAxis backlash_axis(const Case& the_case) {
  const double swing = swing_without_control(the_case);
  const double widest = swing > 0.0 ? rounded_up(swing) : 1e-3;  // at rest any width does
  const bool fine = widest < 1e-4;
  return {"backlash.width",
          0.0,
          widest,
          false,
          "backlash {/:Italic r}_0 " + std::string(fine ? "(µm)" : "(mm)"),
          fine ? 1e6 : 1e3};
}

/// The excitation's frequency between two multiples of the case's; with [wind] its speed, to which
/// the frequency of the vortices is proportional.
MapAxis frequency_axis(const Case& the_case, double from, double to) {
  if (the_case.wind) {
    const double speed = the_case.wind->speed;
    return {"wind.speed", from * speed, to * speed, false, "wind speed {/:Italic U} (m/s)", 1.0};
  }
  const double frequency = frequency_of(the_case);
  return {"excitation.frequency",
          from * frequency,
          to * frequency,
          false,
          "excitation frequency {/:Italic f} (Hz)",
          1.0};
}

/// The limit of Fig. 5 over the same abscissa.
MapCurve attenuation_limit(const Case& the_case, const std::string& table, double from, double to,
                           const MapAxis& period) {
  const double frequency = frequency_of(the_case);
  const double abscissa = the_case.wind ? the_case.wind->speed / frequency : 1.0;
  MapCurve curve;
  curve.tables = {
      {table,
       {"max-delay", "--criterion", "attenuates", "--frequency",
        format_number(from * frequency) + ":" + format_number(to * frequency) + ":91"}}};
  curve.points =
      "@" + table + "@ using ($1*" + format_number(abscissa) + "):(" + shown_on(period, "$3") + ")";
  curve.label = "longest τ, no backlash";
  return curve;
}

/// So many forcing periods, in seconds.
std::string duration_of(const Case& the_case, double forcing_periods) {
  return format_rounded(forcing_periods / frequency_of(the_case));
}

MapPanel settling_panel(const std::string& duration) {
  return {"{/:Italic D}\u00a0that settles in " + duration + " s", {"--duration", duration}};
}

std::string frequency_text(const Case& the_case) {
  return format_rounded(frequency_of(the_case)) + " Hz";
}

/// What the shades and marks say.
std::string meaning_of_shades(const Case& the_case) {
  std::string meaning =
      "Steady amplitude of the conductor over that without control. Blue: control helps; orange "
      "with marks +: it makes the vibration worse; white: no difference within 0.5 %, as where "
      "the backlash swallows the whole motion; black: the motion diverges or is more than a "
      "hundredfold; grey with marks ×: no D lets the motion settle in time; light grey with marks "
      "○: 2fτ ≥ 1 with f the frequency of the excitation, so slow are the samples that they do not "
      "show the vibration.";
  if (effective_excitation(the_case).amplitude == 0.0)
    meaning += " Nothing excites this cable: white is also where it rests with control or without.";
  return meaning;
}

Figure delay_backlash_figure(const Case& the_case) {
  const std::string patient = duration_of(the_case, 600.0), quick = duration_of(the_case, 200.0);
  return success_figure(
      "success-delay-backlash",
      "For which delays and backlashes control still helps, " + frequency_text(the_case),
      meaning_of_shades(the_case) +
          " P is tuned to the excitation. D leaves the least amplitude without backlash of all D "
          "with which the transient falls to e⁻¹⁰ in " +
          patient + " s (left) or " + quick +
          " s (right), which is also how long each motion is followed; steady is the second half. "
          "61 × 61 cells each.",
      {period_axis(the_case, 0.005, 0.4),
       backlash_axis(the_case),
       {settling_panel(patient), settling_panel(quick)},
       {}});
}

std::vector<MapPanel> backlash_panels(const Case& the_case, const std::string& duration) {
  std::vector<MapPanel> panels = {
      {"without backlash", {"--duration", duration, "--set", "backlash.width=0"}}};
  const double width = the_case.backlash.width;
  if (width > 0.0) {
    panels.push_back({"backlash\u00a0{/:Italic r}_0\u00a0= " + format_rounded(1e3 * width) + " mm",
                      {"--duration", duration}});
  }
  return panels;
}

std::string frequency_delay_caption(const Case& the_case, const std::string& duration) {
  std::string caption =
      "Shades and marks as above, P tuned to each frequency; D leaves the least amplitude without "
      "backlash of all D with which the transient falls to e⁻¹⁰ in " +
      duration +
      " s. Line: the longest sampling period with which some stabilising D attenuates without "
      "backlash, however slowly it settles. 61 × 61 cells each.";
  if (the_case.control.processing_delay > 0.0) {
    caption +=
        " The processing delay is the same in all cells; for the line it keeps its fraction of the "
        "sampling period.";
  }
  return caption;
}

Figure frequency_delay_figure(const Case& the_case) {
  const std::string name = "success-frequency-delay";
  const double lowest = 0.5, highest = 5.0;
  const std::string duration = duration_of(the_case, 2000.0);
  const MapAxis period = period_axis(the_case, 0.01, 1.0);
  return success_figure(
      name, "For which frequencies and delays control still helps",
      frequency_delay_caption(the_case, duration),
      {frequency_axis(the_case, lowest, highest), period, backlash_panels(the_case, duration),
       attenuation_limit(the_case, name + "-limit", lowest, highest, period)});
}

}  // namespace

std::vector<Figure> success_figures(const Case& the_case) {
  return {delay_backlash_figure(the_case), frequency_delay_figure(the_case)};
}

std::vector<Figure> paper_success_figures() {
  std::vector<Figure> figures = success_figures(load_case({}, {}));
  figures[0].caption +=
      " The D of the left is larger and better without backlash (lowest row); that of the right "
      "bears more delay with it. Where shades mix, the amplitude depends on details of the "
      "contacts.";
  figures[1].caption +=
      " Without backlash the motions confirm the line, which is that of Fig. 5, except towards 50 "
      "Hz, where no transient is over in that time. With backlash little is left: the best D lies "
      "close to the limit of stability, and the backlash carries the loop across.";
  return figures;
}

}  // namespace holdfast::program
