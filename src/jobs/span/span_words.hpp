#pragma once

#include <string>
#include <string_view>

#include "case/case.hpp"
#include "holdfast/core/axis.hpp"
#include "jobs/span/aeolian_amplitudes.hpp"
#include "jobs/span/fatigue_life.hpp"

namespace holdfast::program {

/// The frequencies (Hz) at which a span vibrates in the wind: of winds of 1 to 8 m/s, or those of
/// the jobs where the diameter is not known, and of them those at which its devices were measured.
Axis aeolian_frequencies(const Case& the_case);

/// Throws WrongInput, with what an option was given, where a frequency (Hz) is not above 0 or above
/// 1000.
void require_frequencies(std::string_view option, std::string_view text, double lowest,
                         double highest);

/// The frequencies of an option, MIN:MAX:COUNT. Throws WrongInput where one is not above 0.
Axis parse_frequencies(std::string_view option, std::string_view text);

/// That the strains are nan for want of the conductor's wires; empty where they are known.
std::string unknown_strain_note(const AeolianBalance& balance);

/// That the absorber's loop grows, whose steady vibration is then none; empty where it is stable,
/// or there is no absorber.
std::string instability_note(const Case& the_case, bool controlled);

/// That the laws of self-damping are of other conductors than the case's, or that nobody knows;
/// empty where it is of their kind, or damped by its ratio.
std::string self_damping_note(const Case& the_case);

/// That the line of life is of other conductors than the case's; empty where it is of its kind or
/// nobody knows.
std::string life_line_note(const Case& the_case);

/// A life (years) for a sentence; of thousands nobody knows more than that.
std::string years_text(double years);

/// Advice to a designer about a life, in one honest sentence; empty where there is none.
std::string life_advice(const FatigueLife& life, double years);

}  // namespace holdfast::program
