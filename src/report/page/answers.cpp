#include "report/page/answers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "case/case_keys.hpp"
#include "case/model/cable_of_case.hpp"
#include "case/model/conditioning.hpp"
#include "case/model/linear_loop.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/modal/conductor_modes.hpp"
#include "case/model/plant_of_case.hpp"
#include "case/model/span/span_of_case.hpp"
#include "case/plausibility/doubts.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/motion/instant.hpp"
#include "holdfast/orbit/modal/modal_orbit_search.hpp"
#include "holdfast/span/end_response.hpp"
#include "holdfast/stability/design/max_delay.hpp"
#include "holdfast/stability/margins/margins.hpp"
#include "jobs/design/best_gains.hpp"
#include "jobs/design/gain_margins.hpp"
#include "jobs/family/family_proof.hpp"
#include "jobs/motion/case_motion.hpp"
#include "jobs/motion/cell_motion.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "report/page/html.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

std::string millimetres(double length) { return rounded(1e3 * length, 3) + " mm"; }
std::string milliseconds(double time) { return rounded(1e3 * time, 3) + " ms"; }
std::string percent(double share) { return rounded(100.0 * share, 3) + " %"; }
std::string damping(double gain) { return rounded(gain, 4) + " N s/m"; }

std::string range_of(double value) {
  return format_number(value) + ":" + format_number(value) + ":1";
}

/// Least amplitude ratio at which control counts as useless.
constexpr double worthwhile = 0.95;

/// Largest change of the amplitude ratio that counts as none.
constexpr double negligible = 0.005;

/// Largest |z₁| of the steady motion with and without control, and the largest commanded force.
struct LoopVibration {
  double controlled, free, force;  ///< |z₁| with and without control (m), command (N)

  double ratio() const { return controlled / free; }
};

/// Duration (s) of the simulated motions: 20 s, or less if the case's recorded force ends earlier.
double duration_of(const Case& the_case) { return std::min(20.0, end_of_force(the_case)); }

/// Data common to all answers about a case.
struct Question {
  const Case& the_case;
  InstructionSet set;
  MotionRow motion;  ///< description of the case's motion
  double free;  ///< largest |z₁| (m) of the steady motion without control, under the true force
  double radius_without_play;  ///< spectral radius of the loop without play
  bool begins_steady;          ///< whether motions begin as steady ones without play

  bool is_unstable_without_play() const { return !(radius_without_play < 1.0); }
  /// Time (s) in which the slowest natural motion without play decays to a twentieth.
  double settling() const {
    return settling_time(radius_without_play, the_case.control.sampling_period);
  }
  bool settles_slowly() const { return settling() > 0.5 * duration_of(the_case); }
  bool is_transient() const { return settles_slowly() && !begins_steady; }
  bool asks_for_no_force() const {
    const PdGains<double> gains = gains_of(the_case);
    return gains.proportional == 0.0 && gains.differential == 0.0;
  }
};

/// Start of motions of a conductor in the paper's model: the steady motion without play. A start
/// from rest excites slow natural motions, which take minutes to decay.
class SteadyStart {
 public:
  /// Sets the initial state, unless the case has one. Where the play is so wide that the motion
  /// without control does not cross it, the drive is idle, and this is the motion.
  /// @return whether the motion has this start
  bool give_to(MovingLoop& moving) {
    auto* const modes = std::get_if<SampledModes>(&moving);
    if (modes == nullptr || modes->poles.empty() || !modes->state.isZero(0.0)) return false;
    const ModalLoop& loop = modes->loop;
    const std::optional<Rational> ratio = forcing_ratio(loop);
    if (!ratio) return false;
    if (!gains_ || gains_->proportional != loop.gains.proportional ||
        gains_->differential != loop.gains.differential) {
      ModalLoop alone = loop;
      alone.gains = {0.0, 0.0};
      const ModalItineraryMaps maps(alone, modes->poles, *ratio);
      // The phasor of Δz, from its values at two samples; twice its size is not exceeded at any.
      std::vector<Vector<double, 5>> seen(2);
      maps.follow(maps.steady(), {1, 1}, seen);
      const double turn = 2.0 * pi<double> * loop.excitation.frequency * loop.sampling.period;
      const double first = seen[0][2] - seen[0][0], second = seen[1][2] - seen[1][0];
      swing_ = 2.0 * std::hypot(first, (first * std::cos(turn) - second) / std::sin(turn));
      free_ = steady_state(alone, modes->poles, maps);
      driven_ = steady_state(loop, modes->poles, ModalItineraryMaps(loop, modes->poles, *ratio));
      gains_ = loop.gains;
    }
    const bool idle = loop.backlash_width >= swing_;
    const ModalMotion::Full& start = idle ? free_ : driven_;
    if (!start.allFinite()) return false;
    modes->state = start;
    if (idle) modes->loop.gains = {0.0, 0.0};
    return true;
  }

