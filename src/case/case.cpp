#include "case/case.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "case/model/own/own_parts.hpp"
#include "case/needed.hpp"
#include "holdfast/core/types.hpp"
#include "text/text.hpp"

namespace holdfast::program {

namespace {

/// Whether the user gave a key of the absorber or of its computer.
bool speaks_of_absorber(const Case& the_case) {
  const auto& places = the_case.places;
  return std::any_of(places.begin(), places.end(), [](const auto& place) {
    const std::string& key = place.first;
    return key.rfind("absorber.", 0) == 0 || key.rfind("plant.absorber", 0) == 0 ||
           key.rfind("control.", 0) == 0;
  });
}

}  // namespace

bool has_active_absorber(const Case& the_case) {
  const bool is_of_another_cable =
      !the_case.stands_alone && (!the_case.devices.empty() || !the_case.conductor.name.empty());
  return has_absorber(the_case) && (!is_of_another_cable || speaks_of_absorber(the_case));
}

bool has_own_plant(const Case& the_case) {
  return the_case.own != nullptr && the_case.own->plant.has_value();
}

bool is_two_masses(const Case& the_case) {
  return the_case.plant.model == "two_masses" && !has_own_plant(the_case);
}

bool has_hardware(const Case& the_case) {
  return std::isfinite(the_case.control.measurement_filter) ||
         std::isfinite(the_case.control.drive_bandwidth);
}

bool has_absorber(const Case& the_case) {
  return the_case.plant.absorber_mass > 0.0 || has_own_plant(the_case);
}

bool has_stringing(const Case& the_case) {
  const case_tables::Stringing& s = the_case.stringing;
  return !std::isnan(s.temperature) || !std::isnan(s.tension) || !std::isnan(s.sag);
}

bool has_site(const Case& the_case) {
  const auto said = [](const case_tables::Site& site) {
    return std::tie(site.speeds, site.hours, site.weibull_scale, site.weibull_shape,
                    site.turbulence_intensity, site.years);
  };
  return said(the_case.site) != said(case_tables::Site{});
}

std::string modal_words(const Case& the_case) {
  if (has_own_plant(the_case)) return "a plant of your own";
  if (!is_two_masses(the_case)) return "plant.model = \"" + the_case.plant.model + "\"";
  const bool late = the_case.control.processing_delay > the_case.control.sampling_period;
  std::string names;
  const auto add = [&](bool given, const char* name) {
    if (given) names += (names.empty() ? "" : ", ") + std::string(name);
  };
  add(std::isfinite(the_case.control.measurement_filter), "control.measurement_filter");
  add(std::isfinite(the_case.control.drive_bandwidth), "control.drive_bandwidth");
  add(the_case.own != nullptr, "a controller of your own");
  add(late, "control.processing_delay beyond control.sampling_period");
  return names;
}

bool is_infinite(const Case& the_case) { return the_case.plant.model == "infinite_string"; }

bool is_cable(const Case& the_case) { return the_case.plant.model == "cable"; }

case_tables::Excitation effective_excitation(const Case& the_case) {
  case_tables::Excitation force = the_case.excitation;
  if (!the_case.wind) return force;
  const case_tables::Wind& wind = *the_case.wind;
  force.frequency = wind.strouhal * wind.speed / wind.diameter;
  force.amplitude = 0.5 * wind.air_density * wind.speed * wind.speed * wind.diameter *
                    wind.effective_length * wind.lift_coefficient;
  return force;
}

case_tables::Wind wind_for(const Case& the_case) {
  constexpr double filled = 0.75;
  const auto to_three_digits = [](double value) {
    const double scale = std::pow(10.0, 2.0 - std::floor(std::log10(value)));
    return std::round(value * scale) / scale;
  };
  require_keys(the_case, {"conductor.span", "conductor.sag", "excitation.frequency"});
  const case_tables::Conductor& cable = the_case.conductor;
  const double frequency = the_case.excitation.frequency;
  if (!std::isfinite(cable.diameter)) require_keys(the_case, {"conductor.area"});
  const double wave_speed = cable.span * std::sqrt(cable.gravity / (8.0 * cable.sag));
  case_tables::Wind wind;
  wind.diameter = std::isfinite(cable.diameter)
                      ? cable.diameter
                      : to_three_digits(std::sqrt(4.0 * cable.area / (filled * pi<double>)));
  wind.speed = to_three_digits(frequency * wind.diameter / wind.strouhal);
  wind.effective_length = to_three_digits(std::min(wave_speed / (2.0 * frequency), cable.span));
  return wind;
}

std::string wind_warning(const Case& the_case) {
  if (!the_case.wind || !(the_case.conductor.sag > 0.0)) return {};
  const double frequency = effective_excitation(the_case).frequency;
  if (frequency >= 3.0 && frequency <= 150.0) return {};
  const std::string found = "wind.speed and wind.diameter give vortices at " +
                            format_number(frequency) +
                            " Hz, outside the 3 to 150 Hz of aeolian vibration: ";
  // First mode of the taut string as long and tight as the span: sqrt(H/m)/(2 L), H = m g L²/(8 f).
  const double first_mode = std::sqrt(the_case.conductor.gravity / (32.0 * the_case.conductor.sag));
  if (frequency < std::min(first_mode, 3.0))
    return found + "a force this slow is below the first mode and sways the span as a whole";
  if (frequency < 3.0)
    return found + "it excites about mode " + format_number(std::round(frequency / first_mode)) +
           " of the span, as with stay cables; the limits for overhead lines do not apply";
  return found + "the conductor itself damps a vibration this fast";
}

double resolved_proportional_gain(const Case& the_case) {
  if (!the_case.control.proportional_gain_tuned) return the_case.control.proportional_gain;
  const double omega = 2.0 * pi<double> * effective_excitation(the_case).frequency;
  return the_case.plant.absorber_stiffness - the_case.plant.absorber_mass * omega * omega;
}

}  // namespace holdfast::program
