#pragma once

#include <string>

#include "case/case_keys.hpp"
#include "holdfast/cable/change_of_state.hpp"

namespace holdfast::program {

/// Stress–strain curves of the conductor: published ones for its wires; else linear ones from the
/// materials of a named conductor, or youngs_modulus and thermal_expansion. Throws MissingKeys.
ConductorCurves conductor_curves_of(const Case& the_case);

/// State (°C, N/m) of the bare conductor at a temperature (°C), and under the heaviest load.
SpanWeather bare_weather_of(const Case& the_case, double temperature);
SpanWeather loaded_weather_of(const Case& the_case);

/// Mass of the heaviest ice per length (kg/m).
double ice_mass_of(const Case& the_case);

/// Whether weather.ice or weather.wind_pressure is above 0.
bool has_load(const Case& the_case);

/// The ruling span with its measured tension or sag. Throws MissingKeys.
StrungSpan strung_span_of(const Case& the_case);

/// The ruling span's tension in given weather, with the sag of conductor.span. Throws WrongInput,
/// naming the weather, if the conductor would break or leave its stress–strain curves.
/// @param is_new  whether the conductor is new, before creep and the heaviest load
SpanTension tension_in(const Case& the_case, const StrungSpan& span, const SpanWeather& weather,
                       bool is_new);

/// Fault in [stringing] or [weather], alone or together with [conductor].
CaseFault stringing_fault(const Case& the_case);

}  // namespace holdfast::program