 private:
  static ModalMotion::Full steady_state(const ModalLoop& loop, const std::vector<PlantPole>& poles,
                                        const ModalItineraryMaps& maps) {
    return NaturalMotions(loop, poles).state_of(maps.amplitudes(maps.steady()));
  }

  std::optional<PdGains<double>> gains_;  // of the known states
  ModalMotion::Full driven_, free_;       // with and without control
  double swing_ = 0.0;                    // range of z₂ − z₁ without control (m)
};

/// Computes the common data. Throws InvalidParameter where the case's loop is not admissible.
Question question_about(const Case& the_case, InstructionSet set) {
  constexpr double motions = 150.0;  // that the answers compare
  const double duration = duration_of(the_case);
  require_bearable(motions * duration / the_case.control.sampling_period);
  MotionRow motion = motion_of_the_case(the_case);
  MovingLoop alone = motion_without_control(the_case, duration);
  const double radius = LinearLoop(the_case).radius(gains_of(the_case));
  const bool steady = SteadyStart().give_to(alone) && radius < 1.0;
  return {
      the_case, set,   std::move(motion), metrics_of({alone}, duration, set).front().steady_peak,
      radius,   steady};
}

/// The vibration of each of several cases, which differ from the question's case in one key only.
std::vector<LoopVibration> vibrations_of(const std::vector<Case>& cases, const Question& question) {
  const double duration = duration_of(cases.front());
  std::vector<MovingLoop> motions;
  motions.reserve(cases.size());
  SteadyStart start;
  for (const Case& the_case : cases) {
    motions.push_back(cell_motion(the_case, Switching::sampled, duration));
    if (question.begins_steady) start.give_to(motions.back());
  }
  std::vector<LoopVibration> vibrations;
  vibrations.reserve(cases.size());
  for (const MotionMetrics& metrics : metrics_of(motions, duration, question.set))
    vibrations.push_back({metrics.steady_peak, question.free, metrics.force_peak});
  return vibrations;
}

/// Text on the vibration left by control. If the loop is unstable without play, the text adds that
/// only the play bounds the motion, or that the motion grows.
std::string help_text(const Question& question, const LoopVibration& vibration) {
  const bool unstable = question.is_unstable_without_play();
  const auto& backlash = question.the_case.backlash;
  const bool lives_on_play = unstable && backlash.width > 0.0 && backlash.law != "none";
  const char* helps = !(vibration.controlled < vibration.free) || (unstable && !lives_on_play)
                          ? "No"
                      : lives_on_play                  ? "Only thanks to the play"
                      : vibration.ratio() < worthwhile ? "Yes"
                                                       : "Hardly";
  const char* text = "vibration left";
  if (question.motion.stays_in_play)
    text = "idle drive";
  else if (!unstable && std::abs(vibration.ratio() - 1.0) < negligible)
    text = "same vibration";
  // A root just outside the circle is told from one on it.
  const int digits = std::abs(question.radius_without_play - 1.0) < 1e-4 ? 9 : 5;
  const Values values = {{"helps", helps},
                         {"ratio", percent(vibration.ratio())},
                         {"controlled", millimetres(vibration.controlled)},
                         {"free", millimetres(vibration.free)},
                         {"radius", rounded(question.radius_without_play, digits)}};
  if (!unstable) return page_text(text, values);
  return page_text(text, values) +
         page_text(lives_on_play ? "bounded by play" : "grows without play", values);
}

/// Text on the vibration without control under the force held between samples; empty if holding
/// the force has no noticeable effect.
std::string held_force_text(const Question& question) {
  const Case& the_case = question.the_case;
  if (held_force_warning(the_case, "").empty()) return "";
  const double share =
      held_share(the_case, the_case.control.sampling_period, excitation_of(the_case).frequency);
  return page_text("force held", {{"held", millimetres(share * question.free)},
                                  {"true", millimetres(question.free)}});
}

std::string force_text(const LoopVibration& vibration) {
  if (vibration.force == 0.0) return "";
  return page_text("force asked for", {{"force", rounded(vibration.force, 3)}});
}

