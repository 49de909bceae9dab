#include "report/switching/switching_figures.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "holdfast/contact/hysteresis.hpp"
#include "io/text/csv.hpp"
#include "io/text/table.hpp"
#include "io/text/text.hpp"
#include "report/page/html.hpp"

namespace holdfast::program {
namespace {

/// How a reading is drawn: colours of M. Okabe and K. Ito; dashes and symbols tell them apart too.
struct ReadingStyle {
  const char* style;
  const char* words;
};

constexpr std::array<ReadingStyle, 3> styles = {
    {{"lw 1.4 lc rgb '#d55e00' dt (8,3) pt 6 ps 0.9", "at samples, force held"},
     {"lw 1.4 lc rgb '#009e73' dt (3,2) pt 8 ps 0.7", "at samples, exact force"},
     {"lw 2 lc rgb '#0072b2' pt 7 ps 0.4", "exact switching, exact force"}}};

/// One curve of each reading over a column, its cells of the other readings NaN.
std::string curves(const std::string& column, const std::string& value, const char* kind) {
  std::string text;
  for (std::size_t k = 0; k < readings.size(); ++k)
    text += filled(
        "@@ using (strcol(4) eq '@switching@' && strcol(5) eq '@hold@' ? @x@*1000 : NaN):(@y@) "
        "with @kind@ @style@ title '@words@', \\\n  ",
        {{"switching", readings[k].switching_word()},
         {"hold", readings[k].hold_word()},
         {"x", column},
         {"y", value},
         {"kind", kind},
         {"style", styles[k].style},
         {"words", styles[k].words}});
  return text;
}

/// Of both panels the same abscissa, whatever points there are; the axis of periods reaches 3 at
/// least.
constexpr const char* chart_plot = R"plot(set multiplot
set lmargin at screen 0.15
set rmargin at screen 0.97
set xrange [@first@:@last@]
set arrow 1 from @own@, graph 0 to @own@, graph 1 nohead back lc rgb '#888888' dt 3
set key at screen 0.55,0.985 center top vertical maxrows 2 samplen 3 width -4
set bmargin at screen 0.45
set tmargin at screen 0.87
set format x ''
set yrange [0:@largest@]
set xlabel ""
set ylabel "largest |{/:Italic z}_1| (@unit@)"
plot @amplitudes@@free@*@length@ with lines lc rgb '#777777' lw 1.2 dt 4 title 'without control'
set bmargin at screen 0.14
set tmargin at screen 0.41
unset key
set format x '%g'
set logscale y
set yrange [0.35:*]
set ytics ('none' 0.5, '1' 1, '3' 3, '10' 10, '30' 30, '100' 100, '1000' 1000)
set xlabel "@label@"
set ylabel "period / shortest"
plot @periods@3 with points ps 0 notitle
unset multiplot
)plot";

/// How a phase of the contact is drawn: as a part of a strip, and as a tint behind curves.
struct ModeStyle {
  ContactMode mode;
  const char* colour;
  const char* tint;
};

/// In the order of the key.
constexpr std::array<ModeStyle, 3> modes = {{{ContactMode::engaged, "#0072b2", "#d9e8f3"},
                                             {ContactMode::stick, "#e69f00", "#fbe7bd"},
                                             {ContactMode::gap, "#e4e4e4", "#f6f6f6"}}};

/// Text for gnuplot between double quotes.
std::string label_at(const std::string& text, const std::string& place, const std::string& style) {
  return "set label \"" + text + "\" at " + place + " " + style + "\n";
}

std::string place_of(double time, double height) {
  return format_number(time) + "," + format_number(height);
}

/// The strips of a table, the first one on top; each mode has its name in the key.
std::string strips(std::size_t count) {
  std::string text = "plot ";
  for (const ModeStyle& style : modes)
    text += filled(
        "@@ using (strcol(4) eq '@mode@' ? $2 : NaN):(@y@):2:3:(@y@-0.3):(@y@+0.3) with boxxyerror "
        "fs solid noborder fc rgb '@colour@' title '@mode@', \\\n  ",
        {{"mode", word_for(style.mode)},
         {"y", std::to_string(count + 1) + "-$1"},
         {"colour", style.colour}});
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
std::string mode_words(const MotionWindow& window, double height) {
  std::string text;
  for (const ContactPhase& phase : window.phases) {
    if (phase.end - phase.begin < 0.1 * (window.end - window.begin)) continue;
    const std::string colour = phase.mode == ContactMode::engaged ? "#ffffff" : "#222222";
    text += label_at(word_for(phase.mode), place_of(0.5 * (phase.begin + phase.end), height),
                     "center front font ',12' tc rgb '" + colour + "'");
  }
  return text;
}

/// When the drive enters its gap, above the strip, and leaves it, below.
std::string instants_of_changes(const MotionWindow& window, double height) {
  std::string text;
  std::array<int, 2> labels{};
  for (std::size_t k = 1; k < window.phases.size() && k < 8; ++k) {
    const ContactPhase& phase = window.phases[k];
    const bool leaves = phase.mode == ContactMode::engaged;
    const bool first = labels[leaves ? 1 : 0]++ == 0;
    const double place = (phase.begin - window.begin) / (window.end - window.begin);
    const bool ends_here = place > 0.85 || (first && place > 0.15);
    text += label_at((leaves ? "out " : "in ") + rounded(phase.begin, 5),
                     place_of(phase.begin, height + (leaves ? -0.45 : 0.45)),
                     std::string(ends_here ? "right" : "left") + " font ',11'");
  }
  return text;
}

/// The phases of a motion as tints behind the curves.
std::string tinted(const MotionWindow& window) {
  std::string text;
  for (const ContactPhase& phase : window.phases) {
    const auto* const style =
        std::find_if(modes.begin(), modes.end(),
                     [&phase](const ModeStyle& known) { return known.mode == phase.mode; });
    text += "set object rectangle from " + format_number(phase.begin) + ",graph 0 to " +
            format_number(phase.end) + ",graph 1 behind fs solid noborder fc rgb '" + style->tint +
            "'\n";
  }
  return text;
}

/// Time is shown in s, as in the tables.
std::string time_range(const MotionWindow& window) {
  return format_number(window.begin) + ":" + format_number(window.end);
}

constexpr const char* window_plot = R"plot(set multiplot
set lmargin at screen 0.17
set rmargin at screen 0.97
set xrange [@range@]
set format x ''
unset key
set bmargin at screen 0.76
set tmargin at screen 0.99
set yrange [0.5:2.75]
@strips@unset label
set ytics auto scale 1
set grid y
set autoscale y
set key at screen 0.57,0.745 center top vertical maxrows 1 samplen 3 width -2
@tints@set bmargin at screen 0.41
set tmargin at screen 0.7
set xlabel ""
set ylabel "transmitted force (N)"
plot @-motion@ using 1:($3) with lines lw 1 lc rgb '#555555' dt (2,2) title 'command', \
  @-motion@ using 1:($7) with lines lw 1.4 lc rgb '#d55e00' dt (8,3) title '@sampled@', \
  @-motion@ using 1:($4) with lines lw 2 lc rgb '#0072b2' title 'exact'
unset key
set format x '%g'
set bmargin at screen 0.11
set tmargin at screen 0.38
set xlabel "time {/:Italic t} (s)"
set ylabel "{/:Italic z}_2 − {/:Italic z}_1 (@unit@)"
plot @-motion@ using 1:($5*@length@) with lines lw 1.4 lc rgb '#d55e00' dt (8,3) title '', \
  @-motion@ using 1:($2*@length@) with lines lw 2 lc rgb '#0072b2' title ''
unset multiplot
)plot";

/// The charts count these columns.
std::vector<Column> motion_table_columns() {
  return {{"law", "", "of the backlash", "string"},
          {"sampling_period_s", "s", "tau"},
          {"backlash_width_m", "m", "r0"},
          {"switching", "", "sampled or exact", "string"},
          {"hold", "", "of the force over a sample: sampled or exact", "string"},
          {"duration_s", "s", "of the motion, whose second half is looked at"},
          {"largest_z1_m", "m", "largest absolute z1 of the second half, at all times"},
          {"largest_sampled_z1_m", "m", "the same at the samples"},
          {"engaged_phases_per_half_cycle", "", "how often the drive begins to transmit"},
          {"gap_phases_per_half_cycle", "", "how often it begins to cross its gap"},
          {"stick_phases_per_half_cycle", "", "how often its sides begin to stay together"},
          {"verdict", "", "periodic(N), or why there is no certified orbit", "string"},
          {"period_samples", "", "of the certified orbit; 0: none", "integer"},
          {"period_s", "s", "of the certified orbit; nan: none"},
          {"forcing_periods", "", "in one of the orbit", "integer"},
          {"shortest_period_samples", "",
           "after which sampling and forcing coincide again; 0: never", "integer"},
          {"largest_multiplier", "", "modulus, of one period"}};
}

/// The context of a table of the report.
JobContext context_of(const JobContext& context, const std::string& table) {
  JobContext own = context;
  own.output = *context.output / "data" / (table + ".csv");
  return own;
}

}  // namespace

