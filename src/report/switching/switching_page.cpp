#include "report/switching/switching_page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

#include "case/case_keys.hpp"
#include "case/model/loop_of_case.hpp"
#include "holdfast/contact/hysteresis.hpp"
#include "jobs/columns.hpp"
#include "output/table.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

using Motions = std::vector<StudiedMotion>;
using Loops = std::vector<StudiedLoop>;

/// The contact of one motion in a window.
struct ContactStrip {
  std::string name;    ///< left of the strip
  std::string remark;  ///< right of it
  MotionWindow window;
};

/// Text for gnuplot between double quotes.
std::string label_at(const std::string& text, const std::string& place, const std::string& style) {
  return "set label \"" + text + "\" at " + place + " " + style + "\n";
}

std::string place_of(double time, double height) {
  return format_number(time) + "," + format_number(height);
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
  for (const ContactPhase& phase : window.phases)
    text += "set object rectangle from " + format_number(phase.begin) + ",graph 0 to " +
            format_number(phase.end) + ",graph 1 behind fs solid noborder fc rgb '@tint " +
            word_for(phase.mode) + "@'\n";
  return text;
}

/// Time is shown in s, as in the tables.
std::string time_range(const MotionWindow& window) {
  return format_number(window.begin) + ":" + format_number(window.end);
}

/// The context of a table of the report.
JobContext context_of(const JobContext& context, const std::string& table) {
  JobContext own = context;
  own.output = *context.output / "data" / (table + ".csv");
  return own;
}

/// The values that texts/figures.toml leaves open of a drive in a window, switching at samples,
/// with the instants at which it enters and leaves its gap, and exactly.
Values values_of_window(const ContactStrip& sampled, const ContactStrip& exact) {
  return {{"range", time_range(exact.window)},
          {"rows", "3"},
          {"strips", strip_names({sampled, exact}) + instants_of_changes(sampled.window, 2.0) +
                         mode_words(sampled.window, 2.0) + mode_words(exact.window, 1.0)},
          {"tints", tinted(exact.window)},
          {"sampled", sampled.name}};
}

/// The values that it leaves open of the contacts of many motions as strips over one window.
Values values_of_strips(const std::vector<ContactStrip>& all) {
  return {{"range", time_range(all.front().window)},
          {"count", std::to_string(all.size())},
          {"rows", std::to_string(all.size() + 1)},
          {"strips", strip_names(all)}};
}

