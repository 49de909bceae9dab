#include "report/page/answers.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "case/model/cable_of_case.hpp"
#include "case/model/linear_loop.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/modal/conductor_modes.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/modal/modes_warning.hpp"
#include "case/model/plant_of_case.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "report/page/html.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

std::string gain_text(double gain) { return rounded(gain, 4); }

/// The case on the cable. The damping of a string stays, as nothing but the model is in question.
Case on_cable(const Case& the_case) {
  Case changed = the_case;
  changed.plant.model = "cable";
  if (!is_two_masses(the_case) && changed.conductor.damping == "chosen")
    changed.conductor.damping = "ratio";
  changed.plant.modes = std::numeric_limits<double>::quiet_NaN();
  return changed;
}

/// Amplitude relative to that without control under the true force, without play; NaN if there are
/// at most two samples per period of the force.
double share_left(const Case& the_case, const PdGains<double>& gains) {
  const double frequency = excitation_of(the_case).frequency;
  if (!(2.0 * frequency * sampling_of(the_case).period < 1.0))
    return std::numeric_limits<double>::quiet_NaN();
  return LinearLoop(the_case).response(frequency).ratio_to_uncontrolled(gains);
}

/// Smallest clamp mass (kg), to 1 %, that makes the case's gains stable, found by doubling and then
/// by bisection. Infinite if the mass would be above half the absorber's mass or below 0.1 % of
/// this half, if there is none, or if the gains are already stable by `is_stable_with_clamp`.
double least_clamp_mass(const Case& cable) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const double largest = cable.plant.absorber_mass / 2.0;
  double failing = cable.absorber.clamp_mass;
  double serving = std::max(2.0 * failing, largest / 1024.0);
  if (!(failing < largest) || is_stable_with_clamp(cable, failing)) return none;
  while (!is_stable_with_clamp(cable, std::min(serving, largest))) {
    throw_if_interrupted();
    if (serving >= largest) return none;
    failing = serving;
    serving *= 2.0;
  }
  serving = std::min(serving, largest);
  while (serving > 1.01 * failing) {
    throw_if_interrupted();
    const double middle = failing > 0.0 ? std::sqrt(failing * serving) : serving / 2.0;
    (is_stable_with_clamp(cable, middle) ? serving : failing) = middle;
    if (serving < 1e-3 * largest) return none;
  }
  return serving;
}

/// Text on the growth of the motion by the largest characteristic root of the loop.
std::string growth_text(const Case& cable, const std::complex<double>& root) {
  const double turn = std::abs(std::arg(root));
  if (turn > 0.9 * pi<double>) return page_text("grows from sample to sample");
  return page_text(
      "grows at a frequency",
      {{"frequency", rounded(turn / (2.0 * pi<double> * cable.control.sampling_period), 3)}});
}

std::string damping_text(const Case& cable) {
  const auto& conductor = cable.conductor;
  const std::string ratio = rounded(100.0 * conductor.damping_ratio, 3);
  if (conductor.damping == "ratio") return page_text("each mode damped", {{"ratio", ratio}});
  const auto& [first, second] = conductor.rayleigh_frequencies;
  return page_text(
      "damped by Rayleigh",
      {{"ratio", ratio}, {"first", format_number(first)}, {"second", format_number(second)}});
}

std::string detail_text(const Case& cable) {
  const ConductorModes conductor = conductor_modes_of(cable);
  const std::string doubt = modes_warning(cable);
  return page_text("cable detail", {{"bars", std::to_string(conductor.bars)},
                                    {"modes", std::to_string(conductor.apart)},
                                    {"damping", damping_text(cable)},
                                    {"waves", rounded(2.0 * string_of(cable).wave_impedance(), 3)},
                                    {"own clamp", rounded(1e3 * cable.absorber.clamp_mass, 3)}}) +
         (doubt.empty() ? "" : page_text("modes doubted", {{"doubt", doubt}}));
}

/// The interval that contains the gain D, or else the interval nearest to it.
Interval<double> nearest_interval(const std::vector<Interval<double>>& intervals, double d) {
  const auto away = [&](const Interval<double>& gap) {
    return std::max({0.0, gap.lower - d, d - gap.upper});
  };
  return *std::min_element(
      intervals.begin(), intervals.end(),
      [&](const auto& one, const auto& other) { return away(one) < away(other); });
}

/// Name of the text in texts/page.toml on the stability of the case's gains on the cable.
/// @param end  highest frequency (Hz) of a single mode
std::string holding_of(const Case& cable, const std::vector<Interval<double>>& stable, double end) {
  const PdGains<double> gains = gains_of(cable);
  if (lacks_bars(cable) || end < excitation_of(cable).frequency) return "unresolved on the cable";
  const bool is_stable = std::any_of(stable.begin(), stable.end(), [&](const auto& gap) {
    return gap.contains(gains.differential);
  });
  if (is_stable != other_modes_of(cable).is_stable(gains)) return "undecided on the cable";
  if (is_stable) return "stable on the cable";
  return stable.empty() ? "no gain on the cable" : "unstable on the cable";
}

/// Text on the vibration left by control, on the cable and on two masses.
std::string share_text(const Case& the_case, const Case& cable) {
  const PdGains<double> gains = gains_of(the_case);
  const double there = share_left(cable, gains), here = share_left(the_case, gains);
  if (!std::isfinite(there)) return "";
  return page_text("left on the cable",
                   {{"there", rounded(100.0 * there, 3)}, {"here", rounded(100.0 * here, 3)}});
}

/// Sets the answer on the stability of the case's gains on the cable, and completes its detail.
void judge(const Case& the_case, const Case& cable, Answer& answer) {
  const PdGains<double> gains = gains_of(the_case);
  const auto stable = LinearLoop(cable).stable_gains(FreeGain::differential, gains);
  throw_if_interrupted();
  const double end = conductor_modes_of(cable).highest_frequency();
  const std::string holding = holding_of(cable, stable, end);
  Values values = {{"D", gain_text(gains.differential)}, {"end", rounded(end, 3)}};
  if (!stable.empty()) {
    const Interval<double> nearest = nearest_interval(stable, gains.differential);
    values.emplace_back("stretch",
                        range_text(gain_text(nearest.lower), gain_text(nearest.upper), "from "));
  }
  answer.answer = page_text(holding, values);
  throw_if_interrupted();
  if (holding == "unstable on the cable") {
    const double clamp = least_clamp_mass(cable);
    answer.answer += page_text(std::isfinite(clamp) ? "a clamp serves" : "no clamp serves",
                               {{"clamp", rounded(1e3 * clamp, 2)}});
    answer.detail += growth_text(cable, largest_root_of(cable, gains));
  } else if (holding == "stable on the cable") {
    answer.answer += share_text(the_case, cable);
  }
}

}  // namespace

Answer does_it_hold_on_the_cable(const Case& the_case) {
  const Case cable = on_cable(the_case);
  Answer answer{
      page_text("cable question"), "", "",
      words_of(page_text("cable command", {{"P", format_number(gains_of(the_case).proportional)},
                                           {"damping", cable.conductor.damping == "ratio"
                                                           ? " --set conductor.damping=ratio"
                                                           : ""}}))};
  if (!has_own_cable(the_case)) {
    answer.answer = page_text("no conductor");
    answer.arguments = {"case"};
    return answer;
  }
  try {
    answer.detail = detail_text(cable);
    judge(the_case, cable, answer);
  } catch (const NoAnswer& reason) {
    answer.answer = page_text("no answer on the cable", {{"reason", reason.what()}});
  }
  return answer;
}

}  // namespace holdfast::program
