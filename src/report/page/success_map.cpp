#include "report/page/success_map.hpp"

#include <cmath>

#include "io/text/text.hpp"
#include "report/figures/figure_text.hpp"

namespace holdfast::program {
namespace {

using Arguments = std::vector<std::string>;

const std::string cells_of_axis = "61";

// Blue to orange over white is told apart by all kinds of colour vision; in grey blue and orange
// are alike, so that marks stand on what amplifies. Half a per cent of an amplitude is no
// difference: a motion that ends inside its backlash differs by the rest of its transient. A
// hundredfold one has only not been followed long enough to leave the range of numbers.
constexpr const char* shades =
    "set palette maxcolors 12\n"
    "set palette defined (-2 '#e6e6e6', -1 '#c4c4c4', 0 '#084a91', 1 '#3b8bc2', 2 '#86bcdc', "
    "3 '#c9e0f0', 4 '#fbfbfb', 5 '#fde0b6', 6 '#fbb968', 7 '#e88224', 8 '#b04a00', 9 '#303030')\n"
    "set cbrange [-2.5:9.5]\n"
    "set cbtics ('2{/:Italic f}τ ≥ 1' -2, 'no\u00a0{/:Italic D}' -1, '< ¼' 0, '¼ – ½' 1, "
    "'½ – ¾' 2, '¾ – 1' 3, '1' 4, '1 – 1½' 5, '1½ – 2' 6, '2 – 4' 7, '> 4' 8, 'diverges' 9) "
    "scale 0\n";

// The ratio is a text: a cell whose column is missing would be left out and shift the others. At
// rest with control and without it is nan, which `set datafile missing` may leave as no text; a
// number cannot be made of that.
constexpr const char* classes =
    "rests(r, outcome) = outcome eq 'computed' && (r eq 'nan' || r eq '')\n"
    "class(r) = r < 0.25 ? 0 : r < 0.5 ? 1 : r < 0.75 ? 2 : r < 0.995 ? 3 : r <= 1.005 ? 4 : "
    "r <= 1.5 ? 5 : r <= 2 ? 6 : r <= 4 ? 7 : r <= 100 ? 8 : 9\n"
    "shade(r, outcome) = rests(r, outcome) ? 4 : outcome eq 'computed' ? class(r + 0) : "
    "outcome eq 'diverges' ? 9 : outcome eq 'no_gain' ? -1 : outcome eq 'aliased' ? -2 : NaN\n";

/// Which cells bear a mark: every fifth along both axes. Where nothing moves, words say so.
std::string marks() {
  return "marked(k) = int(k) % " + cells_of_axis + " % 5 == 2 && int(k) / " + cells_of_axis +
         " % 5 == 2\n"
         "amplifies(r, outcome, k) = outcome eq 'computed' && r > 1.005 && r <= 100 && marked(k)\n"
         "unsettled(outcome, k) = outcome eq 'no_gain' && marked(k)\n"
         "unseen(outcome, k) = outcome eq 'aliased' && marked(k)\n"
         "remark(r, outcome, k) = rests(r, outcome) && k == 3 * " +
         cells_of_axis + " + 3 ? 'no vibration' : ''\n";
}

constexpr const char* amplifying_mark = "pt 1 ps 0.4 lc rgb '#5a2600'";
constexpr const char* unsettled_mark = "pt 2 ps 0.4 lc rgb '#666666'";
constexpr const char* unseen_mark = "pt 6 ps 0.3 lc rgb '#666666'";
constexpr const char* curve_style = "lw 2 lc rgb '#000000'";

/// A mark and its words above the panels.
std::string explained(int number, const char* mark, const std::string& words, double left) {
  return "set label " + std::to_string(number) + " '" + words + "' at screen " +
         format_number(left) + ",0.955 point " + mark + " offset 0.8,-0.3\n";
}

/// The legend above the panels: their own keys would lie on each other.
std::string legend(const std::string& curve) {
  std::string text =
      explained(1, amplifying_mark, "control amplifies", 0.02) +
      explained(2, unsettled_mark, "no\u00a0{/:Italic D}\u00a0settles in time", 0.23) +
      explained(3, unseen_mark, "sampled too slowly", 0.47);
  if (!curve.empty()) {
    text += std::string("set arrow 1 from screen 0.7,0.955 to screen 0.73,0.955 nohead ") +
            curve_style + "\nset label 4 '" + curve + "' at screen 0.74,0.955\n";
  }
  return text;
}

std::string range_of(const MapAxis& axis) {
  const std::string range = format_number(axis.min) + ":" + format_number(axis.max);
  return axis.key + "=" + (axis.logarithmic ? "log:" : "") + range + ":" + cells_of_axis;
}

/// 1, 2 and 5 times the powers of ten: gnuplot's pictures of cells know no logarithmic axis.
std::string logarithmic_tics(const MapAxis& axis) {
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
  return "(" + tics + ")";
}

std::string range_and_tics(const std::string& letter, const MapAxis& axis) {
  std::string text = "set " + letter + "range [" + shown_on(axis, format_number(axis.min)) + ":" +
                     shown_on(axis, format_number(axis.max)) + "]\n";
  if (axis.logarithmic) text += "set " + letter + "tics " + logarithmic_tics(axis) + "\n";
  return text;
}

/// The panels' place, and the shades' beside them.
std::string layout(std::size_t panels) {
  return "set multiplot layout 1," + std::to_string(panels) +
         " margins 0.115,0.79,0.175,0.835 spacing 0.04,0\n"
         "set colorbox user origin screen 0.81,0.175 size screen 0.025,0.66\n"
         "set cblabel 'amplitude over that without control' offset 0.5,0\n";
}

/// Points on the cells of which a condition holds.
std::string marked_cells(const std::string& condition, const std::string& x, const std::string& y,
                         const char* mark) {
  return "(" + condition + " ? " + x + " : NaN):(" + y + ") with points " + mark;
}

std::string panel(const std::string& table, const MapPanel& what, const SuccessMap& map) {
  const std::string x = shown_on(map.x, "$1"), y = shown_on(map.y, "$2");
  const std::string file = "@" + table + "@ using ", next = ", \\\n  " + file;
  std::string text = "set title \"" + what.heading + "\" offset 0,-0.5\nplot " + file + "(" + x +
                     "):(" + y + "):(shade(strcol(3), strcol(5))) with image" + next +
                     marked_cells("amplifies($3, strcol(5), $0)", x, y, amplifying_mark) + next +
                     marked_cells("unsettled(strcol(5), $0)", x, y, unsettled_mark) + next +
                     marked_cells("unseen(strcol(5), $0)", x, y, unseen_mark) + next + "(" + x +
                     "):(" + y + "):(remark(strcol(3), strcol(5), $0)) with labels left";
  if (!map.curve.tables.empty())
    text += ", \\\n  " + map.curve.points + " with lines " + curve_style;
  return text + "\nunset ylabel\nunset ytics\nunset colorbox\nunset label\nunset arrow\n";
}

Arguments sweep_of(const SuccessMap& map, const Arguments& options) {
  return joined({"sweep", "--axis", range_of(map.x), "--axis", range_of(map.y), "--metric",
                 "ratio_to_uncontrolled", "--metric", "attenuates", "--metric", "outcome",
                 "--best-gain", "--set", "control.proportional_gain=tuned"},
                options);
}

}  // namespace

std::string shown_on(const MapAxis& axis, const std::string& value) {
  const std::string shown = value + "*" + format_number(axis.scale);
  return axis.logarithmic ? "log10(" + shown + ")" : shown;
}

Figure success_figure(const std::string& name, const std::string& title, const std::string& caption,
                      const SuccessMap& map) {
  Figure figure{name, title, caption, {}, "", 400.0};
  figure.plot = std::string(shades) + classes + marks() + legend(map.curve.label) +
                axes(map.x.label, map.y.label) + range_and_tics("x", map.x) +
                range_and_tics("y", map.y) + "set ylabel offset 0.8,0\nunset key\nunset grid\n" +
                layout(map.panels.size());
  for (std::size_t k = 0; k < map.panels.size(); ++k) {
    const std::string table = name + "-" + std::to_string(k + 1);
    figure.tables.push_back({table, sweep_of(map, map.panels[k].options)});
    figure.plot += panel(table, map.panels[k], map);
  }
  figure.tables.insert(figure.tables.end(), map.curve.tables.begin(), map.curve.tables.end());
  figure.plot += "unset multiplot\n";
  return figure;
}

}  // namespace holdfast::program