Answer what_is_doubtful(const std::vector<std::string>& doubts) {
  Answer answer = asked("doubt", {});
  for (const std::string& doubt : doubts)
    answer.answer += (answer.answer.empty() ? "" : " ") + doubt + (doubt.back() == '?' ? "" : ".");
  return answer;
}

Answer does_it_help(const Question& question) {
  const Case& the_case = question.the_case;
  const LoopVibration vibration = vibrations_of({the_case}, question).front();
  Answer answer = asked("help", {{"duration", rounded(duration_of(the_case), 3)},
                                 {"play", millimetres(the_case.backlash.width)},
                                 {"range", range_of(the_case.backlash.width)}});
  if (question.motion.diverges || !std::isfinite(vibration.controlled)) {
    answer.answer = page_text("diverges");
  } else if (2.0 * the_case.control.sampling_period * excitation_of(the_case).frequency > 1.0) {
    answer.answer = page_text("unseen");
  } else if (!(vibration.free > 0.0)) {
    answer.answer = page_text("nothing to reduce");
  } else if (question.asks_for_no_force()) {
    answer.answer = page_text("no gains", {{"free", millimetres(vibration.free)}});
  } else {
    answer.answer = help_text(question, vibration);
    answer.detail += force_text(vibration);
    if (question.settles_slowly())
      answer.detail += page_text(question.begins_steady ? "begun steady" : "not settled",
                                 {{"time", rounded(question.settling(), 2)}});
  }
  const std::string names = borrowed_control(the_case);
  answer.detail +=
      held_force_text(question) + (names.empty() ? "" : page_text("not given", {{"names", names}}));
  return answer;
}

/// Text of a stable range: "from −1 to 3 N/m", "up to 3 N/m".
std::string stretch_text(const TwoSidedMargin& margin, double unit, const std::string& name) {
  const auto is_end = [](const MarginEnd& at) { return at.outcome == MarginEndOutcome::boundary; };
  const auto text = [unit](const MarginEnd& at) { return rounded(unit * at.position, 4); };
  const std::string below = text(margin.below), above = text(margin.above);
  if (is_end(margin.below) && is_end(margin.above))
    return range_text(below, above, "from ") + " " + name;
  const bool walked = margin.above.outcome == MarginEndOutcome::beyond_search;
  if (is_end(margin.above)) return "up to " + above + " " + name;
  return (is_end(margin.below) ? "from " + below + " " + name + " on" : "of any size") +
         (walked ? ", searched up to " + above + " " + name : "");
}

std::string margins_text(const Case& the_case, const PdGains<double>& gains) {
  const StabilityMargins margins = stability_margins_of(the_case, gains, false).margins;
  if (margins.outcome == MarginOutcome::not_stable) return page_text("not stable with it");
  return page_text("stable with it",
                   {{"D", stretch_text(margins.differential_gain, 1.0, "N s/m")},
                    {"P", stretch_text(margins.proportional_gain, 1.0, "N/m")},
                    {"periods", stretch_text(margins.sampling_period, 1e3, "ms")}});
}

/// Text of the margins: "; gain margin 9 dB, phase margin 15°, delay margin more than 10 ms, …".
std::string gain_margins_text(const Case& the_case, const PdGains<double>& gains) {
  const GainMargins margins = gain_margins(LinearLoop(the_case), gains);
  const auto number = [](double value, const char* unit) {
    return std::isfinite(value) ? rounded(value, 3) + unit : std::string("without end");
  };
  return page_text("margins of gain", {{"gain", number(margins.gain_decibels, " dB")},
                                       {"phase", number(margins.phase_degrees, "°")},
                                       {"delay", (margins.is_delay_of_search ? "at least " : "") +
                                                     milliseconds(margins.delay)},
                                       {"radius", rounded(margins.spectral_radius, 10)}});
}

std::string gain_of_case_text(const Case& the_case) {
  const double tuned =
      tuned_delay_question(the_case, excitation_of(the_case).frequency).proportional_gain;
  const PdGains<double> gains = gains_of(the_case);
  return page_text("gains of case", {{"D", damping(gains.differential)},
                                     {"P", rounded(gains.proportional, 4)},
                                     {"tuned", rounded(tuned, 4)}});
}