void draw_chart(SwitchingChart& chart, const ShownAmplitudes& amplitudes) {
  const double first = chart.values.front(), last = chart.values.back();
  const double margin = 0.02 * (last - first);
  const std::string largest =
      amplitudes.largest > 0.0 ? format_number(amplitudes.largest) + "*@length@" : "*";
  chart.figure.tables = {{chart.figure.name, {"report"}}};
  chart.figure.height = 500.0;
  chart.figure.plot =
      filled(chart_plot, {{"first", format_number(1e3 * (first - margin))},
                          {"last", format_number(1e3 * (last + margin))},
                          {"own", format_number(1e3 * chart.own_value)},
                          {"largest", largest},
                          {"amplitudes", curves(chart.column, "$7*@length@", "linespoints")},
                          {"free", format_number(amplitudes.without_control)},
                          {"label", chart.label},
                          {"periods", curves(chart.column, "$13 > 0 ? $13/$16 : 0.5", "points")}});
}

void draw_window(Figure& figure, const ContactStrip& sampled, const ContactStrip& exact) {
  figure.tables = {{figure.name, {"report"}}, {figure.name + "-motion", {"report"}}};
  figure.height = 620.0;
  figure.plot = filled(
      window_plot,
      {{"range", time_range(exact.window)},
       {"strips", strip_names({sampled, exact}) + instants_of_changes(sampled.window, 2.0) +
                      mode_words(sampled.window, 2.0) + mode_words(exact.window, 1.0) + strips(2)},
       {"tints", tinted(exact.window)},
       {"sampled", sampled.name}});
}

