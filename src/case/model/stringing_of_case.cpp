#include "case/model/stringing_of_case.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "case/library/conductor_library.hpp"
#include "case/needed.hpp"
#include "holdfast/core/types.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

/// Temperature (°C) of the conductor in every job.
double present_temperature(const Case& the_case) {
  const double own = the_case.weather.temperature;
  return std::isfinite(own) ? own : the_case.stringing.temperature;
}

/// Whether the present tension differs from the measured one and must be computed.
bool needs_change_of_state(const Case& the_case) {
  return present_temperature(the_case) != the_case.stringing.temperature ||
         std::isnan(the_case.stringing.tension);
}

bool has_expansion(const Case& the_case) {
  return std::isfinite(the_case.conductor.thermal_expansion) ||
         find_conductor(the_case.conductor.name) != nullptr;
}

/// Horizontal tension H (N) of a catenary with the given sag (m), weight (N/m) and span (m).
double tension_of_sag(double sag, double weight, double span) {
  const auto excess = [&](double logarithm) {
    return catenary_sag(std::exp(logarithm), weight, span) - sag;
  };
  const double whole = weight * span;
  const double low = std::log(0.1 * whole), high = std::log(whole * (1.0 + span / sag));
  return std::exp(
      bracketing_root<double>(excess, {low, high, excess(low), excess(high)}, 1e-15).lower);
}

std::string state_text(const SpanWeather& weather, double bare_weight) {
  return "at " + format_rounded(weather.temperature) + " degC" +
         (weather.weight_per_length > bare_weight ? " under ice and wind" : "");
}

}  // namespace

ConductorCurves conductor_curves_of(const Case& the_case) {
  const case_tables::Conductor& c = the_case.conductor;
  const LibraryConductor* named = find_conductor(c.name);
  if (named != nullptr && named->outer.count == 26 && named->core.count == 7)
    return acsr_26_7_curves();
  const double modulus = needed(the_case, "conductor.youngs_modulus");
  ConductorCurves curves;
  if (std::isfinite(c.thermal_expansion) || named == nullptr) {
    if (!has_expansion(the_case))
      throw MissingKeys(
          "[stringing] needs conductor.thermal_expansion (1/K): give it, or set conductor.name to "
          "take it from the library");
    curves.outer = linear_wires(modulus, c.thermal_expansion);
    return curves;
  }
  // The conductor is softer than its straight wires, by the same factor for both materials.
  const double stiffness = named->outer.stiffness + named->core.stiffness;
  curves.outer = linear_wires(modulus * named->outer.stiffness / stiffness, named->outer.expansion);
  curves.core = linear_wires(modulus * named->core.stiffness / stiffness, named->core.expansion);
  return curves;
}

SpanWeather bare_weather_of(const Case& the_case, double temperature) {
  return {temperature, needed(the_case, "conductor.mass_per_length") * the_case.conductor.gravity};
}

double ice_mass_of(const Case& the_case) {
  const case_tables::Weather& w = the_case.weather;
  return w.ice_density * pi<double> * w.ice * (the_case.conductor.diameter + w.ice);
}

SpanWeather loaded_weather_of(const Case& the_case) {
  const case_tables::Weather& w = the_case.weather;
  SpanWeather weather = bare_weather_of(the_case, w.load_temperature);
  const double diameter = the_case.conductor.diameter;
  weather.weight_per_length =
      std::hypot(weather.weight_per_length + ice_mass_of(the_case) * the_case.conductor.gravity,
                 w.wind_pressure * (diameter + 2.0 * w.ice));
  return weather;
}

bool has_load(const Case& the_case) {
  return the_case.weather.ice > 0.0 || the_case.weather.wind_pressure > 0.0;
}

StrungSpan strung_span_of(const Case& the_case) {
  const case_tables::Stringing& s = the_case.stringing;
  require_keys(the_case,
               {"stringing.temperature", std::isnan(s.sag) ? "stringing.tension" : "stringing.sag",
                "conductor.mass_per_length", "conductor.span", "conductor.area"});
  const SpanWeather then = bare_weather_of(the_case, s.temperature);
  const double span = the_case.conductor.span;
  const double tension = std::isnan(s.tension) ? tension_of_sag(needed(the_case, "stringing.sag"),
                                                                then.weight_per_length, span)
                                               : s.tension;
  Stringing strung{then, tension, s.state == "final"};
  if (has_load(the_case)) strung.heaviest = loaded_weather_of(the_case);
  return StrungSpan(conductor_curves_of(the_case), the_case.conductor.area,
                    std::isfinite(s.ruling_span) ? s.ruling_span : span, strung);
}