/// Adds how much of a wave on the conductor its end with the absorber takes at the excitation
/// frequency: to the answer if these gains take clearly less of it than the absorber alone.
void add_waves(Answer& answer, const Case& the_case, double differential_gain) {
  if (!has_own_cable(the_case) || is_two_masses(the_case)) return;
  const Case changed = case_with(the_case, "control.differential_gain", differential_gain);
  const TautString<double> string = string_of(changed);
  const double omega = 2.0 * pi<double> * excitation_of(changed).frequency;
  const auto ratio = [&](bool controlled) {
    const std::vector<SpanDevice> devices = span_devices_of(changed, controlled);
    const auto ends = span_ends(devices, string.span);
    const SpanEnd& end = ends[ends[0].devices.empty() ? 1 : 0];
    return end_response(string, end, omega).inverse_standing_wave_ratio();
  };
  const double alone = ratio(false), with = ratio(true);
  const bool worse = with < 0.9 * alone;
  (worse ? answer.answer : answer.detail) +=
      page_text(worse ? "waves left" : "waves taken",
                {{"alone", rounded(alone, 3)}, {"with", rounded(with, 3)}});
}

/// Adds the effect of the play on a gain to the detail, or to the answer if play spoils the gain.
void add_play(Answer& answer, const Question& question, double differential_gain, double ideal) {
  if (!(question.the_case.backlash.width > 0.0)) return;
  const Case changed = case_with(question.the_case, "control.differential_gain", differential_gain);
  const LoopVibration vibration = vibrations_of({changed}, question).front();
  if (!std::isfinite(vibration.ratio())) return;
  const bool spoilt =
      ideal < worthwhile && !(vibration.ratio() < worthwhile) && !question.is_transient();
  const Values values = {{"play", millimetres(question.the_case.backlash.width)},
                         {"ratio", percent(vibration.ratio())}};
  if (spoilt) answer.answer += page_text("spoilt by play", values);
  answer.detail += (spoilt ? "" : page_text("left in play", values)) + force_text(vibration);
}

Answer which_gain(const Question& question) {
  const Case& the_case = question.the_case;
  const double duration = duration_of(the_case);
  const MinimumAmplitude best = BestGains(duration).of(the_case);
  const PdGains<double> gains{gains_of(the_case).proportional, best.differential_gain};
  const Values values = {
      {"settled", rounded(0.5 * duration, 3)},
      {"margins", std::isfinite(gains.differential) ? gain_margins_text(the_case, gains) : ""},
      {"D", damping(best.differential_gain)},
      {"ratio", percent(best.ratio_to_uncontrolled)},
      {"radius", format_number(std::exp(-10.0 * the_case.control.sampling_period / duration))},
      {"margin", format_number(usual_margin)}};
  const bool must_settle = is_two_masses(the_case);
  Answer answer = asked(must_settle ? "gain" : "gain of modes", values);
  if (best.outcome == MinimumAmplitudeOutcome::none) {
    answer.answer = page_text(must_settle ? "no gain settles" : "no stable gain", values);
  } else if (best.outcome == MinimumAmplitudeOutcome::aliased) {
    answer.answer = page_text("aliased");
  } else {
    const char* text = best.ratio_to_uncontrolled < worthwhile ? "best gain" : "no gain worth it";
    answer.answer = page_text(text, values);
    answer.detail = page_text(must_settle ? "best of settling" : "best of stable", values) +
                    margins_text(the_case, gains);
    add_play(answer, question, best.differential_gain, best.ratio_to_uncontrolled);
    add_waves(answer, the_case, best.differential_gain);
  }
  answer.detail += gain_of_case_text(the_case);
  return answer;
}

/// Text on the longest period: "; with the gains of the case up to 12 ms; the case has 1 ms."
std::string own_period_text(const Case& the_case) {
  const auto [margins, everywhere] = stability_margins_of(the_case, gains_of(the_case), false);
  const MarginEnd& longest = margins.sampling_period.above;
  const char* limit = everywhere ? "stable up to" : "stable by steps";
  if (longest.outcome != MarginEndOutcome::boundary) limit = "no limit";
  if (margins.outcome == MarginOutcome::not_stable) limit = "not stable even now";
  return page_text("own period",
                   {{"limit", page_text(limit, {{"longest", milliseconds(longest.position)}})},
                    {"own", milliseconds(the_case.control.sampling_period)}});
}

