#include "jobs/span/placement/placed_device.hpp"

#include <algorithm>
#include <cmath>

#include "case/model/modal/conductor_modes.hpp"
#include "case/model/span/span_of_case.hpp"
#include "holdfast/core/types.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

using case_tables::Device;

/// Varied strength with a logarithmic scale; the bounds are widened to contain the current value.
placement::MovableValue strength(double lower, double upper, double present, int places) {
  placement::MovableValue value{lower, upper};
  value.by_ratio = true;
  value.places = places;
  if (!(present > 0.0)) return value;
  value.present = present;
  value.lower = std::min(lower, present);
  value.upper = std::max(upper, present);
  return value;
}

/// Function that writes a number of one device.
std::function<void(Case&, double)> into(std::size_t device, double Device::*place,
                                        double sign = 1.0) {
  return [=](Case& variant, double value) { variant.devices[device - 1].*place = sign * value; };
}
std::function<void(Case&, double)> into(std::size_t device, std::vector<double> Device::*place) {
  return [=](Case& variant, double value) { variant.devices[device - 1].*place = {value}; };
}

/// Bounds of the strength relative to the value that matches the conductor's wave impedance.
constexpr double weakest = 1e-2, strongest = 1e2;

void add_mass(std::vector<MovedNumber>& numbers, const Case& the_case, std::size_t number,
              double lowest, double highest) {
  const DeviceBranch branch = lumped_device_of(the_case.devices[number - 1]).branches.front();
  const double omega = std::sqrt(branch.stiffness / branch.mass);
  const double ratio = branch.damping / (2.0 * omega * branch.mass);
  constexpr double beyond = 2.0, least_ratio = 0.01, largest_ratio = 2.0;
  numbers.push_back({"frequency", "Hz",
                     strength(lowest / beyond, highest * beyond, omega / (2.0 * pi<double>), 13),
                     into(number, &Device::frequencies)});
  numbers.push_back({"damping_ratio", "", strength(least_ratio, largest_ratio, ratio, 6),
                     into(number, &Device::damping_ratios)});
}

/// Adds the strength of a device, if its kind has a free one.
void add_strength(std::vector<MovedNumber>& numbers, const Case& the_case, std::size_t number,
                  double lowest, double highest) {
  const Device& device = the_case.devices[number - 1];
  const double match = string_of(the_case).wave_impedance();
  const double least = 2.0 * pi<double> * lowest, most = 2.0 * pi<double> * highest;
  const auto damping = [&](int places) {
    numbers.push_back({"damping", "N s/m",
                       strength(weakest * match, strongest * match, device.damping, places),
                       into(number, &Device::damping)});
  };
  if (device.kind == "dashpot") damping(13);
  if (device.kind == "tuned_mass") add_mass(numbers, the_case, number, lowest, highest);
  if (device.kind == "inerter") {
    numbers.push_back(
        {"inertance", "kg",
         strength(weakest * match / most, strongest * match / least, device.inertance, 9),
         into(number, &Device::inertance)});
    damping(7);
  }
  if (device.kind == "stiffness") {
    const double sign = device.stiffness < 0.0 ? -1.0 : 1.0;
    numbers.push_back(
        {"stiffness", "N/m",
         strength(weakest * match * least, strongest * match * most, sign * device.stiffness, 13),
         into(number, &Device::stiffness, sign), sign});
    if (device.damping > 0.0) damping(7);
  }
}

/// Position of a device as a varied number: distance from the nearer support, from 0.2 m (0.002 of
/// a short span) to a quarter of the band's longest wave or a tenth of the span. The bounds are
/// widened to the current position.
/// @param shortest, longest  wavelengths of the band (m)
MovedNumber moved_position(const Case& the_case, const PlacementQuestion& question, double shortest,
                           double longest) {
  const double span = the_case.conductor.span;
  const std::size_t number = question.device;
  const double now = the_case.devices[number - 1].position;
  const bool right = now > span / 2.0;
  const double present = right ? span - now : now;
  placement::MovableValue value{std::min({0.2, 0.002 * span, present}),
                                std::max(std::min(0.25 * longest, 0.1 * span), present)};
  value.upper = std::max(value.upper, 1.01 * value.lower);
  value.present = present;
  constexpr double eighth = 8.0;
  value.places = static_cast<int>(
      std::clamp(std::ceil(eighth * (value.upper - value.lower) / shortest) + 1.0, 9.0, 41.0));
  return {"position", "m", value, [=](Case& variant, double distance) {
            variant.devices[number - 1].position = right ? span - distance : distance;
          }};
}

}  // namespace

std::vector<MovedNumber> moved_numbers(const Case& the_case, const PlacementQuestion& question,
                                       double lowest, double highest) {
  const double speed = string_of(the_case).wave_speed();
  std::vector<MovedNumber> numbers;
  if (question.moves_position)
    numbers.push_back(moved_position(the_case, question, speed / highest, speed / lowest));
  add_strength(numbers, the_case, question.device, lowest, highest);
  if (numbers.empty())
    throw WrongInput("device " + std::to_string(question.device) + ", a " +
                     the_case.devices[question.device - 1].kind +
                     ", has nothing to vary: its maker has fixed its data, and --keep position "
                     "fixes its position; leave --keep out");
  return numbers;
}

Case with_values(Case the_case, const std::vector<MovedNumber>& numbers,
                 const std::vector<double>& values) {
  for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k].put(the_case, values[k]);
  return the_case;
}

}  // namespace holdfast::program
