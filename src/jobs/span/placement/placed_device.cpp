#include "jobs/span/placement/placed_device.hpp"

#include <algorithm>
#include <cmath>

#include "case/model/modal/conductor_modes.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/core/types.hpp"
#include "jobs/span/placement/stable_gains.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "text/text.hpp"

#ifdef HOLDFAST_HAS_CERES
#include "holdfast/ceres/device_placement.hpp"
#endif

namespace holdfast::program {

#ifdef HOLDFAST_HAS_CERES
void require_placement_search() {}
#else
void require_placement_search() {
  throw NoAnswer(
      "place needs Ceres Solver, which this program was built without: install the package "
      "libceres-dev and build again");
}
#endif

namespace {

placement::Placement searched(const std::vector<MovedNumber>& numbers,
                              const placement::Levels& levels, int runs) {
  require_placement_search();
#ifdef HOLDFAST_HAS_CERES
  std::vector<placement::MovableValue> values;
  values.reserve(numbers.size());
  for (const MovedNumber& number : numbers) values.push_back(number.value);
  placement::PlacementOptions options;
  options.runs = runs;
  options.watch = throw_if_interrupted;
  return placement::best_placement(values, levels, options);
#else
  static_cast<void>(numbers);
  static_cast<void>(levels);
  static_cast<void>(runs);
  return {};
#endif
}

double worst_of(const std::vector<double>& levels) {
  return levels.empty() ? std::nan("") : *std::max_element(levels.begin(), levels.end());
}

/// The gains as varied numbers, starting from the case's gains, or from 0 if they are inadmissible.
std::vector<MovedNumber> moved_gains(const Case& the_case, const StableGains& stable,
                                     const PdGains<double>& most) {
  const GainWindow around = stable.around(most);
  const PdGains<double> own = gains_of(the_case);
  const PdGains<double> present = stable.admits(own) ? own : PdGains<double>{0.0, 0.0};
  const auto gain = [&](const Interval<double>& range, double now) {
    placement::MovableValue value{std::min(range.lower, now), std::max(range.upper, now)};
    value.upper = std::max(value.upper, value.lower + 1e-6);
    value.present = now;
    value.places = 25;
    return value;
  };
  return {{"proportional_gain", "N/m", gain(around.proportional, present.proportional),
           [](Case& variant, double p) {
             variant.control.proportional_gain = p;
             variant.control.proportional_gain_tuned = false;
           }},
          {"differential_gain", "N s/m", gain(around.differential, present.differential),
           [](Case& variant, double d) { variant.control.differential_gain = d; }}};
}

/// Placement of the active absorber: the best gains at its position.
PlacedDevice placed_actively(const Case& the_case, const PlacementQuestion& question,
                             const PlacementLevels& levels) {
  const double match = string_of(the_case).wave_impedance();
  constexpr double beyond_all = 1e3;
  const PdGains<double> most{beyond_all * match * 2.0 * pi<double> * levels.frequencies().back(),
                             beyond_all * match};
  const StableGains stable(the_case, question.margin);
  PlacedDevice placed{};
  placed.numbers = moved_gains(the_case, stable, most);
  placed.found = searched(
      placed.numbers,
      [&](const std::vector<double>& values) {
        if (!stable.admits({values[0], values[1]})) return std::vector<double>();
        return levels.of(with_values(the_case, placed.numbers, values));
      },
      4);
  if (placed.found.values.empty())
    throw NoAnswer("no gains, not even 0, keep the loop stable with --margin " +
                   format_rounded(question.margin) + ": give a smaller --margin");
  placed.the_case = with_values(the_case, placed.numbers, placed.found.values);
  const bool own_is_stable = stable.is_stable(gains_of(the_case));
  placed.before = own_is_stable ? levels.value_of(worst_of(levels.of(the_case))) : std::nan("");
  return placed;
}

PlacedDevice placed_passively(const Case& the_case, const PlacementQuestion& question,
                              const PlacementLevels& levels) {
  PlacedDevice placed{};
  placed.numbers =
      moved_numbers(the_case, question, levels.frequencies().front(), levels.frequencies().back());
  placed.found = searched(
      placed.numbers,
      [&](const std::vector<double>& values) {
        return levels.of(with_values(the_case, placed.numbers, values));
      },
      4);
  if (placed.found.values.empty())
    throw NoAnswer(
        "the span is statically unstable (unstable at rest) with all values tried: give the other "
        "devices less negative stiffness");
  placed.the_case = with_values(the_case, placed.numbers, placed.found.values);
  placed.before = levels.value_of(worst_of(levels.of(the_case)));
  constexpr double more = 1.01;
  for (std::size_t k = 0; k < placed.numbers.size(); ++k) {
    if (!(placed.numbers[k].sign < 0.0)) continue;
    std::vector<double> values = placed.found.values;
    values[k] *= more;
    placed.is_at_limit_of_rest = levels.of(with_values(the_case, placed.numbers, values)).empty();
  }
  return placed;
}

}  // namespace

PlacedDevice placed_device(const Case& the_case, const PlacementQuestion& question) {
  require_placement_search();
  const PlacementLevels levels(the_case, question);
  PlacedDevice placed = question.is_absorber() ? placed_actively(the_case, question, levels)
                                               : placed_passively(the_case, question, levels);
  placed.after = levels.value_of(placed.found.worst);
  placed.worst_frequency = levels.frequency_of(placed.found.worst_at);
  const double gained = question.goal == PlacementGoal::strain ? placed.before - placed.after
                                                               : placed.after - placed.before;
  placed.range_note = levels.range_note(placed.the_case, placed.worst_frequency);
  placed.is_better = !(gained <= 1e-9 * std::abs(placed.before));
  return placed;
}

namespace {

std::string bound_warning(const MovedNumber& number, placement::PlacementBound met) {
  if (met == placement::PlacementBound::none) return "";
  const bool is_lower = met == placement::PlacementBound::lower;
  const double bound = is_lower ? number.value.lower : number.value.upper;
  return number.quantity + " lies at the " + (is_lower ? "lower" : "upper") +
         " bound of the search, " + format_rounded(number.sign * bound) +
         (number.unit.empty() ? "" : " " + number.unit) +
         (number.quantity == "position" ? " from the support" : "") +
         ": better values may lie beyond this bound";
}

/// Warning that the samples do not show the whole band; else empty.
std::string sampling_warning(const Case& the_case, const PlacementQuestion& question) {
  const double half_rate = 0.5 / the_case.control.sampling_period;
  const double highest =
      std::max(question.frequencies.min, question.frequencies.at(question.frequencies.count - 1));
  if (!question.is_absorber() || question.goal == PlacementGoal::modes || highest < half_rate)
    return "";
  return "at " + format_rounded(half_rate) +
         " Hz, half the sampling rate, and above, the samples do not show the vibration: results "
         "for the drive are invalid there; give a shorter control.sampling_period";
}

}  // namespace

std::vector<std::string> placement_warnings(const PlacedDevice& placed,
                                            const PlacementQuestion& question) {
  std::vector<std::string> warnings;
  if (std::isnan(placed.before) && question.is_absorber())
    warnings.emplace_back(
        "with the case's own gains the loop is unstable on this span: the goal before the change "
        "is left out");
  if (question.is_absorber() && !std::isfinite(placed.the_case.conductor.diameter))
    warnings.emplace_back(
        "force, stroke and power of the drive are left out: give conductor.diameter, which "
        "determines the amplitude of the conductor in the wind");
  if (!placed.is_better)
    warnings.emplace_back("no values better than the case's were found: keep the case's values");
  for (std::size_t k = 0; k < placed.numbers.size(); ++k)
    warnings.push_back(bound_warning(placed.numbers[k], placed.found.bounds[k]));
  if (placed.is_at_limit_of_rest)
    warnings.emplace_back(
        "the negative stiffness is at its limit: a tenth more would make the conductor unstable at "
        "rest");
  warnings.push_back(placed.range_note);
  warnings.push_back(sampling_warning(placed.the_case, question));
  return warnings;
}

}  // namespace holdfast::program
