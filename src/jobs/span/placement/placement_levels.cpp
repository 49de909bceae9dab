#include "jobs/span/placement/placement_levels.hpp"

#include "case/model/modal/conductor_modes.hpp"
#include "case/model/span/span_of_case.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/span/end_response.hpp"
#include "holdfast/span/span_roots.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

/// Least ratio whose level, the quantity to be minimised, is 1/ratio. Below it, and for negative
/// ratios, the level continues along the tangent of 1/ratio.
constexpr double poor = 1e-5;
double level_of_ratio(double ratio) {
  return ratio >= poor ? 1.0 / ratio : (2.0 * poor - ratio) / (poor * poor);
}

}  // namespace

PlacementLevels::PlacementLevels(const Case& the_case, const PlacementQuestion& question)
    : question_(question),
      knows_strain_(clamp_bending_of(the_case).has_value()),
      string_(string_of(the_case)) {
  if (question.goal == PlacementGoal::strain) require_diameter(the_case, "place --for strain");
  if (question.goal == PlacementGoal::modes) {
    for (int n = question.first_mode; n <= question.last_mode; ++n)
      frequencies_.push_back(n * string_.wave_speed() / (2.0 * string_.span));
  } else {
    for (std::int64_t k = 0; k < question.frequencies.count; ++k)
      frequencies_.push_back(question.frequencies.at(k));
  }
  if (question.goal == PlacementGoal::strain) wind_.emplace(the_case, frequencies_);
}

std::vector<double> PlacementLevels::of(const Case& variant) const {
  const std::vector<SpanDevice> devices = span_devices_of(variant);
  constexpr double tenth_to_spare = 1.1;
  if (!comes_back(string_, devices, tenth_to_spare)) return {};
  return wind_ ? wind_levels(devices) : damping_levels(variant);
}

std::vector<double> PlacementLevels::wind_levels(const std::vector<SpanDevice>& devices) const {
  const auto ends = span_ends(devices, string_.span);
  std::vector<double> levels;
  for (std::size_t k = 0; k < frequencies_.size(); ++k) {
    throw_if_interrupted();
    const double omega = 2.0 * pi<double> * frequencies_[k];
    const Vibration worst = wind_->at(
        k, {end_response(string_, ends[0], omega), end_response(string_, ends[1], omega)});
    levels.push_back(knows_strain_ ? worst.strain : worst.amplitude.amplitude * frequencies_[k]);
  }
  return levels;
}

std::vector<double> PlacementLevels::damping_levels(const Case& variant) const {
  const std::vector<SpanDevice> devices = span_devices_of(variant);
  std::vector<double> levels;
  if (question_.goal == PlacementGoal::modes) {
    const auto roots = span_roots(string_, devices, question_.last_mode);
    for (int n = question_.first_mode; n <= question_.last_mode; ++n)
      levels.push_back(level_of_ratio(roots[static_cast<std::size_t>(n) - 1].damping()));
    return levels;
  }
  const double position = question_.is_absorber() ? variant.absorber.position
                                                  : variant.devices[question_.device - 1].position;
  const auto ends = span_ends(devices, string_.span);
  const SpanEnd& end = ends[position > string_.span / 2.0 ? 1 : 0];
  for (const double frequency : frequencies_) {
    throw_if_interrupted();
    const EndResponse response = end_response(string_, end, 2.0 * pi<double> * frequency);
    levels.push_back(level_of_ratio(response.inverse_standing_wave_ratio()));
  }
  return levels;
}

double PlacementLevels::value_of(double level) const {
  if (question_.goal == PlacementGoal::strain) return level;
  return level <= 1.0 / poor ? 1.0 / level : 2.0 * poor - level * poor * poor;
}

std::string PlacementLevels::name() const {
  if (question_.goal == PlacementGoal::ratio) return "least_ratio";
  if (question_.goal == PlacementGoal::modes) return "least_damping_ratio";
  return knows_strain_ ? "largest_strain" : "largest_frequency_times_amplitude";
}

std::string PlacementLevels::unit() const {
  return question_.goal == PlacementGoal::strain && !knows_strain_ ? "m/s" : "";
}

std::string PlacementLevels::range_note(const Case& variant, double frequency) const {
  if (question_.goal != PlacementGoal::strain) return "";
  switch (AeolianBalance(variant, true).largest(frequency).amplitude.range) {
    case BalanceRange::below:
      return "with the values found the vibration is below the measured range of the wind law in "
             "the whole band: the goal is computed at the lower end of this range, a hundredth of "
             "the diameter, and other values may be as good";
    case BalanceRange::above:
      return "even with the values found the worst vibration is above the measured range of the "
             "wind law: the goal is computed at the upper end of this range";
    default:
      return "";
  }
}

}  // namespace holdfast::program
