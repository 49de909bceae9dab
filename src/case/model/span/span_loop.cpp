#include "case/model/span/span_loop.hpp"

#include <algorithm>
#include <cmath>

#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/span/span_of_case.hpp"
#include "holdfast/span/span_poles.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "process/memo.hpp"

namespace holdfast::program {
namespace {

/// The distinct positions (m) of absorber and devices, and the index of each.
struct Places {
  std::vector<double> places;

  std::size_t index(double place) {
    const auto known = std::find(places.begin(), places.end(), place);
    if (known != places.end()) return static_cast<std::size_t>(known - places.begin());
    places.push_back(place);
    return places.size() - 1;
  }
};

void require_loop(const Case& the_case) {
  if (is_cable(the_case))
    throw WrongInput(
        "[[device]] with plant.model = \"cable\": devices besides the absorber are computed only "
        "on the taut string; set plant.model = \"string\", which agrees with the cable in modes of "
        "many half-waves");
  for (const case_tables::Device& device : the_case.devices)
    if (device.table)
      throw WrongInput("a measured impedance (" + device.file +
                       ") is valid only for steady vibration, so the stability of the absorber's "
                       "control loop cannot be computed: describe that device by mass, frequencies "
                       "and damping_ratios (kind = \"stockbridge\")");
}

std::vector<double> numbers_of(const Case& the_case, const ConductorModes& conductor,
                               const Absorber<double>& absorber) {
  const TautString<double> string = string_of(the_case);
  std::vector<double> numbers = {string.tension,
                                 string.mass_per_length,
                                 string.span,
                                 string.bending_stiffness,
                                 absorber.mass,
                                 absorber.stiffness,
                                 absorber.damping,
                                 absorber.clamp_mass,
                                 the_case.absorber.position,
                                 static_cast<double>(conductor.apart),
                                 static_cast<double>(conductor.modes.size())};
  for (const PlaceMode<double>& mode : conductor.modes)
    numbers.insert(numbers.end(), {mode.angular_frequency, mode.damping_ratio});
  for (const case_tables::Device& device : the_case.devices) {
    numbers.push_back(device.position);
    const LumpedDevice lumped = lumped_device_of(device);
    for (const DeviceBranch& branch : lumped.branches)
      numbers.insert(numbers.end(),
                     {branch.damping, branch.stiffness, branch.inertance, branch.mass});
    numbers.push_back(device.clamp_mass);
  }
  return numbers;
}

std::vector<PlantPole> found_poles(const Case& the_case, const ConductorModes& conductor,
                                   const Absorber<double>& absorber) {
  TautString<double> string = string_of(the_case);
  string.damping_ratio = 0.0;
  Places places;
  const std::size_t own = places.index(the_case.absorber.position);
  for (const case_tables::Device& device : the_case.devices) places.index(device.position);
  // Bundles up to the highest one of the conductor.
  const bool is_bundled = conductor.modes.size() > static_cast<std::size_t>(conductor.apart);
  const double highest = is_bundled ? conductor.modes.back().angular_frequency : 0.0;
  auto modes = string_modes_at(string, places.places, conductor.apart, highest);
  for (ModeAtPlaces& mode : modes)
    mode.damping_ratio =
        std::hypot(mode.damping_ratio, bare_damping_of(the_case, mode.angular_frequency));
  SpanPoles span(modes);
  for (const case_tables::Device& device : the_case.devices) {
    throw_if_interrupted();
    span.attach(lumped_device_of(device), places.index(device.position));
  }
  return span.attach(absorber, own);
}

}  // namespace

std::vector<PlantPole> poles_with_devices(const Case& the_case, const ConductorModes& conductor,
                                          const Absorber<double>& absorber) {
  require_loop(the_case);
  constexpr std::size_t enough = 16;
  static Memo<std::vector<double>, std::vector<PlantPole>> memo(enough);
  auto poles = memo.of(numbers_of(the_case, conductor, absorber),
                       [&] { return found_poles(the_case, conductor, absorber); });
  if (poles.empty())
    throw NoAnswer(
        "two poles of the span with its devices nearly coincide and cannot be separated: change "
        "the position or damping of a device by a thousandth");
  return poles;
}

bool is_stable_span(const Case& the_case) {
  return judged_loop_of(the_case).is_stable(gains_of(the_case));
}

bool is_growing_span(const Case& the_case, bool controlled) {
  const auto& devices = the_case.devices;
  const bool is_measured = std::any_of(devices.begin(), devices.end(),
                                       [](const auto& device) { return device.table != nullptr; });
  return controlled && has_active_absorber(the_case) && !is_measured && !is_stable_span(the_case);
}

}  // namespace holdfast::program
