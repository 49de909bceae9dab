#include "report/switching/switching_figures.hpp"

#include <array>
#include <cstddef>

#include "io/text/text.hpp"
#include "report/comparison/comparison_tools.hpp"
#include "report/figures/figure_text.hpp"

namespace holdfast::program {
namespace {

/// How a reading is drawn: colours of M. Okabe and K. Ito; dashes and symbols tell them apart too.
struct ReadingStyle {
  const char* line;
  const char* symbol;
  const char* words;
};

constexpr std::array<ReadingStyle, 3> styles = {
    {{"lw 1.4 lc rgb '#d55e00' dt (8,3)", "pt 6 ps 0.9", "at samples, force held"},
     {"lw 1.4 lc rgb '#009e73' dt (3,2)", "pt 8 ps 0.7", "at samples, exact force"},
     {"lw 2 lc rgb '#0072b2'", "pt 7 ps 0.4", "exact switching, exact force"}}};

/// A column of the rows of one reading, NaN in the others.
std::string column_of(const Reading& reading, const std::string& value) {
  const auto is = [](MotionColumn::Number column, const char* word) {
    return "strcol(" + std::to_string(column) + ") eq '" + word + "'";
  };
  return "(" + is(MotionColumn::switching, reading.switching_word()) + " && " +
         is(MotionColumn::hold, reading.hold_word()) + " ? " + value + " : NaN)";
}

std::string cell(MotionColumn::Number column) { return "$" + std::to_string(column); }

/// One curve of each reading over the axis, or only its points.
std::string curves(const std::string& name, const SwitchingAxis& axis, const std::string& value,
                   const char* kind) {
  const std::string x = cell(axis.column) + "*" + format_number(axis.scale);
  std::string text;
  for (std::size_t k = 0; k < readings.size(); ++k) {
    text += (k == 0 ? "@" : ", \\\n  @") + name + "@ using " + column_of(readings[k], x) + ":(" +
            value + ") with " + kind + " " + styles[k].line + " " + styles[k].symbol + " title '" +
            styles[k].words + "'";
  }
  return text;
}

/// The same abscissa for every panel, whatever points there are.
std::string axis_range(const SwitchingAxis& axis) {
  const double margin = 0.02 * (axis.last - axis.first);
  return "set xrange [" + format_number(axis.scale * (axis.first - margin)) + ":" +
         format_number(axis.scale * (axis.last + margin)) + "]\n";
}

/// A line across the picture where the case itself is.
std::string own_place(const SwitchingAxis& axis) {
  const std::string x = format_number(axis.scale * axis.own_value);
  return "set arrow 1 from " + x + ", graph 0 to " + x +
         ", graph 1 nohead back lc rgb '#888888' dt 3\n";
}

/// A panel over a part of the height.
std::string panel_between(double bottom, double top) {
  return "set bmargin at screen " + format_number(bottom) + "\nset tmargin at screen " +
         format_number(top) + "\n";
}

/// A length (m) in the figure's unit, for gnuplot.
std::string in_unit(double length) { return format_number(length) + "*@length@"; }

std::string amplitude_panel(const std::string& name, const SwitchingAxis& axis,
                            const ShownAmplitudes& amplitudes) {
  const std::string top = amplitudes.largest > 0.0 ? in_unit(amplitudes.largest) : std::string("*");
  return "set key at screen 0.55,0.985 center top vertical maxrows 2 samplen 3 width -4\n" +
         panel_between(0.45, 0.87) + "set format x ''\nset yrange [0:" + top + "]\n" +
         axes("", "largest |{/:Italic z}_1| (@unit@)") + "plot " +
         curves(name, axis, cell(MotionColumn::largest_displacement) + "*@length@", "linespoints") +
         ", \\\n  " + in_unit(amplitudes.without_control) +
         " with lines lc rgb '#777777' lw 1.2 dt 4 title 'without control'\n";
}

std::string period_panel(const std::string& name, const SwitchingAxis& axis) {
  const std::string samples = cell(MotionColumn::period_samples);
  const std::string multiple =
      samples + " > 0 ? " + samples + "/" + cell(MotionColumn::shortest_period_samples) + " : 0.5";
  return panel_between(0.14, 0.41) +
         "unset key\nset format x '%g'\nset logscale y\nset yrange [0.35:*]\n"
         "set ytics ('none' 0.5, '1' 1, '3' 3, '10' 10, '30' 30, '100' 100, '1000' 1000)\n" +
         axes(axis.label, "period / shortest") + "plot " + curves(name, axis, multiple, "points") +
         ", \\\n  3 with points ps 0 notitle\n";  // the axis reaches 3 at least
}

/// Text for gnuplot between double quotes, with blanks that do not break.
std::string label_at(const std::string& text, const std::string& place, const std::string& style) {
  return "set label \"" + text + "\" at " + place + " " + style + "\n";
}

const char* colour_of(ContactMode mode) {
  switch (mode) {
    case ContactMode::engaged:
      return "#0072b2";
    case ContactMode::gap:
      return "#e4e4e4";
    case ContactMode::stick:
      return "#e69f00";
  }
  return "";
}

const char* tint_of(ContactMode mode) {
  switch (mode) {
    case ContactMode::engaged:
      return "#d9e8f3";
    case ContactMode::gap:
      return "#f6f6f6";
    case ContactMode::stick:
      return "#fbe7bd";
  }
  return "";
}

constexpr std::array<ContactMode, 3> all_modes = {ContactMode::engaged, ContactMode::stick,
                                                  ContactMode::gap};

/// Time on the abscissa, in ms from the window's begin where the window is narrow, is hard to
/// compare with a table: it is shown in s.
std::string time_range(const MotionWindow& window) {
  return "set xrange [" + format_number(window.begin) + ":" + format_number(window.end) + "]\n";
}

/// The strips of a table, the first one on top; of the colours each has its name in the key.
std::string strips(const std::string& name, std::size_t count) {
  std::string text = "plot ";
  for (const ContactMode mode : all_modes) {
    const std::string is_mode = "(strcol(4) eq '" + std::string(word_for(mode)) + "' ? $2 : NaN)";
    const std::string y = std::to_string(count + 1) + "-$1";
    text += "@" + name + "@ using " + is_mode + ":(" + y + "):2:3:(" + y + "-0.3):(" + y +
            "+0.3) with boxxyerror fs solid noborder fc rgb '" + colour_of(mode) + "' title '" +
            word_for(mode) + "', \\\n  ";
  }
  return text + "NaN notitle\n";
}

/// The names of the strips as tics, their remarks beyond the right end.
std::string strip_names(const std::vector<ContactStrip>& all) {
  std::string tics, remarks;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const std::string y = std::to_string(all.size() - k);
    tics += (k == 0 ? "\"" : ", \"") + all[k].name + "\" " + y;
    if (!all[k].remark.empty())
      remarks += label_at(all[k].remark, "graph 1.01, first " + y, "left font ',12'");
  }
  return "set ytics (" + tics + ") scale 0\nset grid noy\n" + remarks;
}

/// The modes written into their places, where these are wide enough.
std::string mode_words(const ContactStrip& strip, double height) {
  std::string text;
  const double width = strip.window.end - strip.window.begin;
  for (const ContactPhase& phase : strip.window.phases) {
    if (phase.end - phase.begin < 0.1 * width) continue;
    const std::string place =
        format_number(0.5 * (phase.begin + phase.end)) + "," + format_number(height);
    const std::string colour = phase.mode == ContactMode::engaged ? "#ffffff" : "#222222";
    text +=
        label_at(word_for(phase.mode), place, "center front font ',12' tc rgb '" + colour + "'");
  }
  return text;
}

/// When the drive enters its gap, above the strip, and leaves it, below.
std::string instants_of_changes(const ContactStrip& strip, double height) {
  std::string text;
  const MotionWindow& window = strip.window;
  std::array<int, 2> labels{};
  for (std::size_t k = 1; k < window.phases.size() && k < 8; ++k) {
    const ContactPhase& phase = window.phases[k];
    const bool leaves = phase.mode == ContactMode::engaged;
    const bool first = labels[leaves ? 1 : 0]++ == 0;
    const double place = (phase.begin - window.begin) / (window.end - window.begin);
    const bool ends_here = place > 0.85 || (first && place > 0.15);
    const std::string time = rounded(phase.begin, 5);
    text +=
        label_at((leaves ? "out " : "in ") + time,
                 format_number(phase.begin) + "," + format_number(height + (leaves ? -0.45 : 0.45)),
                 std::string(ends_here ? "right" : "left") + " font ',11'");
  }
  return text;
}

/// The phases of a motion as tints behind the curves.
std::string tinted(const MotionWindow& window) {
  std::string text;
  for (const ContactPhase& phase : window.phases) {
    text += "set object rectangle from " + format_number(phase.begin) + ",graph 0 to " +
            format_number(phase.end) + ",graph 1 behind fs solid noborder fc rgb '" +
            tint_of(phase.mode) + "'\n";
  }
  return text;
}

std::string curve_of(const std::string& table, const std::string& value, const char* style,
                     const std::string& title) {
  return "@" + table + "@ using 1:(" + value + ") with lines " + style + " title '" + title + "'";
}

std::string force_panel(const std::string& motion, const std::string& sampled) {
  return axes("", "transmitted force (N)") + "plot " +
         curve_of(motion, "$3", "lw 1 lc rgb '#555555' dt (2,2)", "command") + ", \\\n  " +
         curve_of(motion, "$7", styles[0].line, sampled) + ", \\\n  " +
         curve_of(motion, "$4", styles[2].line, "exact") + "\n";
}

std::string displacement_panel(const std::string& motion) {
  return axes("time {/:Italic t} (s)", "{/:Italic z}_2 − {/:Italic z}_1 (@unit@)") + "plot " +
         curve_of(motion, "$5*@length@", styles[0].line, "") + ", \\\n  " +
         curve_of(motion, "$2*@length@", styles[2].line, "") + "\n";
}

}  // namespace

