#include "report/page/answers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "case/case_keys.hpp"
#include "case/model/loop_of_case.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/design/max_delay.hpp"
#include "holdfast/stability/margins/margins.hpp"
#include "io/text/text.hpp"
#include "jobs/design/best_gains.hpp"
#include "jobs/motion/cell_motion.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "report/page/command_line.hpp"
#include "report/page/html.hpp"
#include "report/page/motions.hpp"
#include "report/switching/switching_study.hpp"

namespace holdfast::program {
namespace {

/// Seconds of a motion: 20, or as long as the case's force lasts.
double duration_of(const Case& the_case) { return std::min(20.0, end_of_force(the_case)); }

std::string millimetres(double length) { return rounded(1e3 * length, 3) + " mm"; }
std::string milliseconds(double time) { return rounded(1e3 * time, 3) + " ms"; }
std::string percent(double share) { return rounded(100.0 * share, 3) + " %"; }
std::string damping(double gain) { return rounded(gain, 4) + " N s/m"; }

std::string range_of(double value) {
  const std::string text = format_number(value);
  return text + ":" + text + ":1";
}

/// Largest |z₁| of the steady motion with control and without it, and what the drive does for it.
struct Vibration {
  double controlled, free;
  double engaged;  ///< share of the samples at which the drive transmits
  double force;    ///< N, the largest that the computer asks for

