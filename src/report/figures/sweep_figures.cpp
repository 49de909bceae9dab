#include "report/figures/figures.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

#include "case/case_file.hpp"
#include "case/model/plant_of_case.hpp"
#include "io/text/text.hpp"
#include "report/figures/figure.hpp"

namespace holdfast::program {
namespace {

/// The steady amplitude over that without control in 61 × 61 cells, P tuned to the excitation by
/// Eq. 6 and D the best of each cell; shades for classes of the ratio and for why there is none. A
/// cell that is no admissible case stays empty.
///
/// Blue to orange over white is told apart by all kinds of colour vision; in grey blue and orange
/// are alike, so that marks stand on every fifth cell along both axes of what amplifies. Half a per
/// cent of an amplitude is no difference: a motion that ends inside its backlash differs by the
/// rest of its transient. A hundredfold one has only not been followed long enough to leave the
/// range of numbers. The ratio is a text: a cell whose column is missing would be left out and
/// shift the others. At rest with control and without it is nan, which `set datafile missing` may
/// leave as no text; a number cannot be made of that. Then words say that nothing moves. The legend
/// stands above the panels, whose own keys would lie on each other.
constexpr const char* map_plot = R"plot(set palette maxcolors 12
set palette defined (-2 '#e6e6e6', -1 '#c4c4c4', 0 '#084a91', 1 '#3b8bc2', 2 '#86bcdc', 3 '#c9e0f0', 4 '#fbfbfb', 5 '#fde0b6', 6 '#fbb968', 7 '#e88224', 8 '#b04a00', 9 '#303030')
set cbrange [-2.5:9.5]
set cbtics ('2{/:Italic f}τ ≥ 1' -2, 'no~{/:Italic D}' -1, '< ¼' 0, '¼ – ½' 1, '½ – ¾' 2, '¾ – 1' 3, '1' 4, '1 – 1½' 5, '1½ – 2' 6, '2 – 4' 7, '> 4' 8, 'diverges' 9) scale 0
rests(r, outcome) = outcome eq 'computed' && (r eq 'nan' || r eq '')
class(r) = r < 0.25 ? 0 : r < 0.5 ? 1 : r < 0.75 ? 2 : r < 0.995 ? 3 : r <= 1.005 ? 4 : r <= 1.5 ? 5 : r <= 2 ? 6 : r <= 4 ? 7 : r <= 100 ? 8 : 9
shade(r, outcome) = rests(r, outcome) ? 4 : outcome eq 'computed' ? class(r + 0) : outcome eq 'diverges' ? 9 : outcome eq 'no_gain' ? -1 : outcome eq 'aliased' ? -2 : NaN
marked(k) = int(k) % 61 % 5 == 2 && int(k) / 61 % 5 == 2
amplifies(r, outcome, k) = outcome eq 'computed' && r > 1.005 && r <= 100 && marked(k)
unsettled(outcome, k) = outcome eq 'no_gain' && marked(k)
unseen(outcome, k) = outcome eq 'aliased' && marked(k)
remark(r, outcome, k) = rests(r, outcome) && k == 3 * 61 + 3 ? 'no vibration' : ''
set label 1 'control amplifies' at screen 0.02,0.955 point pt 1 ps 0.4 lc rgb '#5a2600' offset 0.8,-0.3
set label 2 'no~{/:Italic D}~settles in time' at screen 0.23,0.955 point pt 2 ps 0.4 lc rgb '#666666' offset 0.8,-0.3
set label 3 'sampled too slowly' at screen 0.47,0.955 point pt 6 ps 0.3 lc rgb '#666666' offset 0.8,-0.3
@legend@set xlabel "@x label@"
set ylabel "@y label@"
set xrange [@x range@]
@x tics@set yrange [@y range@]
@y tics@set ylabel offset 0.8,0
unset key
unset grid
set multiplot layout 1,@panels@ margins 0.115,0.79,0.175,0.835 spacing 0.04,0
set colorbox user origin screen 0.81,0.175 size screen 0.025,0.66
set cblabel 'amplitude over that without control' offset 0.5,0
)plot";

constexpr const char* panel_plot = R"plot(set title "@heading@" offset 0,-0.5
plot @table@ using (@x@):(@y@):(shade(strcol(3), strcol(5))) with image, \
  @table@ using (amplifies($3, strcol(5), $0) ? @x@ : NaN):(@y@) with points pt 1 ps 0.4 lc rgb '#5a2600', \
  @table@ using (unsettled(strcol(5), $0) ? @x@ : NaN):(@y@) with points pt 2 ps 0.4 lc rgb '#666666', \
  @table@ using (unseen(strcol(5), $0) ? @x@ : NaN):(@y@) with points pt 6 ps 0.3 lc rgb '#666666', \
  @table@ using (@x@):(@y@):(remark(strcol(3), strcol(5), $0)) with labels left@curve@
unset ylabel
unset ytics
unset colorbox
unset label
unset arrow
)plot";

constexpr const char* map_command =
    "sweep --axis @x axis@ --axis @y axis@ --metric ratio_to_uncontrolled --metric attenuates "
    "--metric outcome --best-gain --set control.proportional_gain=tuned @options@";

constexpr const char* curve_legend =
    R"plot(set arrow 1 from screen 0.7,0.955 to screen 0.73,0.955 nohead lw 2 lc rgb '#000000'
set label 4 'longest τ, no backlash' at screen 0.74,0.955
)plot";