Answer how_slow(const Case& the_case) {
  const auto question = tuned_delay_question(the_case, excitation_of(the_case).frequency);
  const MaxDelay longest = LinearLoop(the_case).longest_period(question);
  Answer answer = asked("slow", {{"range", range_of(question.frequency)}});
  if (longest.sampling_period > 0.0 && std::isfinite(longest.sampling_period)) {
    const std::string held = held_force_warning(
        the_case, longest.sampling_period, question.frequency,
        "the attenuation is relative to the vibration without control under the continuous force");
    answer.detail += held.empty() ? "" : " At that period: " + held + ".";
  }
  const char* text = "up to a period";
  if (longest.outcome == MaxDelayOutcome::beyond_search) text = "at least a period";
  if (!(longest.sampling_period > 0.0)) text = "no period serves";
  const double p = question.proportional_gain, own = gains_of(the_case).proportional;
  const bool is_tuned = std::abs(p - own) <= 0.01 * std::abs(own);
  answer.answer =
      page_text(text, {{"longest", milliseconds(longest.sampling_period)},
                       {"gains", is_tuned ? "D" : "P = " + rounded(p, 4) + " N/m and D"}}) +
      own_period_text(the_case);
  return answer;
}

/// Whether control reduces the vibration at each of some widths of the play. A loop that is
/// unstable without play counts as not reduced at width 0, however slowly its motion grows.
std::vector<char> widths_that_serve(const Question& question, const std::vector<double>& widths) {
  std::vector<Case> cases;
  cases.reserve(widths.size());
  for (const double width : widths)
    cases.push_back(case_with(question.the_case, "backlash.width", width));
  const std::vector<LoopVibration> vibrations = vibrations_of(cases, question);
  std::vector<char> serve(widths.size());
  for (std::size_t k = 0; k < widths.size(); ++k) {
    const bool grows = widths[k] == 0.0 && question.is_unstable_without_play();
    serve[k] = vibrations[k].ratio() < 1.0 - negligible && !grows ? 1 : 0;
  }
  return serve;
}

std::vector<double> evenly(double from, double to, int parts) {
  std::vector<double> values;
  for (int part = 0; part <= parts; ++part) values.push_back(from + (to - from) * part / parts);
  return values;
}

/// Numbers of equal parts: first of the whole range of plays, then, once or twice, of the part that
/// contains the limit. For two masses more parts are affordable, as their motions are fast.
std::vector<int> parts_of_play(const Case& the_case) {
  return is_two_masses(the_case) ? std::vector<int>{120, 20} : std::vector<int>{24, 10, 10};
}

/// Largest play (m) with a reduced vibration, between a play `serving` and a play `failing`.
double limit_between(const Question& question, double serving, double failing) {
  const std::vector<int> parts = parts_of_play(question.the_case);
  for (auto finer = parts.begin() + 1; finer != parts.end(); ++finer) {
    const std::vector<double> widths = evenly(serving, failing, *finer);
    const auto serve = widths_that_serve(question, {widths.begin() + 1, widths.end() - 1});
    const auto last = std::find(serve.begin(), serve.end(), 0) - serve.begin();
    serving = widths[static_cast<std::size_t>(last)];
    failing = widths[static_cast<std::size_t>(last + 1)];
  }
  return serving;
}

/// Text on the range of plays, around the case's own, at which control reduces the vibration, or on
/// the first such range. The range begins at 0 unless the loop needs play for a bounded motion.
std::string play_text(const Question& question, const std::vector<double>& widths) {
  const std::vector<char> serve = widths_that_serve(question, widths);
  const auto next =
      std::lower_bound(widths.begin(), widths.end(), question.the_case.backlash.width);
  auto own = serve.begin() + std::min(next - widths.begin(), std::ptrdiff_t(widths.size()) - 1);
  if (*own == 0) own = std::find(serve.begin(), serve.end(), 1);
  auto begin = own;
  while (begin != serve.begin() && *(begin - 1) != 0) --begin;
  const auto end = std::find(own, serve.end(), 0);
  const auto width = [&](auto place) {
    return widths[static_cast<std::size_t>(place - serve.begin())];
  };
  const auto limit = [&](auto serving, auto failing) {
    return limit_between(question, width(serving), width(failing));
  };
  Values values = {{"own", millimetres(question.the_case.backlash.width)},
                   {"widest", millimetres(widths.back())}};
  if (begin == serve.end()) return page_text("no play", values);
  const double most = end == serve.end() ? widths.back() : limit(end - 1, end);
  values.emplace_back("limit", millimetres(most));
  if (begin == serve.begin())
    return page_text(end == serve.end() ? "every play" : "up to a play", values);
  const double least = limit(begin, begin - 1);
  values.emplace_back("least", millimetres(least));
  constexpr double held = 0.05;  // so exactly a play is held at best
  const bool is_first = std::find(serve.begin(), begin, 1) == begin;
  values.emplace_back(
      "why", is_first && question.is_unstable_without_play() ? page_text("needs play") : "");
  const char* const name = end == serve.end()           ? "from a play on"
                           : most - least > held * most ? "between two plays"
                                                        : "one play";
  return page_text(name, values);
}