SpanTension tension_in(const Case& the_case, const StrungSpan& span, const SpanWeather& weather,
                       bool is_new) {
  SpanTension tension = is_new ? span.initial(weather) : span.final(weather);
  tension.sag =
      catenary_sag(tension.horizontal, weather.weight_per_length, the_case.conductor.span);
  tension.support = tension.horizontal + weather.weight_per_length * tension.sag;
  const double strength = the_case.conductor.rated_strength;
  const double bare = bare_weather_of(the_case, 0.0).weight_per_length;
  const std::string state = state_text(weather, bare);
  if (tension.support > strength)
    throw WrongInput("[stringing]: " + state + " the tension would be " +
                     format_rounded(tension.support) + " N, beyond conductor.rated_strength = " +
                     format_rounded(strength) + " N: string the span slacker or lower its load");
  if (!(tension.core_share >= 0.0))
    throw WrongInput("[stringing]: " + state +
                     " no equilibrium tension was found: check the values in [conductor]");
  if (!tension.within_curves)
    throw WrongInput("[stringing]: " + state + " the conductor would be stretched by " +
                     format_rounded(tension.strain) +
                     " of its length, beyond its stress-strain curves: string the span slacker");
  return tension;
}

CaseFault stringing_fault(const Case& the_case) {
  const case_tables::Stringing& s = the_case.stringing;
  if (!has_stringing(the_case)) {
    for (const char* key :
         {"stringing.ruling_span", "weather.temperature", "weather.temperatures", "weather.hours"})
      if (the_case.is_given(key))
        return {{key},
                std::string(key) +
                    " has no effect without stringing.temperature (degC) and "
                    "stringing.tension (N) or stringing.sag (m): give them"};
    return {};
  }
  for (const char* key : {"conductor.tension", "conductor.sag"})
    if (the_case.is_given(key))
      return {{key, "stringing.tension", "stringing.sag"},
              std::string(key) + " is computed from [stringing]: remove this key or [stringing]"};
  if (!std::isnan(s.tension) && !std::isnan(s.sag))
    return {{"stringing.tension", "stringing.sag"},
            "stringing.tension and stringing.sag are both given: give only one of them"};
  if (std::isnan(s.temperature) || (std::isnan(s.tension) && std::isnan(s.sag)))
    return {{"stringing.temperature", "stringing.tension", "stringing.sag"},
            "[stringing] needs stringing.temperature (degC), and stringing.tension (N) or "
            "stringing.sag (m)"};
  if (s.sag >= 0.5 * the_case.conductor.span)
    return {{"stringing.sag"}, "stringing.sag must be below half of conductor.span"};
  const double strain = s.tension / (the_case.conductor.youngs_modulus * the_case.conductor.area);
  if (strain > 0.02)
    return {{"stringing.tension"},
            "stringing.tension would stretch the conductor by " + format_rounded(strain) +
                " of its length, more than the limit of 0.02: lower it or check [conductor]"};
  if (needs_change_of_state(the_case) && !has_expansion(the_case))
    return {{"weather.temperature", "stringing.temperature"},
            "[stringing] needs conductor.thermal_expansion (1/K) to compute the tension in another "
            "state; give it, or set conductor.name to take it from the library"};
  if (has_load(the_case) && !std::isfinite(the_case.conductor.diameter))
    return {{"weather.ice", "weather.wind_pressure"},
            "ice and wind need conductor.diameter (m): give it, or conductor.name of the library"};
  return {};
}

void settle_tension(Case& the_case) {
  if (!has_stringing(the_case) || !stringing_fault(the_case).message.empty()) return;
  for (const char* key : {"conductor.mass_per_length", "conductor.span", "conductor.area",
                          "conductor.youngs_modulus"})
    if (is_absent(the_case, *find_case_key(key))) return;
  const double now = present_temperature(the_case);
  const bool is_new = the_case.stringing.state == "initial";
  the_case.conductor.tension =
      needs_change_of_state(the_case)
          ? tension_in(the_case, strung_span_of(the_case), bare_weather_of(the_case, now), is_new)
                .horizontal
          : the_case.stringing.tension;
  settle_sag(the_case);
}

}  // namespace holdfast::program