/// Tables of the figures, FOLDER/data/NAME.csv with metadata. A row a motion.
void write_motions(const JobContext& context, const std::string& name,
                   const std::vector<StudiedMotion>& motions) {
  Table table(context_of(context, name), columns_of("switching motions"));
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

/// A row a phase, strip by strip.
void write_strips(const JobContext& context, const std::string& name,
                  const std::vector<ContactStrip>& strips) {
  Table table(context_of(context, name), columns_of("switching strips"));
  for (std::size_t k = 0; k < strips.size(); ++k) {
    for (const ContactPhase& phase : strips[k].window.phases)
      table.row(k + 1, phase.begin, phase.end, word_for(phase.mode), strips[k].name);
  }
  table.commit();
}

/// A row an instant.
void write_window(const JobContext& context, const std::string& name, const MotionWindow& exact,
                  const MotionWindow& sampled) {
  Table table(context_of(context, name), columns_of("switching window"));
  for (std::size_t k = 0; k < std::min(exact.instants.size(), sampled.instants.size()); ++k) {
    const InstantOfMotion &a = exact.instants[k], &b = sampled.instants[k];
    table.row(a.time, relative_displacement(a.state), a.command, a.transmitted,
              relative_displacement(b.state), b.command, b.transmitted);
  }
  table.commit();
}

double forcing_period(const Case& the_case) {
  return 1.0 / effective_excitation(the_case).frequency;
}

std::size_t harmonics_of(const Case& the_case) {
  return implemented_loop_of(the_case, Switching::exact).digital.force.harmonics.size();
}

/// Duration of the case's own motions (s): 20, or 200 periods of the excitation where these are
/// longer, but no more than 500 000 samples (fewer for a force of many harmonics), nor after the
/// end of a recorded force.
double studied_duration(const Case& the_case) {
  const double most_samples = std::min(5e5, 1e7 / static_cast<double>(harmonics_of(the_case)));
  return std::min({std::max(20.0, 200.0 * forcing_period(the_case)),
                   most_samples * the_case.control.sampling_period, end_of_force(the_case)});
}

void add_readings(Loops& loops, const Case& the_case, double duration) {
  for (const Reading& reading : readings) loops.push_back({the_case, reading, duration});
}

/// The values with another one among them, ascending.
std::vector<double> with_own(std::vector<double> values, double own) {
  const auto same = [own](double value) { return std::abs(value - own) <= 1e-9 * std::abs(own); };
  if (std::none_of(values.begin(), values.end(), same)) values.push_back(own);
  std::sort(values.begin(), values.end());
  return values;
}

/// Sampling periods up to a fifth of the forcing period, whole two-hundredths of it so that
/// sampling and forcing soon coincide, and long enough for what the computer does in one.
std::vector<double> shown_sampling_periods(const Case& the_case) {
  const double shortest = the_case.control.processing_delay + 2.0 * the_case.control.jitter;
  std::vector<double> periods;
  for (int part = 1; part <= 40; ++part) {
    const double period = part * forcing_period(the_case) / 200.0;
    if (period > shortest) periods.push_back(period);
  }
  return with_own(periods, the_case.control.sampling_period);
}

std::vector<double> shown_widths(const Case& the_case) {
  const double swing = swing_without_control(the_case, studied_duration(the_case));
  const double widest = swing > 0.0 ? rounded_up(swing) : 1e-3;
  std::vector<double> widths;
  for (int part = 0; part <= 30; ++part) widths.push_back(widest * part / 30.0);
  return with_own(widths, the_case.backlash.width);
}

/// The readings one after the other, each over the values of a key.
Loops loops_over(const Case& the_case, const std::string& key, const std::vector<double>& values) {
  Loops loops;
  for (const Reading& reading : readings) {
    for (const double value : values) {
      Case changed = the_case;
      set_case_value(changed, key, value);
      loops.push_back({changed, reading, studied_duration(changed)});
    }
  }
  return loops;
}

std::string milli(double value) { return rounded(1e3 * value, 4); }

/// The window of Fig. 8, 9.05 s to 9.11 s, in periods of the excitation; earlier where the force
/// ends before.
std::pair<double, double> shown_window(const Case& the_case) {
  const double period = forcing_period(the_case);
  const double end = std::min(91.1 * period, end_of_force(the_case));
  return {std::max(end - 0.6 * period, 0.0), end};
}

/// @param instants  of window_of()
ContactStrip strip_of(const std::string& name, const StudiedLoop& studied, int instants = 0) {
  const auto [begin, end] = shown_window(studied.the_case);
  return {name, "", window_of(studied, begin, end, instants)};
}

DrawnFigure without_picture(Figure figure, const std::string& reason) {
  figure.tables.clear();
  return {std::move(figure), {}, {}, reason};
}

Figure listed_figure(const std::string& name, const Values& values) {
  return listed_figures(name, values).front();
}

DrawnFigure write_phases(const JobContext& context, bool builtin) {
  const Case& the_case = context.case_data;
  constexpr int instants = 601;
  const std::string name = "switching-phases";
  const bool held = force_hold_of(the_case) == ForceHold::sampled;
  const Reading& reading = readings[held ? sampled_and_held : sampled_switching];
  Values values = {{"title", builtin ? "Fig. 8 with its stick phase, τ = 1 ms, r₀ = 0.5 mm"
                                     : "What the drive does between the samples"},
                   {"loop", loop_text(the_case)},
                   {"held", held ? "held over each sample as in the paper" : "exact"},
                   {"builtin", builtin ? ", which are those of the paper's Fig. 8" : ""}};
  try {
    const ContactStrip sampled = strip_of("at samples", {the_case, reading, 0.0}, instants);
    const ContactStrip exact =
        strip_of("exact", {the_case, readings[exact_switching], 0.0}, instants);
    write_strips(context, name, {sampled, exact});
    write_window(context, name + "-motion", exact.window, sampled.window);
    values = joined(values, values_of_window(sampled, exact));
    return {listed_figure(name, values), {}, {}, ""};
  } catch (const NoAnswer& reason) {
    return without_picture(listed_figure(name, values), reason.what());
  }
}

/// The values of backlash.law.
constexpr std::array<const char*, 5> law_names = {"kollar", "immediate", "play", "dead_zone",
                                                  "none"};

/// Motions of each law, with its drive switching at samples and exactly, the force exact in both.
Motions study_laws(const JobContext& context) {
  Loops loops;
  for (const char* law : law_names) {
    Case changed = context.case_data;
    changed.backlash.law = law;
    for (const std::size_t reading : {sampled_switching, exact_switching})
      loops.push_back({changed, readings[reading], studied_duration(changed)});
  }
  Motions motions = study(loops, context.threads);
  write_motions(context, "switching-law-motions", motions);
  return motions;
}

/// The strip of a law with its amplitude; an empty one where the motion has no answer.
ContactStrip strip_with_amplitude(const std::string& name, const StudiedMotion& motion) {
  ContactStrip strip{name, "", {}};
  try {
    strip = strip_of(name, motion.loop);
  } catch (const NoAnswer&) {
    std::tie(strip.window.begin, strip.window.end) = shown_window(motion.loop.the_case);
  }
  const SteadyMotion& steady = motion.steady;
  strip.remark = steady.diverges ? "diverges" : milli(steady.largest_displacement) + " mm";
  return strip;
}

/// The strips of the laws that differ. Exactly taken, the first three are one.
std::vector<ContactStrip> strips_of_laws(const Motions& of_laws) {
  constexpr std::array<std::tuple<std::size_t, const char*, bool>, 7> shown = {
      {{0, "kollar, at samples", false},
       {1, "immediate, at samples", false},
       {2, "play, at samples", false},
       {2, "these three, exact", true},
       {3, "dead zone, at samples", false},
       {3, "dead zone, exact", true},
       {4, "no backlash", false}}};
  std::vector<ContactStrip> strips;
  strips.reserve(shown.size());
  for (const auto& [law, how, exact] : shown)
    strips.push_back(strip_with_amplitude(how, of_laws[2 * law + (exact ? 1 : 0)]));
  return strips;
}

constexpr const char* nowhere = "the motion diverges in all of them";

DrawnFigure write_laws(const JobContext& context, const Motions& of_laws) {
  const std::vector<ContactStrip> strips = strips_of_laws(of_laws);
  const bool empty = std::all_of(strips.begin(), strips.end(), [](const ContactStrip& strip) {
    return strip.window.phases.empty();
  });
  Figure figure = listed_figure("switching-laws", values_of_strips(strips));
  figure.height += 30.0 * static_cast<double>(strips.size());
  write_strips(context, figure.name, strips);
  return {figure, {}, {}, empty ? nowhere : ""};
}

/// The amplitudes that the charts show: up to half as much again as without control, and the case's
/// own motions.
Values values_of_amplitudes(const Case& the_case, const Motions& of_case) {
  const double free = amplitude_without_control(the_case, studied_duration(the_case));
  double largest = 1.5 * free;
  for (const StudiedMotion& motion : of_case)
    largest = std::fmax(largest, 1.2 * motion.steady.largest_displacement);
  return {{"largest", largest > 0.0 ? format_number(largest) + "*@length@" : "*"},
          {"free", format_number(free)}};
}

/// Chart of every reading over a key of the case, whose own value is marked; the table has one
/// reading after the other.
DrawnFigure write_chart(const JobContext& context, Figure figure, const std::string& key,
                        const std::vector<double>& abscissae) {
  const Motions motions = study(loops_over(context.case_data, key, abscissae), context.threads);
  write_motions(context, figure.name, motions);
  const bool empty = std::none_of(motions.begin(), motions.end(), [](const StudiedMotion& motion) {
    return std::isfinite(motion.steady.largest_displacement);
  });
  const double first = abscissae.front(), last = abscissae.back(), margin = 0.02 * (last - first);
  figure.plot =
      filled(figure.plot, {{"first", format_number(1e3 * (first - margin))},
                           {"last", format_number(1e3 * (last + margin))},
                           {"own", format_number(1e3 * case_value(context.case_data, key))}});
  return {std::move(figure), {}, {}, empty ? nowhere : ""};
}

/// The charts; without their pictures where the force has many harmonics: they take two hundred
/// motions, whose work grows with these.
void add_charts(std::vector<DrawnFigure>& figures, const JobContext& context,
                const Motions& of_case) {
  const Case& the_case = context.case_data;
  constexpr std::size_t most_harmonics = 20;
  const std::size_t harmonics = harmonics_of(the_case);
  const Values values = {{"duration", rounded(studied_duration(the_case), 4)},
                         {"period", milli(the_case.control.sampling_period)},
                         {"width", milli(the_case.backlash.width)}};
  if (harmonics > most_harmonics) {
    for (Figure& chart : listed_figures("switching-charts", values))
      figures.push_back(without_picture(std::move(chart),
                                        "the force has " + std::to_string(harmonics) +
                                            " harmonics, too many to compute hundreds of motions"));
    return;
  }
  const auto charts =
      listed_figures("switching-charts", joined(values, values_of_amplitudes(the_case, of_case)));
  figures.push_back(
      write_chart(context, charts[0], "control.sampling_period", shown_sampling_periods(the_case)));
  figures.push_back(write_chart(context, charts[1], "backlash.width", shown_widths(the_case)));
}

/// The loops of Kollár's figures and two beside them, from rest: largest |z₁| in the second half of
/// 3 s, or the next whole number of samples.
Loops loops_of_paper(const Case& the_case) {
  constexpr double milliseconds = 1e-3, millimetres = 1e-3;
  constexpr std::array<std::pair<double, double>, 7> settings = {
      {{1.0, 0.5}, {1.0, 2.0}, {3.0, 2.0}, {5.0, 1.0}, {10.0, 2.0}, {11.0, 1.0}, {11.0, 2.0}}};
  Loops loops;
  for (const auto& [period, width] : settings) {
    Case changed = the_case;
    changed.control.sampling_period = period * milliseconds;
    changed.backlash.width = width * millimetres;
    const double samples = std::ceil(3.0 / changed.control.sampling_period * (1.0 - 1e-12));
    add_readings(loops, changed, samples * changed.control.sampling_period);
  }
  return loops;
}

}  // namespace

SwitchingPage make_switching_page(const JobContext& context, bool builtin) {
  const Case& the_case = context.case_data;
  SwitchingPage page;
  Loops of_case;
  add_readings(of_case, the_case, studied_duration(the_case));
  page.of_case = study(of_case, context.threads);
  write_motions(context, "switching-case", page.of_case);
  if (builtin) {
    page.of_paper = study(loops_of_paper(the_case), context.threads);
    write_motions(context, "switching-paper", page.of_paper);
  }
  page.laws = study_laws(context);
  page.figures = {write_phases(context, builtin), write_laws(context, page.laws)};
  add_charts(page.figures, context, page.of_case);
  return page;
}

}  // namespace holdfast::program
