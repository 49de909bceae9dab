#include "report/page/string_answer.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "case/model/loop_of_case.hpp"
#include "case/model/modal_plant_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "case/plausibility/words.hpp"
#include "io/text/text.hpp"
#include "process/interrupt.hpp"
#include "report/page/html.hpp"

namespace holdfast::program {
namespace {

std::string damping(double gain) { return rounded(gain, 4); }

Case on_string(const Case& the_case) {
  Case changed = the_case;
  changed.plant.model = "string";
  changed.plant.modes = std::numeric_limits<double>::quiet_NaN();
  return changed;
}

/// Of the vibration without control under the true force, without play; NaN where sampling does not
/// show it.
double share_left(const Case& the_case, const PdGains<double>& gains) {
  const double omega = excitation_of(the_case).angular_frequency();
  const Sampling<double> sampling = sampling_of(the_case);
  if (!(omega * sampling.period < pi<double>)) return std::numeric_limits<double>::quiet_NaN();
  return steady_response_of(the_case, sampling, force_hold_of(the_case), omega)
      .relative_to(true_amplitude_of(the_case, omega))
      .ratio_to_uncontrolled(gains);
}

/// A clamp mass (kg) about which the case's gains become stable, to a percent: before the first of
/// some that double. Not above half the absorber's mass, nor what a blob of grease weighs; infinite
/// where there is none, and where fewer modes call the gains stable as they are.
double least_clamp_mass(const Case& string) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const double largest = string.plant.absorber_mass / 2.0;
  double failing = string.absorber.clamp_mass;
  double serving = std::max(2.0 * failing, largest / 1024.0);
  if (!(failing < largest) || is_stable_with_clamp(string, failing)) return none;
  while (!is_stable_with_clamp(string, std::min(serving, largest))) {
    throw_if_interrupted();
    if (serving >= largest) return none;
    failing = serving;
    serving *= 2.0;
  }
  serving = std::min(serving, largest);
  while (serving > 1.01 * failing) {
    throw_if_interrupted();
    const double middle = failing > 0.0 ? std::sqrt(failing * serving) : serving / 2.0;
    (is_stable_with_clamp(string, middle) ? serving : failing) = middle;
    if (serving < 1e-3 * largest) return none;
  }
  return serving;
}

/// Why the loop grows: what the largest root does.
std::string growth_text(const Case& string, const std::complex<double>& root) {
  const double turn = std::abs(std::arg(root));
  if (turn > 0.9 * pi<double>) return page_text("grows from sample to sample");
  return page_text(
      "grows at a frequency",
      {{"frequency", rounded(turn / (2.0 * pi<double> * string.control.sampling_period), 3)}});
}

std::string clamp_text(const Case& string) {
  const double clamp = least_clamp_mass(string);
  if (!std::isfinite(clamp)) return page_text("no clamp serves");
  return page_text("a clamp serves", {{"clamp", rounded(1e3 * clamp, 2)}});
}

std::string detail_text(const Case& string) {
  const TautString<double> conductor = string_of(string);
  const std::string doubt = modes_warning(string);
  return page_text("string detail", {{"tension", rounded(conductor.tension, 4)},
                                     {"waves", rounded(2.0 * conductor.wave_impedance(), 3)},
                                     {"modes", std::to_string(modes_of(string))},
                                     {"own clamp", rounded(1e3 * string.absorber.clamp_mass, 3)}}) +
         (doubt.empty() ? "" : page_text("modes doubted", {{"doubt", doubt}}));
}

/// The interval that holds D, or else the nearest to it.
Interval<double> nearest_interval(const std::vector<Interval<double>>& intervals, double d) {
  const auto away = [&](const Interval<double>& gap) {
    return std::max({0.0, gap.lower - d, d - gap.upper});
  };
  return *std::min_element(
      intervals.begin(), intervals.end(),
      [&](const auto& one, const auto& other) { return away(one) < away(other); });
}

/// Gives the answer and what is to be added to its detail.
void judge(const Case& the_case, const Case& string, Answer& answer) {
  const PdGains<double> gains = gains_of(the_case);
  const auto stable = circle_of(string).stable_gains(FreeGain::differential, gains);
  throw_if_interrupted();
  Values values = {{"D", damping(gains.differential)}};
  const bool is_stable = std::any_of(stable.begin(), stable.end(), [&](const auto& gap) {
    return gap.contains(gains.differential);
  });
  const char* text = is_stable         ? "stable on the string"
                     : !stable.empty() ? "unstable on the string"
                                       : "no gain on the string";
  if (is_stable != other_modes_of(string).is_stable(gains)) text = "undecided on the string";
  if (!stable.empty()) {
    const Interval<double> nearest = nearest_interval(stable, gains.differential);
    values.emplace_back("lower", damping(nearest.lower));
    values.emplace_back("upper", damping(nearest.upper));
  }
  answer.answer = page_text(text, values);
  if (text == std::string("unstable on the string")) {
    answer.answer += clamp_text(string);
    answer.detail += growth_text(string, largest_root_of(string, gains));
  } else if (text == std::string("stable on the string")) {
    throw_if_interrupted();
    const double there = share_left(string, gains), here = share_left(the_case, gains);
    if (std::isfinite(there))
      answer.answer += page_text("left on the string", {{"there", rounded(100.0 * there, 3)},
                                                        {"here", rounded(100.0 * here, 3)}});
  }
}

}  // namespace

Answer does_it_hold_on_the_string(const Case& the_case) {
  Answer answer{page_text("string question"), "", "",
                words_of(page_text("string command",
                                   {{"P", format_number(gains_of(the_case).proportional)}}))};
  if (!plausibility::has_own_cable(the_case)) {
    answer.answer = page_text("no conductor");
    answer.arguments = {"case"};
    return answer;
  }
  const Case string = on_string(the_case);
  answer.detail = detail_text(string);
  judge(the_case, string, answer);
  return answer;
}

}  // namespace holdfast::program
