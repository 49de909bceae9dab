#include "report/figures/figures.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "case/model/cable_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "io/text/text.hpp"
#include "jobs/cable/cable_decay.hpp"
#include "report/figures/figure_kinds.hpp"

namespace holdfast::program {
namespace {

using Figures = std::vector<Figure>;

/// A figure of a kind with what the texts of the kind leave open.
Figure figure(const FigureKind& kind, const std::string& name, const std::string& title,
              const std::string& caption, Values values = {}) {
  values.emplace_back("settings", "");  // where there are none
  values.emplace_back("ideal",
                      "--set control.sampling_period=0.0001 --set control.processing_delay=0 --set "
                      "backlash.width=0");
  Figure made{name, title, caption, {}, filled(kind.plot, values), kind.height};
  for (const auto& [suffix, command] : kind.tables)
    if (command != nullptr)
      made.tables.push_back({name + suffix, words_of(filled(command, values))});
  return made;
}

using namespace figure_kinds;

// The loops of the paper's figures.
constexpr const char* fine_settings =
    "--set control.sampling_period=0.001 --set backlash.width=0.0005";
constexpr const char* fast = "--set control.sampling_period=0.001 --set backlash.width=0.002";
constexpr const char* coarse_settings =
    "--set control.sampling_period=0.01 --set backlash.width=0.002";
constexpr const char* slow = "--set control.sampling_period=0.011 --set backlash.width=0.002";

// Whether the drive is in its backlash: as in the paper, whose velocities stay below 0.1 m/s, and
// for a motion of any size, on an axis of its own.
constexpr const char* paper_axes = "set yrange [-0.08:0.12]\n";
constexpr const char* paper_contact =
    "1:($7 == 1 ? 0 : 0.1) with steps ls 2 title '0 in the backlash, 0.1 outside'";
constexpr const char* own_axes =
    "set border 11\nset ytics nomirror\nset y2range [-0.5:1.5]\n"
    "set y2tics ('inside' 0, 'outside' 1)\nset y2label 'backlash'\n";
constexpr const char* own_contact =
    "1:($7 == 1 ? 0 : 1) axes x1y2 with steps ls 2 title 'in the backlash or not (right)'";

constexpr const char* in_window =
    "Samples of the motion with τ = 11 ms, r₀ = 2 mm in a part of the phase plane.";

Figures figures_2_and_3() {
  return {
      figure(statics, "fig02a", "Fig. 2a: displacement and force at the absorber",
             "Both count from the equilibrium with the absorber's weight, downward. The exact "
             "statics are two elastic catenaries; the plant has a straight spring.",
             {{"force", "-1:1:81"}}),
      figure(peaks, "fig02b", "Fig. 2b: first peak after the same force is removed",
             "The continuous cable and the plant let go of the same force. The discrepancy is of "
             "their first peaks above the equilibrium."),
      figure(peaks, "fig02c", "Fig. 2c: first peak after the same displacement",
             "As Fig. 2b, but the plant starts as far displaced as the cable.",
             {{"settings", "--equal-displacement"}}),
      figure(
          decay, "fig02d", "Fig. 2d: vibration after 0.2 N is removed, from 3.76 mm",
          "The ripple of the continuous cable at the start is a higher mode. Its decay is slower "
          "than the plant's: two per cent of Rayleigh damping do not give the paper's decrement.",
          {{"force", "0.2"}, {"duration", "2"}}),
      figure(stability, "fig03", "Fig. 3: stable gains without delay",
             "Shaded: gains with which the continuous loop is asymptotically stable. Line: "
             "closed-form boundary.",
             {{"P", "-2000:500"},
              {"D", "-120:40"},
              {"curves", continuous_curves},
              {"settings", "--continuous"}})};
}

Figures figures_4_and_5() {
  return {
      figure(stability, "fig04a", "Fig. 4a: stable gains, τ = 10 ms",
             "Shaded: gains with which the sampled loop is asymptotically stable. Lines: "
             "closed-form boundary.",
             {{"P", "-1000:200"},
              {"D", "-40:20"},
              {"curves", sampled_curves},
              {"settings", "--set control.sampling_period=0.01"}}),
      figure(stability, "fig04b", "Fig. 4b: stable gains, τ = 50 ms",
             "As Fig. 4a. P = −557 N/m lies to the left of the whole stable region.",
             {{"P", "-600:200"},
              {"D", "-20:20"},
              {"curves", sampled_curves},
              {"settings", "--set control.sampling_period=0.05"}}),
      figure(delay_charts, "fig04c", "Fig. 4a with a processing delay, τ = 10 ms",
             "Shaded: stable. Solid: pair λ = e^{±iθ}; dashed: root λ = −1. The force arrives at "
             "once, half a period and a whole period after its sample.",
             {{"P", "-1000:200"},
              {"D", "-60:20"},
              {"half", "0.005"},
              {"tau", "0.01"},
              {"settings", "--set control.sampling_period=0.01 --set control.processing_delay"}}),
      figure(delay_charts, "fig04d", "Fig. 4b with a processing delay, τ = 50 ms", "As above.",
             {{"P", "-600:200"},
              {"D", "-20:20"},
              {"half", "0.025"},
              {"tau", "0.05"},
              {"settings", "--set control.sampling_period=0.05 --set control.processing_delay"}}),
      figure(longest_period, "fig05", "Fig. 5: largest sampling period",
             "P is tuned to the excitation frequency, D is the best for each period. The control "
             "attenuates below the line.",
             {{"remark",
               "set arrow from 4.1, graph 0 to 4.1, graph 1 nohead lc rgb '#444444' dt 3\n"
               "set label '4.1 Hz' at 4.6, 1.4 tc rgb '#444444'\n"}}),
      figure(design, "fig05b", "Best differential gain and its attenuation",
             "P is tuned to the excitation frequency, D leaves the least steady amplitude of all "
             "stabilising D. Positive: the amplitude is lower than without control. Lines end "
             "where no D stabilises.")};
}

Figures figures_6_to_9() {
  return {
      figure(history, "fig06a", "Fig. 6a: the first second",
             "Conductor from rest; τ = 1 ms, r₀ = 0.5 mm. Positive is downward.",
             {{"from", "0"}, {"to", "1"}, {"settings", fine_settings}}),
      figure(history, "fig06b", "Fig. 6b: the steady motion", "As Fig. 6a, nine seconds later.",
             {{"from", "9"}, {"to", "10"}, {"settings", fine_settings}}),
      figure(kick, "fig07a", "Fig. 7a: a 3 mm perturbation, τ = 1 ms, r₀ = 0.5 mm",
             "The conductor is displaced by 3 mm at t = 0.95 s, away from its equilibrium.",
             {{"kick", "0.95:-0.003"}, {"settings", fine_settings}}),
      figure(kick, "fig07b", "Fig. 7b: a 3 mm perturbation, τ = 10 ms, r₀ = 2 mm",
             "The conductor is displaced by 3 mm at t = 0.84 s, away from its equilibrium.",
             {{"kick", "0.84:-0.003"}, {"settings", coarse_settings}}),
      figure(contact, "fig08a", "Fig. 8a: relative velocity and backlash",
             "Steady motion, τ = 1 ms, r₀ = 0.5 mm. The drive enters its backlash where the "
             "relative velocity changes sign.",
             {{"from", "9"},
              {"to", "9.5"},
              {"settings", fine_settings},
              {"axes", paper_axes},
              {"contact", paper_contact}}),
      figure(contact, "fig08b", "Fig. 8b: half a period of it enlarged",
             "In at 9.065 s, out at 9.068 s, in again at 9.069 s, out at 9.095 s.",
             {{"from", "9.06"},
              {"to", "9.11"},
              {"settings", fine_settings},
              {"axes", paper_axes},
              {"contact", paper_contact}}),
      figure(phase, "fig09a", "Fig. 9a: phase diagram, τ = 1 ms, r₀ = 0.5 mm",
             "Steady motion of the conductor, from 30 s on.",
             {{"duration", "30.5"}, {"settings", fine_settings}}),
      figure(phase, "fig09b", "Fig. 9b: phase diagram, τ = 1 ms, r₀ = 2 mm",
             "The larger backlash brings in a slow component: the curve closes after 0.5 s.",
             {{"duration", "31"}, {"settings", fast}}),
      figure(phase, "fig09c", "Fig. 9c: phase diagram, τ = 11 ms, r₀ = 2 mm",
             "The slow computer makes the motion look irregular. Samples are joined by straight "
             "lines.",
             {{"duration", "40"}, {"settings", slow}})};
}

Figures figures_10_to_13() {
  return {
      figure(spectrum, "fig10a", "Fig. 10a: spectrum, τ = 1 ms, r₀ = 2 mm",
             "Amplitude of z₁ over whole forcing periods, transient left out.",
             {{"settings", fast}}),
      figure(spectrum, "fig10b", "Fig. 10b: spectrum, τ = 11 ms, r₀ = 2 mm",
             "As Fig. 10a; many small lines appear.", {{"settings", slow}}),
      figure(deviation, "fig11a", "Fig. 11a: deviation of neighbours, τ = 1 ms, r₀ = 2 mm",
             "Two motions that start 10⁻⁵ m apart.", {{"settings", fast}}),
      figure(deviation, "fig11b", "Fig. 11b: deviation of neighbours, τ = 11 ms, r₀ = 2 mm",
             "As Fig. 11a.", {{"settings", slow}}),
      figure(filling, "fig12a", "Fig. 12a: samples in a small window, 10 s", in_window,
             {{"duration", "10"}, {"settings", slow}}),
      figure(filling, "fig12b", "Fig. 12b: samples in a small window, 100 s", in_window,
             {{"duration", "100"}, {"settings", slow}}),
      figure(filling, "fig12c", "Fig. 12c: samples in a small window, 1000 s", in_window,
             {{"duration", "1000"}, {"settings", slow}}),
      figure(exponents, "fig13a", "Fig. 13a: Lyapunov exponents, τ = 1 ms, r₀ = 2 mm",
             "The three largest exponents as they settle, printed tangent.",
             {{"tangent", "printed"}, {"from", "0"}, {"range", "-0.06:0.03"}, {"settings", fast}}),
      figure(exponents, "fig13b", "Fig. 13b: Lyapunov exponents, τ = 11 ms, r₀ = 2 mm",
             "As Fig. 13a.",
             {{"tangent", "printed"}, {"from", "0"}, {"range", "-0.3:0.15"}, {"settings", slow}})};
}

Figures tables_and_orbits() {
  return {
      figure(exponent_table, "table2a", "Table 2: Lyapunov exponents, τ = 1 ms, 10 s",
             "Bars: standard error by batch means. The fifth exponent is −∞ and not drawn; the "
             "paper prints −33.26.",
             {{"duration", "10"},
              {"published", "1,-0.001\n2,-0.0014\n3,-0.0476\n4,-0.0497\n"},
              {"settings", fast}}),
      figure(exponent_table, "table2b", "Table 2: Lyapunov exponents, τ = 11 ms, 100 s",
             "Bars: standard error by batch means. The fifth exponent is −∞ and not drawn; the "
             "paper prints −29.23.",
             {{"duration", "100"},
              {"published", "1,-0.014\n2,-0.0148\n3,-0.1855\n4,-0.4789\n"},
              {"settings", slow}}),
      figure(orbits, "orbits", "The exact orbits behind Figs. 9b and 9c",
             "Each picture is one whole period of a motion that repeats exactly, without any "
             "transient. Points: samples; lines join them. With τ = 11 ms the orbit has 2100 "
             "samples and takes 23.1 s, 231 forcing periods: longer than the eye finds in Fig. 9c. "
             "With τ = 1 ms it takes 0.5 s, five forcing periods. r₀ = 2 mm in both, from rest.",
             {{"slow", slow}, {"fast", fast}}),
      figure(section, "section", "Poincaré section of the motion, τ = 11 ms, r₀ = 2 mm",
             "A point for every instant at which conductor and absorber have the same velocity, "
             "found between the samples: there the drive reverses. 23.1 s from 30 s on are one "
             "period of the motion, so the points are all that there will ever be.",
             {{"settings", slow}})};
}

Figures diagrams_and_basins() {
  return {
      figure(diagram, "diagram-backlash", "Motions over the backlash, τ = 11 ms",
             "At each width of the backlash: z₁ at 20 forcing periods in a row, after 30 s. The "
             "width goes up and then back, each motion beginning where the last one ended. A few "
             "points belong to a short period; of a long one 20 points are seen, others on the way "
             "back. Where few points differ between the two ways, motions coexist.",
             {{"axis", "backlash.width=0:0.003:151"},
              {"label", "backlash {/:Italic r}_0 (mm)"},
              {"scale", "1000"},
              {"settings", "--set control.sampling_period=0.011"}}),
      figure(diagram, "diagram-gain", "Motions over the differential gain, τ = 11 ms, r₀ = 2 mm",
             "At each differential gain D: z₁ at 20 forcing periods in a row, after 30 s, D going "
             "up and then back. A few points belong to a short period, a column of many to a long "
             "one. The paper's motions have D = −13 N s/m.",
             {{"axis", "control.differential_gain=-16:0:161"},
              {"label", "differential gain {/:Italic D} (N s/m)"},
              {"scale", "1"},
              {"settings", slow}}),
      figure(basins, "basins", "Which motion a start comes to, τ = 11 ms, r₀ = 2 mm",
             "Both masses start at rest from the displacements shown, positive downward. Each "
             "colour is one periodic motion, whatever its phase; the legend has its period and the "
             "share of the starts that come to it. Two of the same period mirror each other: all "
             "signs changed, half a forcing period later.",
             {{"range", "-0.005:0.005:101"}, {"settings", slow}})};
}

/// A window of gains around those of the case, as wide as the gains themselves.
Figure figure_of_gains(const PdGains<double>& gains, const TwoMass<double>& plant) {
  const auto about = [](double centre, double reach) {
    return format_number(centre - reach) + ":" + format_number(centre + reach);
  };
  const double p_reach = std::max(std::abs(gains.proportional), plant.absorber_stiffness);
  const double d_reach =
      std::max({2.0 * std::abs(gains.differential), 5.0 * plant.absorber_damping, p_reach / 100.0});
  return figure(stability, "stability", "Stable gains",
                "Shaded: gains with which the sampled loop is asymptotically stable. Lines: "
                "closed-form boundary. The case's own gains are at the centre.",
                {{"P", about(gains.proportional, p_reach)},
                 {"D", about(gains.differential, d_reach)},
                 {"curves", sampled_curves}});
}

/// The loop of a case, whatever its plant comes from.
Figures figures_of_loop(const PdGains<double>& gains, const TwoMass<double>& plant) {
  return {figure_of_gains(gains, plant),
          figure(longest_period, "delay", "Largest sampling period",
                 "P is tuned to the excitation frequency, D is the best for each period.",
                 {{"remark", ""}}),
          figure(history, "history", "The first second",
                 "Conductor from its initial state. Positive is downward.",
                 {{"from", "0"}, {"to", "1"}}),
          figure(history, "steady", "The steady motion", "As above, nine seconds later.",
                 {{"from", "9"}, {"to", "10"}}),
          figure(contact, "contact", "Relative velocity and backlash",
                 "The drive enters its backlash where the relative velocity changes sign.",
                 {{"from", "9"}, {"to", "9.5"}, {"axes", own_axes}, {"contact", own_contact}}),
          figure(phase, "phase", "Phase diagram", "Steady motion of the conductor, from 30 s on.",
                 {{"duration", "40"}}),
          figure(spectrum, "spectrum", "Spectrum", "Amplitude of z₁ over whole forcing periods."),
          figure(deviation, "deviation", "Deviation of neighbours",
                 "Two motions that start 10⁻⁵ m apart."),
          figure(exponents, "exponents", "Lyapunov exponents",
                 "The three largest exponents as they settle. A motion that settles to a periodic "
                 "one has none above zero.",
                 {{"tangent", "consistent"}, {"from", "1"}, {"range", "*:*"}})};
}

Figures figures_of_cable(const Case& the_case) {
  const CableDecayOptions options = usual_decay(the_case);
  const std::string force = format_number(options.force);
  return {figure(statics, "statics", "Displacement and force at the absorber",
                 "Both count from the equilibrium with the absorber's weight, downward.",
                 {{"force", "-" + force + ":" + force + ":41"}}),
          figure(decay, "decay", "Vibration after " + force + " N is removed",
                 "The continuous cable, and the plant from the same displacement.",
                 {{"force", force}, {"duration", format_number(options.duration)}})};
}

Figures joined(std::initializer_list<Figures> parts) {
  Figures all;
  for (const Figures& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace

std::vector<Figure> paper_figures() {
  return joined({figures_2_and_3(), figures_4_and_5(), figures_6_to_9(), figures_10_to_13(),
                 tables_and_orbits(), diagrams_and_basins(), paper_success_figures()});
}

std::vector<Figure> case_figures(const Case& the_case) {
  return joined({plant_is_reduced(the_case) ? figures_of_cable(the_case) : Figures(),
                 figures_of_loop(gains_of(the_case), plant_of(the_case)),
                 success_figures(the_case)});
}

}  // namespace holdfast::program
