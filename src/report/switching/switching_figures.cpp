#include "report/switching/switching_page.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "holdfast/contact/hysteresis.hpp"
#include "io/text/table.hpp"
#include "io/text/text.hpp"
#include "jobs/columns.hpp"

namespace holdfast::program {
namespace {

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

}  // namespace

Values values_of_window(const ContactStrip& sampled, const ContactStrip& exact) {
  return {{"range", time_range(exact.window)},
          {"rows", "3"},
          {"strips", strip_names({sampled, exact}) + instants_of_changes(sampled.window, 2.0) +
                         mode_words(sampled.window, 2.0) + mode_words(exact.window, 1.0)},
          {"tints", tinted(exact.window)},
          {"sampled", sampled.name}};
}

Values values_of_strips(const std::vector<ContactStrip>& all) {
  return {{"range", time_range(all.front().window)},
          {"count", std::to_string(all.size())},
          {"rows", std::to_string(all.size() + 1)},
          {"strips", strip_names(all)}};
}

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

void write_strips(const JobContext& context, const std::string& name,
                  const std::vector<ContactStrip>& strips) {
  Table table(context_of(context, name), columns_of("switching strips"));
  for (std::size_t k = 0; k < strips.size(); ++k) {
    for (const ContactPhase& phase : strips[k].window.phases)
      table.row(k + 1, phase.begin, phase.end, word_for(phase.mode), strips[k].name);
  }
  table.commit();
}

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

}  // namespace holdfast::program
