#include "report/figures/motion_figures.hpp"

#include "io/text/text.hpp"
#include "report/figures/figure_text.hpp"

namespace holdfast::program {
namespace {

using Arguments = std::vector<std::string>;

/// The legend of basins: the numbers and texts that gnuplot collects from the table of shares.
constexpr const char* collect_shares =
    "numbers = ''\n"
    "texts = ''\n"
    "fate(k, period, share) = (k < 0 ? 'no orbit found' : k == 0 ? 'diverges' : "
    "sprintf('period %.3g s', period)).sprintf(': %.3g %%', 100*share)\n"
    "note(k, period, share) = (numbers = numbers.sprintf('%d ', k), "
    "texts = texts.'\"'.fate(k, period, share).'\" ', k)\n";

// Colours of M. Okabe and K. Ito; black: no orbit found, grey: diverges, then one an attractor.
// Those of the first attractors differ in lightness too.
constexpr const char* basin_colours =
    "set palette maxcolors 10\n"
    "set palette defined (-1 '#000000', 0 '#bbbbbb', 1 '#0072b2', 2 '#f0e442', 3 '#e69f00', "
    "4 '#009e73', 5 '#cc79a7', 6 '#56b4e9', 7 '#d55e00', 8 '#666666')\n"
    "set cbrange [-1.5:8.5]\nunset colorbox\n";

}  // namespace

Figure diagram_figure(const std::string& name, const std::string& title, const std::string& caption,
                      const FigureAxis& axis, const std::vector<std::string>& settings) {
  Figure figure{name, title, caption, {}, "", 480.0};
  figure.tables = {
      {name,
       joined({"diagram", "--axis", axis.key + "=" + axis.range, "--strobes", "20"}, settings)}};
  const auto points = [&](const char* upward, const char* colour) {
    return "plot @" + name + "@ using ($1*" + format_number(axis.scale) + "):($2 == " + upward +
           " ? $3*1e3 : NaN) with points pt 7 ps 0.2 lc rgb '" + colour + "'\n";
  };
  const std::string displacement = "{/:Italic z}_1 (mm)";
  figure.plot =
      "stats @" + name + "@ using 3 nooutput\n" +
      "unset key\nset multiplot layout 2,1 margins 0.13,0.97,0.15,0.93 spacing 0,0.09\n"
      "set autoscale xfix\nset yrange [floor(2e3*STATS_min)/2.0:ceil(2e3*STATS_max)/2.0]\n"
      "set format x ''\nset title 'on the way up' offset 0,-0.6\n" +
      axes("", displacement) + points("1", "#0072b2") +
      "set format x '%g'\nset title 'on the way back'\n" + axes(axis.label, displacement) +
      points("0", "#d55e00") + "unset multiplot\n";
  return figure;
}

Figure basins_figure(const std::string& name, const std::string& title, const std::string& caption,
                     const std::string& range, const std::vector<std::string>& settings) {
  const Arguments grid = joined(
      {"basins", "--axis", "initial.z1=" + range, "--axis", "initial.z2=" + range}, settings);
  Figure figure{name, title, caption, {}, "", 520.0};
  figure.tables = {{name + "-states", grid}, {name + "-shares", joined(grid, {"--fractions"})}};
  figure.plot = collect_shares +
                ("stats @" + name + "-shares@ using (note($1, $3, $7)) nooutput\n") +
                basin_colours +
                axes("initial displacement of the conductor {/:Italic z}_1 (mm)",
                     "initial displacement of the absorber {/:Italic z}_2 (mm)") +
                "set size ratio -1\nset autoscale fix\nset tics out\n"
                "set key outside top center horizontal maxcols 2 samplen 1 spacing 1.3\n"
                "plot @" +
                name +
                "-states@ using ($1*1e3):($2*1e3):3 with image notitle, \\\n"
                "  for [k=1:words(numbers)] keyentry with points pt 5 ps 1.6 lc palette cb "
                "(word(numbers, k) > 8 ? 8 : word(numbers, k)) title word(texts, k)\n";
  return figure;
}

Figure orbits_figure(const std::string& name, const std::string& title, const std::string& caption,
                     const std::vector<OrbitPanel>& panels) {
  Figure figure{name, title, caption, {}, "", 360.0};
  figure.plot = "unset key\nset multiplot layout 1," + std::to_string(panels.size()) +
                " margins 0.14,0.97,0.21,0.88 spacing 0.12,0\n";
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const std::string table = name + "-" + std::to_string(k + 1);
    figure.tables.push_back({table, joined({"orbit", "--trace"}, panels[k].settings)});
    figure.plot +=
        "set title \"" + panels[k].heading + "\"\n" +
        axes("displacement {/:Italic z}_1 (mm)", k == 0 ? "velocity {/:Italic v}_1 (m/s)" : "") +
        "plot @" + table +
        "@ using ($2*1e3):3 with lines lw 0.4 lc rgb '#56b4e9', \\\n"
        "  '' using ($2*1e3):3 with points pt 7 ps 0.18 lc rgb '#0072b2'\n";
  }
  figure.plot += "unset multiplot\n";
  return figure;
}

