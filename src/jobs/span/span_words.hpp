#pragma once

#include <string>
#include <string_view>

#include "case/case.hpp"
#include "holdfast/core/axis.hpp"
#include "jobs/span/aeolian_amplitudes.hpp"
#include "jobs/span/fatigue_life.hpp"

namespace holdfast::program {

/// Frequencies (Hz) of aeolian vibration of a span: vortex shedding in winds of 1 to 8 m/s, or 3 to
/// 150 Hz where the diameter is not known; limited to the range of measured devices.
Axis aeolian_frequencies(const Case& the_case);

/// Checks that frequencies (Hz) are above 0 and at most 1000. Throws WrongInput, which quotes the
/// option and its text.
void require_frequencies(std::string_view option, std::string_view text, double lowest,
                         double highest);

/// Frequencies of an option, MIN:MAX:COUNT. Throws what require_frequencies() throws.
Axis parse_frequencies(std::string_view option, std::string_view text);

/// Note that strains are NaN because the conductor's wires are not given; else empty.
std::string unknown_strain_note(const AeolianBalance& balance);

/// Note that the span is unstable at rest, that the absorber's loop is unstable, or that a measured
/// device leaves its stability unknown; else empty.
std::string instability_note(const Case& the_case, bool controlled);

/// Note that the self-damping laws were measured on conductors of another kind, or that the kind is
/// not known; empty for ACSR, or without a rated strength.
std::string self_damping_note(const Case& the_case);

/// Note that the safe border line was measured on another kind of conductor; empty where the kind
/// is the same or not known.
std::string life_line_note(const Case& the_case);

/// Text of a life in years, with two digits; "more than 1000" above 1000.
std::string years_text(double years);

/// Advice on a fatigue life, one sentence, for a required life of `years`; empty for a life of NaN.
std::string life_advice(const FatigueLife& life, double years);

}  // namespace holdfast::program
