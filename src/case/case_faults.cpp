#include "case/case_keys.hpp"

#include <cmath>
#include <limits>
#include <numeric>

#include "case/device/device_keys.hpp"
#include "case/model/cable_of_case.hpp"
#include "case/model/stringing_of_case.hpp"
#include "case/plausibility/doubts.hpp"
#include "holdfast/control/late_controller.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

using case_tables::Backlash;
using case_tables::Excitation;
using case_tables::Reduction;

/// A key with its value and unit, for a message: "conductor.span = 6.4 m".
std::string said(const Case& c, const char* key) {
  return std::string(key) + " = " + format_number(case_value(c, key)) + " " +
         find_case_key(key)->unit;
}

CaseFault control_fault(const Case& c) {
  constexpr double most = 100.0;
  if (!(c.control.processing_delay > most * c.control.sampling_period)) return {};
  return {{"control.processing_delay", "control.sampling_period"},
          said(c, "control.processing_delay") + " must not exceed 100 times " +
              said(c, "control.sampling_period")};
}

CaseFault jitter_fault(const Case& c) {
  const double period = c.control.sampling_period, jitter = c.control.jitter;
  if (!(jitter > 0.0) || std::isnan(period)) return {};
  if (!(jitter < period / 2.0)) {
    return {{"control.jitter", "control.sampling_period"},
            said(c, "control.jitter") + " must be less than half of " +
                said(c, "control.sampling_period")};
  }
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon();
  const double late = within_sample({period, c.control.processing_delay}).processing_delay;
  if (2.0 * jitter + late <= period * (1.0 + rounding)) return {};
  return {{"control.jitter", "control.processing_delay", "control.sampling_period"},
          "twice " + said(c, "control.jitter") + " plus " +
              (late < c.control.processing_delay ? "the fraction of a sampling period in " : "") +
              said(c, "control.processing_delay") + " must not exceed " +
              said(c, "control.sampling_period")};
}

CaseFault contact_fault(const Case& c) {
  const Backlash& b = c.backlash;
  if (b.law == "dead_zone") return {};
  const auto fault = [&](const char* key) -> CaseFault {
    return {{key, "backlash.law"},
            said(c, key) + " has no effect with backlash.law = \"" + b.law +
                "\": set it to 0, or set backlash.law = \"dead_zone\""};
  };
  if (b.contact_stiffness > 0.0) return fault("backlash.contact_stiffness");
  if (b.contact_damping > 0.0) return fault("backlash.contact_damping");
  return {};
}

CaseFault tension_fault(const Case& c) {
  const double tension = c.conductor.tension, left = parabolic_tension_of(c);
  constexpr double tolerance = 0.01;
  if (!(std::abs(left - tension) > tolerance * tension) || std::isinf(tension)) return {};
  return {{"conductor.tension", "conductor.sag"},
          said(c, "conductor.tension") + " and " + said(c, "conductor.sag") +
              " contradict each other: this sag gives a tension of " + format_rounded(left) +
              " N; give only one of the two"};
}

CaseFault modes_fault(const Case& c) {
  constexpr double most = 300.0;
  if (c.plant.model != "cable" || !std::isfinite(c.plant.modes) || c.plant.modes <= most) return {};
  return {{"plant.modes", "plant.model"},
          "plant.modes = " + format_number(c.plant.modes) +
              ": plant.model = \"cable\" allows at most " + format_number(most) +
              "; leave plant.modes out to include all modes"};
}

CaseFault absorber_fault(const Case& c) {
  if (has_absorber(c) || std::isnan(c.plant.absorber_mass)) return {};
  if (is_two_masses(c))
    return {{"plant.absorber_mass", "plant.model"},
            "plant.absorber_mass = 0: plant.model = \"two_masses\" needs a second mass greater "
            "than 0 kg; for a span without absorber set another plant.model, such as \"string\""};
  const auto& control = c.control;
  if (!control.proportional_gain_tuned && control.proportional_gain == 0.0 &&
      control.differential_gain == 0.0)
    return {};
  return {{"control.proportional_gain", "control.differential_gain", "plant.absorber_mass"},
          "plant.absorber_mass = 0: without an absorber the drive moves nothing; set "
          "control.proportional_gain and control.differential_gain to 0"};
}

/// Fault of the yearly hours that belong to a list of values.
CaseFault hours_fault(const std::string& of, const std::vector<double>& values,
                      const std::string& key, const std::vector<double>& hours) {
  if (values.size() != hours.size())
    return {{key, of},
            of + " has " + std::to_string(values.size()) + " numbers, but " + key + " has " +
                std::to_string(hours.size()) + ": give both the same number of values"};
  constexpr double most = 8784.0;
  const double all = std::accumulate(hours.begin(), hours.end(), 0.0);
  if (all <= most) return {};
  return {{key},
          key + " add up to " + format_rounded(all) + " h, but a year has " + format_number(most) +
              " h at most: lower them"};
}

CaseFault temperatures_fault(const Case& c) {
  if (c.weather.hours.empty()) return {};
  return hours_fault("weather.temperatures", c.weather.temperatures, "weather.hours",
                     c.weather.hours);
}

CaseFault speeds_fault(const Case& c) {
  const std::vector<double>& speeds = c.site.speeds;
  if (!speeds.empty() && std::isfinite(c.site.weibull_scale))
    return {{"site.weibull_scale", "site.speeds"},
            "site.speeds (with site.hours) and site.weibull_scale are both given: give only one of "
            "them"};
  for (std::size_t k = 1; k < speeds.size(); ++k)
    if (!(speeds[k - 1] < speeds[k]))
      return {{"site.speeds"},
              "site.speeds must ascend: " + format_number(speeds[k]) + " m/s comes after " +
                  format_number(speeds[k - 1])};
  return hours_fault("site.speeds", speeds, "site.hours", c.site.hours);
}