/// Range 2 max |z₂ − z₁| (m) of the steady motion without control; a play as wide is never crossed.
double steady_swing_without_control(const Case& the_case) {
  const double duration = duration_of(the_case);
  double largest = 0.0;
  MovingLoop alone = motion_without_control(the_case, duration);
  SteadyStart().give_to(alone);
  for (CaseMotion motion(alone); motion.time() < duration; motion.advance()) {
    const EventSample sample = motion.sense();
    if (not_before(motion.time(), 0.5 * duration))
      largest = std::max(largest, std::abs(relative_displacement(sample.state)));
  }
  return 2.0 * largest;
}

/// Widest play examined (m): 1.5 times the range of z₂ − z₁ without control, rounded up.
double widest_play(const Case& the_case) {
  const double swing = steady_swing_without_control(the_case);
  if (!(swing > 0.0 && std::isfinite(swing))) return 1e-3;
  const double per_unit = std::pow(10.0, 1.0 - std::floor(std::log10(swing)));
  return std::ceil(1.5 * swing * per_unit) / per_unit;
}

Answer how_much_play(const Question& question) {
  const int parts = parts_of_play(question.the_case).front();
  const double widest = widest_play(question.the_case);
  Answer answer = asked("play", {{"parts", std::to_string(parts)},
                                 {"widest", millimetres(widest)},
                                 {"end", format_number(widest)},
                                 {"count", std::to_string(parts + 1)}});
  std::vector<double> widths = evenly(0.0, widest, parts);
  const double own = question.the_case.backlash.width;
  const auto place = std::lower_bound(widths.begin(), widths.end(), own);
  if (place != widths.end() && *place != own) widths.insert(place, own);
  answer.answer = !(question.free > 0.0)         ? page_text("any play")
                  : question.asks_for_no_force() ? page_text("no force to lose")
                                                 : play_text(question, widths);
  return answer;
}

Answer what_motion(const MotionRow& row) {
  const bool has_period = !row.period.empty() && row.period != "–";
  return {page_text("motion question"), row.verdict + (has_period ? ": " + row.period : "") + ".",
          row.rests_on, row.arguments};
}

/// Answer whether the loop is stable for all values of [uncertain], with a proof where one exists.
Answer does_it_hold_for_all(const JobContext& context) {
  Answer answer = asked("family");
  try {
    const FamilyProof proof = family_proof_of(context);
    const char* const name = proof.verdict == ProvedStability::stable     ? "family stable"
                             : proof.verdict == ProvedStability::unstable ? "family unstable"
                                                                          : "family undecided";
    answer.answer = page_text(name, {{"member", replaced(proof.unstable.text(), ";", ", ")},
                                     {"share", percent(proof.undecided_share)}});
  } catch (const WrongInput& refusal) {
    answer.answer = page_text("family not proved", {{"why", refusal.what()}});
  }
  return answer;
}

}  // namespace

Answer asked(const std::string& name, const Values& values) {
  return {page_text(name + " question"), "", page_text(name + " detail", values),
          words_of(page_text(name + " command", values))};
}

void answer(const JobContext& context, const std::function<void(const Answer&)>& take) {
  const Case& the_case = context.case_data;
  if (!has_active_absorber(the_case)) return span_answers(context, take);
  const Question question = question_about(the_case, context.instructions);
  if (!context.doubts.empty()) take(what_is_doubtful(context.doubts));
  Answer help = does_it_help(question);
  if (!context.plant_remark.empty())
    help.detail += page_text("plant remark", {{"remark", context.plant_remark}});
  take(help);
  take(which_gain(question));
  take(how_slow(the_case));
  throw_if_interrupted();
  take(how_much_play(question));
  take(what_motion(question.motion));
  if (!the_case.uncertain.empty()) take(does_it_hold_for_all(context));
  if (!is_cable(the_case)) take(does_it_hold_on_the_cable(the_case));
}

}  // namespace holdfast::program