/// A key of the case along an axis of a map, and how the picture shows it.
struct MapAxis {
  std::string key;
  double min, max;  // in the key's unit, min < max
  bool logarithmic;
  std::string label;
  double scale;  // the picture shows scale times the key's value
};

/// gnuplot's expression for what the picture's axis shows of a value, itself an expression.
std::string shown_on(const MapAxis& axis, const std::string& value) {
  const std::string shown = value + "*" + format_number(axis.scale);
  return axis.logarithmic ? "log10(" + shown + ")" : shown;
}

/// 1, 2 and 5 times the powers of ten: gnuplot's pictures of cells know no logarithmic axis.
std::string tics_of(const std::string& letter, const MapAxis& axis) {
  if (!axis.logarithmic) return "";
  const double lowest = axis.min * axis.scale, highest = axis.max * axis.scale;
  std::string tics;
  for (double power = std::pow(10.0, std::floor(std::log10(lowest))); power <= highest;
       power *= 10.0) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double value = digit * power;
      if (value < 0.999 * lowest || value > 1.001 * highest) continue;
      const std::string text = format_rounded(value);
      tics += (tics.empty() ? "'" : ", '") + text + "' log10(" + text + ")";
    }
  }
  return "set " + letter + "tics (" + tics + ")\n";
}

/// What the texts leave open of an axis.
Values values_of(const std::string& letter, const MapAxis& axis, const std::string& column) {
  const std::string min = format_number(axis.min), max = format_number(axis.max);
  return {{letter + " axis",
           axis.key + "=" + (axis.logarithmic ? "log:" : "") + min + ":" + max + ":61"},
          {letter + " label", axis.label},
          {letter + " range", shown_on(axis, min) + ":" + shown_on(axis, max)},
          {letter + " tics", tics_of(letter, axis)},
          {letter, shown_on(axis, column)}};
}

/// One of the maps of a figure, side by side.
struct MapPanel {
  std::string heading;  // in gnuplot's enhanced text
  std::string options;  // of the job sweep: duration, and what this panel alone sets
};

/// @param curve   "@NAME@ using x:y", drawn over every panel in what the axes show; may be empty
Figure success_figure(const std::string& name, const std::string& title, const std::string& caption,
                      const MapAxis& x, const MapAxis& y, const std::vector<MapPanel>& panels,
                      const std::string& curve = "") {
  Values values = values_of("x", x, "$1");
  for (auto& value : values_of("y", y, "$2")) values.push_back(std::move(value));
  values.emplace_back("legend", curve.empty() ? "" : curve_legend);
  values.emplace_back("panels", std::to_string(panels.size()));
  values.emplace_back(
      "curve", curve.empty() ? "" : ", \\\n  " + curve + " with lines lw 2 lc rgb '#000000'");
  Figure figure{name, title, caption, {}, replaced(filled(map_plot, values), "~", "\u00a0"), 400.0};
  for (const MapPanel& panel : panels) {
    const std::string suffix = "-" + std::to_string(figure.tables.size() + 1);
    Values own = {
        {"heading", panel.heading}, {"options", panel.options}, {"table", "@" + suffix + "@"}};
    own.insert(own.end(), values.begin(), values.end());
    figure.tables.push_back({name + suffix, words_of(filled(map_command, own))});
    figure.plot += filled(panel_plot, own);
  }
  figure.plot += "unset multiplot\n";
  return figure;
}

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

/// So many forcing periods, in seconds.
std::string duration_of(const Case& the_case, double forcing_periods) {
  return format_rounded(forcing_periods / frequency_of(the_case));
}

MapPanel settling_panel(const std::string& duration) {
  return {"{/:Italic D}\u00a0that settles in " + duration + " s", "--duration " + duration};
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
      period_axis(the_case, 0.005, 0.4), backlash_axis(the_case),
      {settling_panel(patient), settling_panel(quick)});
}

std::vector<MapPanel> backlash_panels(const Case& the_case, const std::string& duration) {
  std::vector<MapPanel> panels = {
      {"without backlash", "--duration " + duration + " --set backlash.width=0"}};
  const double width = the_case.backlash.width;
  if (width > 0.0) {
    panels.push_back({"backlash\u00a0{/:Italic r}_0\u00a0= " + format_rounded(1e3 * width) + " mm",
                      "--duration " + duration});
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

/// With the limit of Fig. 5 over the same abscissa.
Figure frequency_delay_figure(const Case& the_case) {
  const std::string name = "success-frequency-delay";
  const double lowest = 0.5, highest = 5.0, frequency = frequency_of(the_case);
  const std::string duration = duration_of(the_case, 2000.0);
  const MapAxis period = period_axis(the_case, 0.01, 1.0);
  const double abscissa = the_case.wind ? the_case.wind->speed / frequency : 1.0;
  Figure figure = success_figure(
      name, "For which frequencies and delays control still helps",
      frequency_delay_caption(the_case, duration), frequency_axis(the_case, lowest, highest),
      period, backlash_panels(the_case, duration),
      "@-limit@ using ($1*" + format_number(abscissa) + "):(" + shown_on(period, "$3") + ")");
  figure.tables.push_back(
      {name + "-limit", words_of("max-delay --criterion attenuates --frequency " +
                                 format_number(lowest * frequency) + ":" +
                                 format_number(highest * frequency) + ":91")});
  return figure;
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