  double ratio() const { return controlled / free; }
  bool is_reduced() const { return controlled < free; }
};

/// Largest |z₁| (m) of the steady motion without control.
double free_vibration(const Case& the_case, InstructionSet set) {
  const double duration = duration_of(the_case);
  const CellMotion motion = cell_motion(the_case, Switching::sampled, duration);
  return metrics_of({without_control(motion)}, duration, set).front().steady_peak;
}

/// @param free  free_vibration() of each of them
std::vector<Vibration> vibrations_of(const std::vector<Case>& cases, double free,
                                     InstructionSet set, Switching switching = Switching::sampled) {
  const double duration = duration_of(cases.front());
  std::vector<CellMotion> motions;
  motions.reserve(cases.size());
  for (const Case& the_case : cases) motions.push_back(cell_motion(the_case, switching, duration));
  std::vector<Vibration> vibrations;
  vibrations.reserve(cases.size());
  for (const MotionMetrics& metrics : metrics_of(motions, duration, set))
    vibrations.push_back({metrics.steady_peak, free, metrics.engaged_fraction, metrics.force_peak});
  return vibrations;
}

std::string help_text(const Vibration& vibration) {
  constexpr double negligible = 0.005;
  if (vibration.engaged == 0.0)
    return "No: the drive never leaves its play, and the vibration is that without control.";
  if (std::abs(vibration.ratio() - 1.0) < negligible)
    return "No: the vibration is the same as without control, " + millimetres(vibration.free) + ".";
  return std::string(vibration.is_reduced() ? "Yes: " : "No: ") + percent(vibration.ratio()) +
         " of the vibration is left, " + millimetres(vibration.controlled) + " of " +
         millimetres(vibration.free) + ".";
}

/// What a loop that is unstable owes to its play.
std::string instability_text(const Case& the_case) {
  const double radius = spectral_radius(loop_of(the_case).engaged_map(gains_of(the_case)));
  if (radius < 1.0) return "";
  return " But without play the loop is unstable with these gains (spectral radius " +
         rounded(radius, 5) + "): nothing but the play bounds the motion.";
}

std::string force_text(const Vibration& vibration) {
  return " The computer asks the drive for up to " + rounded(vibration.force, 3) + " N.";
}

/// What is left where the drive switches when it happens and not at samples.
std::string exact_switching_text(const Case& the_case, double free, InstructionSet set) {
  if (!(the_case.backlash.width > 0.0)) return "";
  const Vibration exact = vibrations_of({the_case}, free, set, Switching::exact).front();
  if (!std::isfinite(exact.ratio())) return "";
  return " A drive that enters and leaves its play when it happens, not at samples, leaves " +
         percent(exact.ratio()) + ".";
}

/// The gains and the play that the user's case leaves to the built-in one.
std::string borrowed_text(const Case& the_case) {
  if (!the_case.plant_given && !the_case.conductor_given) return "";
  std::string names;
  for (const char* key : {"control.proportional_gain", "control.differential_gain",
                          "control.sampling_period", "backlash.width"})
    if (the_case.places.count(key) == 0) names += (names.empty() ? "" : ", ") + std::string(key);
  if (names.empty()) return "";
  return " Your case does not give " + names + ": the built-in value stands in.";
}

Answer does_it_help(const Case& the_case, const Vibration& vibration, InstructionSet set) {
  Answer answer{"Does control help here?", "",
                "Largest |z₁| in the second half of " + rounded(duration_of(the_case), 3) +
                    " s from the case's initial state, with its backlash of " +
                    millimetres(the_case.backlash.width) +
                    ", beside the same without control force.",
                words_of("sweep --axis backlash.width=" + range_of(the_case.backlash.width) +
                         " --metric steady_peak --metric ratio_to_uncontrolled")};
  if (!(vibration.free > 0.0)) {
    answer.answer = "Nothing vibrates without control either: there is nothing to reduce.";
  } else if (!std::isfinite(vibration.controlled)) {
    answer.answer = "No: with these gains the motion grows without end.";
  } else {
    answer.answer = help_text(vibration) + instability_text(the_case);
    answer.detail += force_text(vibration) + exact_switching_text(the_case, vibration.free, set);
  }
  answer.detail += borrowed_text(the_case);
  return answer;
}

/// "from −1 to 3 N/m", "up to 3 N/m".
std::string stretch_text(const TwoSidedMargin& margin, double unit, const std::string& name) {
  const auto is_end = [](const MarginEnd& at) { return at.outcome == MarginEndOutcome::boundary; };
  const auto text = [unit](const MarginEnd& at) { return rounded(unit * at.position, 4); };
  const std::string below = text(margin.below), above = text(margin.above);
  if (is_end(margin.below) && is_end(margin.above))
    return "from " + below + " to " + above + " " + name;
  if (is_end(margin.above)) return "up to " + above + " " + name;
  return is_end(margin.below) ? "from " + below + " " + name + " on" : "of any size";
}

std::string margins_text(const Case& the_case, const PdGains<double>& gains) {
  const StabilityMargins margins =
      stability_margins(plant_of(the_case), sampling_of(the_case), gains);
  if (margins.outcome == MarginOutcome::not_stable) return "With it the loop is not stable.";
  return "With it the loop is stable for D " +
         stretch_text(margins.differential_gain, 1.0, "N s/m") + ", for P " +
         stretch_text(margins.proportional_gain, 1.0, "N/m") + ", and for sampling periods " +
         stretch_text(margins.sampling_period, 1e3, "ms") + ", each alone.";
}

std::string gain_of_case_text(const Case& the_case) {
  const TwoMass<double> plant = plant_of(the_case);
  const double tuned = tuned_proportional_gain(plant.absorber_stiffness, plant.absorber_mass,
                                               excitation_of(the_case).frequency);
  const PdGains<double> gains = gains_of(the_case);
  return " The case has D = " + damping(gains.differential) +
         " and P = " + rounded(gains.proportional, 4) +
         " N/m; tuned to its frequency (Eq. 6) P is " + rounded(tuned, 4) + " N/m.";
}

/// What a gain leaves with the play that the case has.
std::string in_play_text(const Case& the_case, double differential_gain, double free,
                         InstructionSet set) {
  if (!(the_case.backlash.width > 0.0)) return "";
  const Case changed = case_with(the_case, "control.differential_gain", differential_gain);
  const Vibration vibration = vibrations_of({changed}, free, set).front();
  if (!std::isfinite(vibration.ratio())) return "";
  return " With the case's play of " + millimetres(the_case.backlash.width) + " it leaves " +
         percent(vibration.ratio()) + "." + force_text(vibration);
}

Answer which_gain(const Case& the_case, double free, InstructionSet set) {
  const IdealLoop<double> loop = ideal_loop_of(the_case);
  const double duration = duration_of(the_case);
  const MinimumAmplitude best = BestGains(duration).of(loop);
  const double largest_radius = std::exp(-10.0 * loop.sampling.period / duration);
  Answer answer{"Which D?", "", "", {"design", "--largest-radius", format_number(largest_radius)}};
  if (best.outcome == MinimumAmplitudeOutcome::none) {
    answer.answer = "None: at the case's P no D lets the motion settle in " +
                    rounded(0.5 * duration, 3) + " s.";
  } else if (best.outcome == MinimumAmplitudeOutcome::aliased) {
    answer.answer =
        "None: the computer takes fewer than two samples in a period of the vibration and does "
        "not see it.";
  } else {
    answer.answer = "D = " + damping(best.differential_gain) + ": with an ideal drive it leaves " +
                    percent(best.ratio_to_uncontrolled) + " of the amplitude without control.";
    answer.detail = "Of the gains that let the motion settle in " + rounded(0.5 * duration, 3) +
                    " s the one of least steady amplitude. " +
                    margins_text(the_case, {loop.gains.proportional, best.differential_gain}) +
                    in_play_text(the_case, best.differential_gain, free, set);
  }
  answer.detail += gain_of_case_text(the_case);
  return answer;
}

/// "; with the gains of the case up to 12 ms; the case has 1 ms."
std::string own_period_text(const Case& the_case) {
  const StabilityMargins margins =
      stability_margins(plant_of(the_case), sampling_of(the_case), gains_of(the_case));
  const MarginEnd& longest = margins.sampling_period.above;
  std::string text = "; with the gains of the case ";
  if (margins.outcome == MarginOutcome::not_stable)
    text += "the loop is not stable even now";
  else if (longest.outcome == MarginEndOutcome::boundary)
    text += "it is stable up to " + milliseconds(longest.position);
  else
    text += "no limit of stability was found";
  return text + "; the case has " + milliseconds(the_case.control.sampling_period) + ".";
}

Answer how_slow(const Case& the_case) {
  const TwoMass<double> plant = plant_of(the_case);
  MaxDelayOptions question;
  question.criterion = DelayCriterion::attenuates;
  question.hold = force_hold_of(the_case);
  question.delay_fraction = the_case.control.processing_delay / the_case.control.sampling_period;
  question.frequency = excitation_of(the_case).frequency;
  question.proportional_gain =
      tuned_proportional_gain(plant.absorber_stiffness, plant.absorber_mass, question.frequency);
  const MaxDelay longest = max_sampling_period(plant, question);
  Answer answer{"How slow may the computer be?",
                "",
                "Up to there some D, P being tuned to the excitation, is stable and leaves less "
                "vibration than no control; the drive is ideal, and the processing delay keeps its "
                "share of the period.",
                {"max-delay", "--frequency", range_of(question.frequency)}};
  const std::string own = own_period_text(the_case);
  if (!(longest.sampling_period > 0.0))
    answer.answer = "No sampling period serves at this frequency" + own;
  else if (std::isinf(longest.sampling_period))
    answer.answer = "No largest sampling period was found" + own;
  else
    answer.answer =
        "Up to " + milliseconds(longest.sampling_period) + " a sample if D is chosen for it" + own;
  return answer;
}

/// The first of ascending widths with which control does not reduce the vibration.
std::optional<std::size_t> first_too_wide(const Case& the_case, const std::vector<double>& widths,
                                          double free, InstructionSet set) {
  std::vector<Case> cases;
  cases.reserve(widths.size());
  for (const double width : widths) cases.push_back(case_with(the_case, "backlash.width", width));
  const std::vector<Vibration> vibrations = vibrations_of(cases, free, set);
  for (std::size_t k = 0; k < widths.size(); ++k)
    if (!vibrations[k].is_reduced()) return k;
  return std::nullopt;
}

std::vector<double> evenly(double from, double to, int parts) {
  std::vector<double> values;
  for (int part = 0; part <= parts; ++part) values.push_back(from + (to - from) * part / parts);
  return values;
}

/// The play that swallows the whole motion without control, and some half as much again.
double widest_play(const Case& the_case) {
  const double swing = swing_without_control(the_case, duration_of(the_case));
  if (!(swing > 0.0 && std::isfinite(swing))) return 1e-3;
  const double per_unit = std::pow(10.0, 1.0 - std::floor(std::log10(swing)));
  return std::ceil(1.5 * swing * per_unit) / per_unit;
}

Answer how_much_play(const Case& the_case, const Vibration& vibration, InstructionSet set) {
  constexpr int parts = 120, finer_parts = 20;
  const double widest = widest_play(the_case), step = widest / parts;
  Answer answer{
      "How much play may the belt have?", "",
      "With the case's gains, from its initial state. " + std::to_string(parts) + " widths up to " +
          millimetres(widest) +
          " were tried, and those about the limit more finely. Wider ones may serve too, but not "
          "all of them.",
      words_of("sweep --axis backlash.width=0:" + format_number(widest) + ":" +
               std::to_string(parts + 1) + " --metric ratio_to_uncontrolled")};
  if (!(vibration.free > 0.0)) {
    answer.answer = "Nothing vibrates: any.";
    return answer;
  }
  const auto coarse = first_too_wide(the_case, evenly(0.0, widest, parts), vibration.free, set);
  const std::string own = "; the case has " + millimetres(the_case.backlash.width) + ".";
  if (!coarse) {
    answer.answer = "Every play up to " + millimetres(widest) + " that was tried serves" + own;
  } else if (*coarse == 0) {
    answer.answer = "None: control does not help without any play either" + own;
  } else {
    const double begin = step * static_cast<double>(*coarse - 1);
    const auto widths = evenly(begin, begin + step, finer_parts);
    const std::size_t first =
        first_too_wide(the_case, widths, vibration.free, set).value_or(widths.size() - 1);
    answer.answer =
        "Up to " + millimetres(widths[first > 0 ? first - 1 : 0]) + " it still helps" + own;
  }
  return answer;
}

Answer what_motion(const Case& the_case) {
  const MotionRow row = motion_of_the_case(the_case);
  const bool has_period = !row.period.empty() && row.period != "–";
  return {"What is the motion?", row.verdict + (has_period ? ": " + row.period : "") + ".",
          row.rests_on, row.arguments};
}

}  // namespace

std::vector<Answer> answers_of(const Case& the_case, InstructionSet set) {
  const Vibration vibration = vibrations_of({the_case}, free_vibration(the_case, set), set).front();
  std::vector<Answer> answers = {does_it_help(the_case, vibration, set),
                                 which_gain(the_case, vibration.free, set), how_slow(the_case)};
  throw_if_interrupted();
  answers.push_back(how_much_play(the_case, vibration, set));
  answers.push_back(what_motion(the_case));
  return answers;
}

std::string html_of(const std::vector<Answer>& answers,
                    const std::vector<std::string>& case_arguments) {
  std::string html = "<section id=\"answers\">\n<h2>The answers</h2>\n";
  for (const Answer& answer : answers) {
    html += "<div class=\"answer\">\n<h3>" + escaped(answer.question) +
            "</h3>\n<p class=\"said\">" + escaped(answer.answer) + "</p>\n<p class=\"why\">" +
            escaped(answer.detail) + "</p>\n<pre>" +
            escaped(shell_text(answer.arguments, case_arguments)) + "</pre>\n</div>\n";
  }
  return html + "</section>\n";
}

}  // namespace holdfast::program