void draw_strips(Figure& figure, const std::vector<ContactStrip>& all) {
  figure.tables = {{figure.name, {"report"}}};
  figure.height = 120.0 + 30.0 * static_cast<double>(all.size());
  figure.plot =
      "set lmargin at screen 0.33\nset rmargin at screen 0.84\nset key vertical maxrows 1\n"
      "set xrange [" +
      time_range(all.front().window) + "]\nset yrange [0.5:" + std::to_string(all.size()) +
      ".5]\n" + strip_names(all) + "set xlabel \"time {/:Italic t} (s)\"\nset ylabel \"\"\n" +
      strips(all.size());
}

void write_motions(const JobContext& context, const std::string& name,
                   const std::vector<StudiedMotion>& motions) {
  Table table(context_of(context, name), motion_table_columns());
  for (const StudiedMotion& motion : motions) {
    const auto& [studied, steady, period] = motion;
    const Case& of = studied.the_case;
    table.row(of.backlash.law, of.control.sampling_period, of.backlash.width,
              studied.reading.switching_word(), studied.reading.hold_word(), studied.duration,
              steady.largest_displacement, steady.largest_of_samples,
              steady.phases_per_half_cycle[0], steady.phases_per_half_cycle[1],
              steady.phases_per_half_cycle[2], period.verdict, period.samples, period.seconds,
              period.forcing_periods, shortest_period(studied), period.largest_multiplier);
  }
  table.commit();
}

void write_strips(const JobContext& context, const std::string& name,
                  const std::vector<ContactStrip>& strips) {
  Table table(context_of(context, name), {{"strip", "", "from the top, from 1", "integer"},
                                          {"begin_s", "s", "of a phase"},
                                          {"end_s", "s", "of it"},
                                          {"mode", "", "engaged, gap or stick", "string"},
                                          {"motion", "", "whose strip it is", "string"}});
  for (std::size_t k = 0; k < strips.size(); ++k) {
    for (const ContactPhase& phase : strips[k].window.phases)
      table.row(k + 1, phase.begin, phase.end, word_for(phase.mode), strips[k].name);
  }
  table.commit();
}

void write_window(const JobContext& context, const std::string& name, const MotionWindow& exact,
                  const MotionWindow& sampled) {
  std::vector<Column> columns = {{"time_s", "s", "time"}};
  for (const std::string motion : {"exact", "sampled"}) {
    columns.push_back({motion + "_dz_m", "m", "z2 - z1 with " + motion + " switching"});
    columns.push_back({motion + "_command_N", "N", "u, the command in force"});
    columns.push_back({motion + "_transmitted_N", "N", "what the drive transmits"});
  }
  Table table(context_of(context, name), columns);
  for (std::size_t k = 0; k < std::min(exact.instants.size(), sampled.instants.size()); ++k) {
    const InstantOfMotion &a = exact.instants[k], &b = sampled.instants[k];
    table.row(a.time, relative_displacement(a.state), a.command, a.transmitted,
              relative_displacement(b.state), b.command, b.transmitted);
  }
  table.commit();
}

}  // namespace holdfast::program
