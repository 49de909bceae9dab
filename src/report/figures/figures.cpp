#include "report/figures/figures.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "case/model/cable_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "io/text/text.hpp"
#include "jobs/cable/cable_decay.hpp"
#include "report/figures/motion_figures.hpp"
#include "report/figures/sweep_figures.hpp"

namespace holdfast::program {
namespace {

using Figures = std::vector<Figure>;

void add_cable(Figures& figures) {
  figures.push_back(statics_figure(
      "fig02a", "Fig. 2a: displacement and force at the absorber",
      "Both count from the equilibrium with the absorber's weight, downward. The exact statics "
      "are two elastic catenaries; the plant has a straight spring.",
      "-1:1:81"));
  figures.push_back(peaks_figure(
      "fig02b", "Fig. 2b: first peak after the same force is removed",
      "The continuous cable and the plant let go of the same force. The discrepancy is of their "
      "first peaks above the equilibrium.",
      "0.05:1:20", {}));
  figures.push_back(peaks_figure("fig02c", "Fig. 2c: first peak after the same displacement",
                                 "As Fig. 2b, but the plant starts as far displaced as the cable.",
                                 "0.05:1:20", {"--equal-displacement"}));
  figures.push_back(decay_figure(
      "fig02d", "Fig. 2d: vibration after 0.2 N is removed, from 3.76 mm",
      "The ripple of the continuous cable at the start is a higher mode. Its decay is slower than "
      "the plant's: two per cent of Rayleigh damping do not give the paper's decrement.",
      "0.2", "2"));
}

void add_stability_charts(Figures& figures) {
  figures.push_back(stability_figure("fig03", "Fig. 3: stable gains without delay",
                                     "Shaded: gains with which the continuous loop is "
                                     "asymptotically stable. Line: closed-form boundary.",
                                     {-2000, 500, -120, 40}, {"--continuous"}));
  figures.push_back(stability_figure("fig04a", "Fig. 4a: stable gains, τ = 10 ms",
                                     "Shaded: gains with which the sampled loop is asymptotically "
                                     "stable. Lines: closed-form boundary.",
                                     {-1000, 200, -40, 20},
                                     {"--set", "control.sampling_period=0.01"}));
  figures.push_back(
      stability_figure("fig04b", "Fig. 4b: stable gains, τ = 50 ms",
                       "As Fig. 4a. P = −557 N/m lies to the left of the whole stable region.",
                       {-600, 200, -20, 20}, {"--set", "control.sampling_period=0.05"}));
  figures.push_back(delay_charts_figure("fig04c", "Fig. 4a with a processing delay, τ = 10 ms",
                                        "Shaded: stable. Solid: pair λ = e^{±iθ}; dashed: root λ = "
                                        "−1. The force arrives at once, half "
                                        "a period and a whole period after its sample.",
                                        {-1000, 200, -60, 20}, 0.01));
  figures.push_back(delay_charts_figure("fig04d", "Fig. 4b with a processing delay, τ = 50 ms",
                                        "As above.", {-600, 200, -20, 20}, 0.05));
}

void add_histories(Figures& figures) {
  const auto fine = loop_settings("0.001", "0.0005");
  const auto coarse = loop_settings("0.01", "0.002");
  figures.push_back(history_figure(
      "fig06a", "Fig. 6a: the first second",
      "Conductor from rest; τ = 1 ms, r₀ = 0.5 mm. Positive is downward.", "0", "1", fine));
  figures.push_back(history_figure("fig06b", "Fig. 6b: the steady motion",
                                   "As Fig. 6a, nine seconds later.", "9", "10", fine));
  figures.push_back(
      kick_figure("fig07a", "Fig. 7a: a 3 mm perturbation, τ = 1 ms, r₀ = 0.5 mm",
                  "The conductor is displaced by 3 mm at t = 0.95 s, away from its equilibrium.",
                  "0.95:-0.003", fine));
  figures.push_back(
      kick_figure("fig07b", "Fig. 7b: a 3 mm perturbation, τ = 10 ms, r₀ = 2 mm",
                  "The conductor is displaced by 3 mm at t = 0.84 s, away from its equilibrium.",
                  "0.84:-0.003", coarse));
  figures.push_back(contact_figure(
      "fig08a", "Fig. 8a: relative velocity and backlash",
      "Steady motion, τ = 1 ms, r₀ = 0.5 mm. The drive enters its backlash where the "
      "relative velocity changes sign.",
      "9", "9.5", paper_contact_scale, fine));
  figures.push_back(
      contact_figure("fig08b", "Fig. 8b: half a period of it enlarged",
                     "In at 9.065 s, out at 9.068 s, in again at 9.069 s, out at 9.095 s.", "9.06",
                     "9.11", paper_contact_scale, fine));
}

void add_phase_diagrams(Figures& figures) {
  figures.push_back(phase_figure("fig09a", "Fig. 9a: phase diagram, τ = 1 ms, r₀ = 0.5 mm",
                                 "Steady motion of the conductor, from 30 s on.", "30.5",
                                 loop_settings("0.001", "0.0005")));
  figures.push_back(
      phase_figure("fig09b", "Fig. 9b: phase diagram, τ = 1 ms, r₀ = 2 mm",
                   "The larger backlash brings in a slow component: the curve closes after 0.5 s.",
                   "31", loop_settings("0.001", "0.002")));
  figures.push_back(
      phase_figure("fig09c", "Fig. 9c: phase diagram, τ = 11 ms, r₀ = 2 mm",
                   "The slow computer makes the motion look irregular. Samples are joined by "
                   "straight lines.",
                   "40", loop_settings("0.011", "0.002")));
}

void add_characteristics(Figures& figures) {
  const auto fast = loop_settings("0.001", "0.002");
  const auto slow = loop_settings("0.011", "0.002");
  figures.push_back(
      spectrum_figure("fig10a", "Fig. 10a: spectrum, τ = 1 ms, r₀ = 2 mm",
                      "Amplitude of z₁ over whole forcing periods, transient left out.", fast));
  figures.push_back(spectrum_figure("fig10b", "Fig. 10b: spectrum, τ = 11 ms, r₀ = 2 mm",
                                    "As Fig. 10a; many small lines appear.", slow));
  figures.push_back(deviation_figure("fig11a",
                                     "Fig. 11a: deviation of neighbours, τ = 1 ms, r₀ = 2 mm",
                                     "Two motions that start 10⁻⁵ m apart.", fast));
  figures.push_back(deviation_figure(
      "fig11b", "Fig. 11b: deviation of neighbours, τ = 11 ms, r₀ = 2 mm", "As Fig. 11a.", slow));
  for (const std::string panel : {"a", "b", "c"}) {
    const std::string duration = panel == "a" ? "10" : panel == "b" ? "100" : "1000";
    figures.push_back(filling_figure(
        "fig12" + panel, "Fig. 12" + panel + ": samples in a small window, " + duration + " s",
        "Samples of the motion with τ = 11 ms, r₀ = 2 mm in a part of the phase plane.", duration,
        slow));
  }
  figures.push_back(exponent_figure("fig13a", "Fig. 13a: Lyapunov exponents, τ = 1 ms, r₀ = 2 mm",
                                    "The three largest exponents as they settle, printed tangent.",
                                    "printed", "0", "-0.06:0.03", fast));
  figures.push_back(exponent_figure("fig13b", "Fig. 13b: Lyapunov exponents, τ = 11 ms, r₀ = 2 mm",
                                    "As Fig. 13a.", "printed", "0", "-0.3:0.15", slow));
  const std::string caption =
      "Bars: standard error by batch means. The fifth exponent is −∞ and not drawn; the paper "
      "prints ";
  figures.push_back(exponent_table_figure("table2a", "Table 2: Lyapunov exponents, τ = 1 ms, 10 s",
                                          caption + "−33.26.", "10",
                                          {-0.0010, -0.0014, -0.0476, -0.0497}, fast));
  figures.push_back(exponent_table_figure(
      "table2b", "Table 2: Lyapunov exponents, τ = 11 ms, 100 s", caption + "−29.23.", "100",
      {-0.0140, -0.0148, -0.1855, -0.4789}, slow));
}

/// A window of gains around those of the case, as wide as the gains themselves.
ChartWindow window_around(const PdGains<double>& gains, const TwoMass<double>& plant) {
  const double p_reach = std::max(std::abs(gains.proportional), plant.absorber_stiffness);
  const double d_reach =
      std::max({2.0 * std::abs(gains.differential), 5.0 * plant.absorber_damping, p_reach / 100.0});
  return {gains.proportional - p_reach, gains.proportional + p_reach, gains.differential - d_reach,
          gains.differential + d_reach};
}

/// The loop of a case, whatever its plant comes from.
std::vector<Figure> loop_figures(const Case& the_case) {
  return {
      stability_figure(
          "stability", "Stable gains",
          "Shaded: gains with which the sampled loop is asymptotically stable. Lines: closed-form "
          "boundary. The case's own gains are at the centre.",
          window_around(gains_of(the_case), plant_of(the_case)), {}),
      delay_figure("delay", "Largest sampling period",
                   "P is tuned to the excitation frequency, D is the best for each period.", {}),
      history_figure("history", "The first second",
                     "Conductor from its initial state. Positive is downward.", "0", "1", {}),
      history_figure("steady", "The steady motion", "As above, nine seconds later.", "9", "10", {}),
      contact_figure("contact", "Relative velocity and backlash",
                     "The drive enters its backlash where the relative velocity changes sign.", "9",
                     "9.5", own_contact_scale, {}),
      phase_figure("phase", "Phase diagram", "Steady motion of the conductor, from 30 s on.", "40",
                   {}),
      spectrum_figure("spectrum", "Spectrum", "Amplitude of z₁ over whole forcing periods.", {}),
      deviation_figure("deviation", "Deviation of neighbours",
                       "Two motions that start 10⁻⁵ m apart.", {}),
      exponent_figure("exponents", "Lyapunov exponents",
                      "The three largest exponents as they settle. A motion that settles to a "
                      "periodic one has none above zero.",
                      "consistent", "1", "*:*", {})};
}

}  // namespace

std::vector<Figure> paper_figures() {
  Figures figures;
  add_cable(figures);
  add_stability_charts(figures);
  figures.push_back(
      delay_figure("fig05", "Fig. 5: largest sampling period",
                   "P is tuned to the excitation frequency, D is the best for each period. The "
                   "control attenuates below the line.",
                   {},
                   "set arrow from 4.1, graph 0 to 4.1, graph 1 nohead lc rgb '#444444' dt 3\n"
                   "set label '4.1 Hz' at 4.6, 1.4 tc rgb '#444444'\n"));
  figures.push_back(design_figure(
      "fig05b", "Best differential gain and its attenuation",
      "P is tuned to the excitation frequency, D leaves the least steady amplitude of all "
      "stabilising D. Positive: the amplitude is lower than without control. Lines end where no D "
      "stabilises.",
      {0.001, 0.01, 0.02}));
  add_histories(figures);
  add_phase_diagrams(figures);
  add_characteristics(figures);
  for (Figure& figure : motion_figures()) figures.push_back(std::move(figure));
  for (Figure& figure : paper_success_figures()) figures.push_back(std::move(figure));
  return figures;
}

std::vector<Figure> case_figures(const Case& the_case) {
  Figures figures = loop_figures(the_case);
  for (Figure& figure : success_figures(the_case)) figures.push_back(std::move(figure));
  if (!plant_is_reduced(the_case)) return figures;
  const CableDecayOptions decay = usual_decay(the_case);
  const std::string force = format_number(decay.force);
  figures.insert(
      figures.begin(),
      {statics_figure("statics", "Displacement and force at the absorber",
                      "Both count from the equilibrium with the absorber's weight, downward.",
                      "-" + force + ":" + force + ":41"),
       decay_figure("decay", "Vibration after " + force + " N is removed",
                    "The continuous cable, and the plant from the same displacement.", force,
                    format_number(decay.duration))});
  return figures;
}

}  // namespace holdfast::program
