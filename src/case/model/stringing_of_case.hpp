#pragma once

#include <string>

#include "case/case_keys.hpp"
#include "holdfast/cable/change_of_state.hpp"

namespace holdfast::program {

/// Stress–strain curves of the case's conductor: those that are published for its wires, else
/// linear ones of the materials of a named conductor's wires, else of conductor.youngs_modulus and
/// thermal_expansion. Throws MissingKeys.
ConductorCurves conductor_curves_of(const Case& the_case);

/// The weather of a bare conductor at a temperature (°C), and that of the heaviest load.
SpanWeather bare_weather_of(const Case& the_case, double temperature);
SpanWeather loaded_weather_of(const Case& the_case);

/// Mass of the heaviest load's ice (kg/m).
double ice_mass_of(const Case& the_case);

/// Whether [weather] has ice or a wind that comes with it.
bool has_load(const Case& the_case);

/// The ruling span as it was strung. Throws MissingKeys.
StrungSpan strung_span_of(const Case& the_case);

/// The tension in a weather, its sag that of the case's own span. Throws WrongInput, naming the
/// state, where the conductor would break or its curves end.
/// @param is_new  before creep and heaviest load
SpanTension tension_in(const Case& the_case, const StrungSpan& span, const SpanWeather& weather,
                       bool is_new);

/// Fault of [stringing] and [weather] with each other and with [conductor].
CaseFault stringing_fault(const Case& the_case);

}  // namespace holdfast::program