CaseFault noise_fault(const Case& c) {
  const Excitation& force = c.excitation;
  if (!(force.noise_rms > 0.0) || force.noise_lowest < force.noise_highest) return {};
  return {{"excitation.noise_lowest", "excitation.noise_highest", "excitation.noise_rms"},
          said(c, "excitation.noise_lowest") + " must be less than " +
              said(c, "excitation.noise_highest")};
}

CaseFault reduction_fault(const Case& c) {
  const Reduction& r = c.reduction;
  if (r.first_frequency >= r.second_frequency) {
    return {{"reduction.first_frequency", "reduction.second_frequency"},
            said(c, "reduction.first_frequency") + " must be less than " +
                said(c, "reduction.second_frequency")};
  }
  const bool needs_extent = r.stiffness_reading != "tangent";
  if (needs_extent && !(r.reading_below + r.reading_above > 0.0)) {
    return {{"reduction.reading_below", "reduction.reading_above", "reduction.stiffness_reading"},
            "reduction.reading_below and reduction.reading_above must not both be 0 with "
            "reduction.stiffness_reading = \"" +
                r.stiffness_reading + "\""};
  }
  return {};
}

CaseFault force_fault(const Case& c) {
  const Excitation force = effective_excitation(c);
  const bool fine =
      std::isfinite(force.amplitude) && std::isfinite(force.frequency) && force.frequency > 0.0;
  if (c.wind && !fine) {
    return {{"wind.speed", "wind.diameter", "wind.effective_length", "wind.strouhal",
             "wind.lift_coefficient", "wind.air_density"},
            "[wind] gives a force of " + format_number(force.amplitude) + " N at " +
                format_number(force.frequency) +
                " Hz: make both finite and the frequency greater than 0 Hz"};
  }
  if (!std::isinf(resolved_proportional_gain(c))) return {};
  return {{"control.proportional_gain", "excitation.frequency", "plant.absorber_mass"},
          "control.proportional_gain = \"tuned\" overflows: lower the excitation frequency or "
          "plant.absorber_mass"};
}

}  // namespace

CaseFault conductor_fault(const Case& the_case) {
  const case_tables::Conductor& c = the_case.conductor;
  const double span = c.span;
  if (the_case.absorber.position >= span) {
    return {{"absorber.position", "conductor.span"},
            said(the_case, "absorber.position") + " must be less than " +
                said(the_case, "conductor.span")};
  }
  if (c.sag >= span / 2.0) {
    const bool is_left = std::isfinite(c.tension) && !the_case.is_given("conductor.sag");
    return {{is_left ? "conductor.tension" : "conductor.sag", "conductor.span"},
            (is_left ? said(the_case, "conductor.tension") + " gives a sag of " +
                           format_rounded(c.sag) + " m, which"
                     : said(the_case, "conductor.sag")) +
                " must be less than half of " + said(the_case, "conductor.span")};
  }
  const double strain = parabolic_tension_of(the_case) / (c.youngs_modulus * c.area);
  // Below the least strain the stretch of a bar of the continuous cable is lost in round-off.
  constexpr double smallest_strain = 1e-10, largest_strain = 0.1;
  const std::vector<std::string> keys = {
      "conductor.youngs_modulus",  "conductor.area", "conductor.sag",
      "conductor.mass_per_length", "conductor.span", "conductor.gravity"};
  if ((strain < smallest_strain || strain > largest_strain) && !is_half_borrowed(the_case, keys)) {
    return {keys, "the conductor's own weight would stretch it by " + format_rounded(strain) +
                      " of its length: the strain must be at least 1e-10 (less cannot be computed) "
                      "and at most 0.1 (more breaks any cable); check [conductor]"};
  }
  return {};
}

CaseFault first_fault(const Case& the_case) {
  for (const auto find :
       {control_fault, jitter_fault, contact_fault, tension_fault, stringing_fault,
        impossible_fault, conductor_fault, reduction_fault, force_fault, noise_fault, modes_fault,
        absorber_fault, devices_fault, speeds_fault, temperatures_fault}) {
    CaseFault fault = find(the_case);
    if (!fault.message.empty()) return fault;
  }
  return {};
}

void settle_sag(Case& the_case) {
  case_tables::Conductor& c = the_case.conductor;
  if (std::isfinite(c.tension))
    c.sag = c.mass_per_length * c.gravity * c.span * c.span / (8.0 * c.tension);
}

void settle_wind(Case& the_case) {
  const bool is_known = std::isfinite(the_case.conductor.diameter);
  if (the_case.wind && is_known && !the_case.is_given("wind.diameter"))
    the_case.wind->diameter = the_case.conductor.diameter;
}

void check_case(const Case& the_case) {
  const CaseFault fault = first_fault(the_case);
  if (!fault.message.empty()) throw WrongInput(fault.message);
}

void require_within_span(const std::string& option, double displacement, const Case& the_case) {
  const double span = the_case.conductor.span;
  if (!(std::abs(displacement) >= span)) return;
  throw WrongInput(option + ": the displacement, " + format_number(displacement) +
                   " m, must be less than the span, " + said(the_case, "conductor.span"));
}

}  // namespace holdfast::program