Figure section_figure(const std::string& name, const std::string& title, const std::string& caption,
                      const std::string& from, const std::string& to,
                      const std::vector<std::string>& settings) {
  Figure figure{name, title, caption, {}, "", 400.0};
  figure.tables = {{name, joined({"section", "--duration", to, "--from", from}, settings)}};
  const auto crossings = [](const char* rising) {
    return std::string("using ($5 == ") + rising + " ? $2*1e3 : NaN):3 with points ";
  };
  figure.plot = axes("displacement {/:Italic z}_1 (mm)",
                     "common velocity {/:Italic v}_1 = {/:Italic v}_2 (m/s)") +
                "plot @" + name + "@ " + crossings("1") +
                "pt 7 ps 0.4 lc rgb '#0072b2' title 'absorber turns downward', \\\n  '' " +
                crossings("0") + "pt 6 ps 0.5 lc rgb '#d55e00' title 'turns upward'\n";
  return figure;
}

std::vector<Figure> motion_figures() {
  const Arguments slow = loop_settings("0.011", "0.002");
  const Arguments slow_computer = {"--set", "control.sampling_period=0.011"};
  return {
      orbits_figure(
          "orbits", "The exact orbits behind Figs. 9b and 9c",
          "Each picture is one whole period of a motion that repeats exactly, without any "
          "transient. Points: samples; lines join them. With τ = 11 ms the orbit has 2100 samples "
          "and takes 23.1 s, 231 forcing periods: longer than the eye finds in Fig. 9c. With τ = "
          "1 ms it takes 0.5 s, five forcing periods. r₀ = 2 mm in both, from rest.",
          {{"τ = 11 ms", slow}, {"τ = 1 ms", loop_settings("0.001", "0.002")}}),
      section_figure(
          "section", "Poincaré section of the motion, τ = 11 ms, r₀ = 2 mm",
          "A point for every instant at which conductor and absorber have the same velocity, found "
          "between the samples: there the drive reverses. 23.1 s from 30 s on are one period of "
          "the motion, so the points are all that there will ever be.",
          "30", "53.1", slow),
      diagram_figure(
          "diagram-backlash", "Motions over the backlash, τ = 11 ms",
          "At each width of the backlash: z₁ at 20 forcing periods in a row, after 30 s. The width "
          "goes up and then back, each motion beginning where the last one ended. A few points "
          "belong to a short period; of a long one 20 points are seen, others on the way back. "
          "Where few points differ between the two ways, motions coexist.",
          {"backlash.width", "0:0.003:151", "backlash {/:Italic r}_0 (mm)", 1e3}, slow_computer),
      diagram_figure(
          "diagram-gain", "Motions over the differential gain, τ = 11 ms, r₀ = 2 mm",
          "At each differential gain D: z₁ at 20 forcing periods in a row, after 30 s, D going up "
          "and then back. A few points belong to a short period, a column of many to a long one. "
          "The paper's motions have D = −13 N s/m.",
          {"control.differential_gain", "-16:0:161", "differential gain {/:Italic D} (N s/m)", 1.0},
          slow),
      basins_figure(
          "basins", "Which motion a start comes to, τ = 11 ms, r₀ = 2 mm",
          "Both masses start at rest from the displacements shown, positive downward. Each colour "
          "is one periodic motion, whatever its phase; the legend has its period and the share of "
          "the starts that come to it. Two of the same period mirror each other: all signs "
          "changed, half a forcing period later.",
          "-0.005:0.005:101", slow)};
}

}  // namespace holdfast::program