Figure switching_chart(const std::string& name, const std::string& title,
                       const std::string& caption, const SwitchingAxis& axis,
                       const ShownAmplitudes& amplitudes) {
  Figure figure{name, title, caption, {{name, {"report"}}}, "", 500.0};
  figure.plot = "set multiplot\nset lmargin at screen 0.15\nset rmargin at screen 0.97\n" +
                axis_range(axis) + own_place(axis) + amplitude_panel(name, axis, amplitudes) +
                period_panel(name, axis) + "unset multiplot\n";
  return figure;
}

Figure contact_window_figure(const std::string& name, const std::string& title,
                             const std::string& caption, const ContactStrip& sampled,
                             const ContactStrip& exact) {
  const std::string motion = name + "-motion";
  Figure figure{name, title, caption, {{name, {"report"}}, {motion, {"report"}}}, "", 620.0};
  figure.plot = "set multiplot\nset lmargin at screen 0.17\nset rmargin at screen 0.97\n" +
                time_range(exact.window) + "set format x ''\nunset key\n" +
                panel_between(0.76, 0.99) + "set yrange [0.5:2.75]\n" +
                strip_names({sampled, exact}) + instants_of_changes(sampled, 2.0) +
                mode_words(sampled, 2.0) + mode_words(exact, 1.0) + strips(name, 2) +
                "unset label\nset ytics auto scale 1\nset grid y\nset autoscale y\n" +
                "set key at screen 0.57,0.745 center top vertical maxrows 1 samplen 3 width -2\n" +
                tinted(exact.window) + panel_between(0.41, 0.70) +
                force_panel(motion, sampled.name) + "unset key\nset format x '%g'\n" +
                panel_between(0.11, 0.38) + displacement_panel(motion) + "unset multiplot\n";
  return figure;
}

Figure contact_strips_figure(const std::string& name, const std::string& title,
                             const std::string& caption, const std::vector<ContactStrip>& all) {
  Figure figure{name,    title,
                caption, {{name, {"report"}}},
                "",      120.0 + 30.0 * static_cast<double>(all.size())};
  if (all.empty()) return figure;
  figure.plot =
      "set lmargin at screen 0.33\nset rmargin at screen 0.84\n"
      "set key vertical maxrows 1\n" +
      time_range(all.front().window) + "set yrange [0.5:" + std::to_string(all.size()) + ".5]\n" +
      strip_names(all) + axes("time {/:Italic t} (s)", "") + strips(name, all.size());
  return figure;
}

}  // namespace holdfast::program
