#include "report/switching/switching_page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

#include "case/case_keys.hpp"
#include "case/model/loop_of_case.hpp"
#include "process/errors.hpp"
#include "report/switching/switching_figures.hpp"

namespace holdfast::program {
namespace {

using Motions = std::vector<StudiedMotion>;
using Loops = std::vector<StudiedLoop>;

double forcing_period(const Case& the_case) {
  return 1.0 / effective_excitation(the_case).frequency;
}

std::size_t harmonics_of(const Case& the_case) {
  return implemented_loop_of(the_case, Switching::exact).digital.force.harmonics.size();
}

/// Of the case's own motions (s): 20, or 200 periods of the excitation where these are longer, but
/// no more than 500 000 samples (fewer for a force of many harmonics), nor after the end of a
/// recorded force.
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

/// @param shown  false: without the values along the abscissa, which take motions to find
std::vector<SwitchingChart> charts_of(const Case& the_case, bool shown) {
  const std::string meaning =
      " Above: largest |z₁| at all times in the second half of " +
      rounded(studied_duration(the_case), 4) +
      " s or more; curves leave the picture at the top where the motion grows or diverges. Below: "
      "certified period over the shortest one, after which sampling and forcing coincide again; "
      "\"none\": no certified orbit was found. Dotted upright: the case itself.";
  const double period = the_case.control.sampling_period, width = the_case.backlash.width;
  const auto none = std::vector<double>();
  return {
      {{"switching-delay",
        "Amplitude and period over the sampling period",
        "The backlash is r₀ = " + milli(width) +
            " mm. At samples the drive enters and leaves its backlash only when the computer "
            "looks; "
            "exactly, when it happens. As τ becomes short the two come together." +
            meaning,
        {},
        ""},
       "control.sampling_period",
       "$2",
       "sampling period τ (ms)",
       shown ? shown_sampling_periods(the_case) : none,
       period},
      {{"switching-backlash",
        "Amplitude and period over the backlash",
        "The sampling period is τ = " + milli(period) +
            " ms. At r₀ = 0 there is no switching, and what is left between the curves is the hold "
            "of the force; at the right end the backlash swallows the motion without control." +
            meaning,
        {},
        ""},
       "backlash.width",
       "$3",
       "backlash {/:Italic r}_0 (mm)",
       shown ? shown_widths(the_case) : none,
       width}};
}

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

std::string phases_caption(const Case& the_case, const Reading& sampled, bool builtin) {
  const bool held = sampled.hold == ForceHold::sampled;
  return loop_text(the_case) +
         ". Top: the contact where the drive switches at samples (the force " +
         (held ? "held over each sample as in the paper" : "exact") +
         "), with the instants in s at which it goes into its gap and out of it" +
         (builtin ? ", which are those of the paper's Fig. 8" : "") +
         "; and where it switches exactly (the force exact): after a reversal its sides stay "
         "together (stick), then it crosses its gap, then it transmits again. Middle: the force "
         "transmitted; while the drive sticks it lies between zero and the command u. Bottom: "
         "z₂ − z₁, which stands still meanwhile. Tints: the phases of the exact motion.";
}

DrawnFigure write_phases(const JobContext& context, bool builtin) {
  const Case& the_case = context.case_data;
  constexpr int instants = 601;
  const bool held = force_hold_of(the_case) == ForceHold::sampled;
  const Reading& reading = readings[held ? sampled_and_held : sampled_switching];
  DrawnFigure drawn;
  drawn.figure.name = "switching-phases";
  drawn.figure.title = builtin ? "Fig. 8 with its stick phase, τ = 1 ms, r₀ = 0.5 mm"
                               : "What the drive does between the samples";
  drawn.figure.caption = phases_caption(the_case, reading, builtin);
  try {
    const ContactStrip sampled = strip_of("at samples", {the_case, reading, 0.0}, instants);
    const ContactStrip exact =
        strip_of("exact", {the_case, readings[exact_switching], 0.0}, instants);
    write_strips(context, drawn.figure.name, {sampled, exact});
    write_window(context, drawn.figure.name + "-motion", exact.window, sampled.window);
    draw_window(drawn.figure, sampled, exact);
  } catch (const NoAnswer& reason) {
    drawn.reason = reason.what();
  }
  return drawn;
}

/// The values of backlash.law, and their words: gnuplot sets what follows an underscore lower.
constexpr std::array<std::pair<const char*, const char*>, 5> law_words = {
    {{"kollar", "kollar"},
     {"immediate", "immediate"},
     {"play", "play"},
     {"dead_zone", "dead zone"},
     {"none", "no backlash"}}};

std::vector<StudiedLaw> study_laws(const JobContext& context) {
  Loops loops;
  for (const auto& law : law_words) {
    Case changed = context.case_data;
    changed.backlash.law = law.first;
    for (const std::size_t reading : {sampled_switching, exact_switching})
      loops.push_back({changed, readings[reading], studied_duration(changed)});
  }
  const Motions motions = study(loops, context.threads);
  write_motions(context, "switching-law-motions", motions);
  std::vector<StudiedLaw> studied;
  for (std::size_t k = 0; k < law_words.size(); ++k)
    studied.push_back({law_words[k].second, motions[2 * k], motions[2 * k + 1]});
  return studied;
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
std::vector<ContactStrip> strips_of_laws(const std::vector<StudiedLaw>& studied) {
  std::vector<ContactStrip> strips;
  const auto add = [&](std::size_t law, const char* how, bool exact) {
    const StudiedLaw& of = studied[law];
    strips.push_back(strip_with_amplitude(how, exact ? of.exact : of.sampled));
  };
  add(0, "kollar, at samples", false);
  add(1, "immediate, at samples", false);
  add(2, "play, at samples", false);
  add(2, "these three, exact", true);
  add(3, "dead zone, at samples", false);
  add(3, "dead zone, exact", true);
  add(4, "no backlash", false);
  return strips;
}

constexpr const char* nowhere = "the motion diverges in all of them";

DrawnFigure write_laws(const JobContext& context, const std::vector<StudiedLaw>& studied) {
  const std::vector<ContactStrip> strips = strips_of_laws(studied);
  const bool empty = std::all_of(strips.begin(), strips.end(), [](const ContactStrip& strip) {
    return strip.window.phases.empty();
  });
  Figure figure{
      "switching-laws",
      "The same for every law of the backlash",
      "What the drive does under each law, switching at samples and exactly, the force exact in "
      "all; at the right the largest |z₁| of the steady motion. Exactly taken, kollar, immediate "
      "and play are one law. The gap of the dead zone lies about z₂ − z₁ = 0 and does not move.",
      {},
      ""};
  write_strips(context, figure.name, strips);
  draw_strips(figure, strips);
  return {figure, {}, "", empty ? nowhere : ""};
}

/// What the charts show: half as much again as without control, and the case's own motions.
ShownAmplitudes shown_amplitudes(const Case& the_case, const Motions& of_case) {
  const double free = amplitude_without_control(the_case, studied_duration(the_case));
  double largest = 1.5 * free;
  for (const StudiedMotion& motion : of_case)
    largest = std::fmax(largest, 1.2 * motion.steady.largest_displacement);
  return {free, largest};
}

DrawnFigure write_chart(const JobContext& context, SwitchingChart chart,
                        const ShownAmplitudes& amplitudes) {
  const Motions motions =
      study(loops_over(context.case_data, chart.key, chart.values), context.threads);
  write_motions(context, chart.figure.name, motions);
  const bool empty = std::none_of(motions.begin(), motions.end(), [](const StudiedMotion& motion) {
    return std::isfinite(motion.steady.largest_displacement);
  });
  draw_chart(chart, amplitudes);
  return {chart.figure, {}, "", empty ? nowhere : ""};
}

/// The charts; without their pictures where the force has many harmonics: they take two hundred
/// motions, whose work grows with these.
void add_charts(std::vector<DrawnFigure>& figures, const JobContext& context,
                const Motions& of_case) {
  const Case& the_case = context.case_data;
  constexpr std::size_t most_harmonics = 20;
  const std::size_t harmonics = harmonics_of(the_case);
  if (harmonics > most_harmonics) {
    const std::string reason = "the force has " + std::to_string(harmonics) +
                               " harmonics, too many to follow hundreds of motions";
    for (const SwitchingChart& chart : charts_of(the_case, false))
      figures.push_back({chart.figure, {}, "", reason});
    return;
  }
  const ShownAmplitudes amplitudes = shown_amplitudes(the_case, of_case);
  for (const SwitchingChart& chart : charts_of(the_case, true))
    figures.push_back(write_chart(context, chart, amplitudes));
}

}  // namespace

std::vector<StudiedLoop> loops_of_paper(const Case& the_case) {
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
