#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "case/case.hpp"
#include "holdfast/cable/statics.hpp"

namespace holdfast::program {

/// Whether the plant comes from the conductor: one is given, and not every key of [plant] beside
/// it.
bool plant_is_reduced(const Case& the_case);

/// Whether the cable is the case's own: a plant alone stands beside that of the built-in case,
/// which says nothing of it.
bool has_own_cable(const Case& the_case);

/// Whether the case has the key's value from the library, by conductor.name.
bool is_from_library(const Case& the_case, std::string_view key);

/// Whether a value is the user's: given, of the conductor that he named, or the sag that his
/// tension leaves.
bool is_users(const Case& the_case, const std::string& key);

/// Whether some of these keys of conductor and absorber are the built-in cable's, where two or more
/// of name, mass, span, tension and sag tell that the user's is another: together they say nothing
/// of either.
bool is_half_borrowed(const Case& the_case, const std::vector<std::string>& keys);

/// H = mass_per_length gravity span²/(8 sag) (N); NaN where the case does not tell it.
double parabolic_tension_of(const Case& the_case);

/// conductor.damping_ratio. Throws MissingKeys where the case has none.
double damping_ratio_of(const Case& the_case);

/// The library's objects for [conductor], [absorber] and the readings of [reduction], an absorber
/// of 0 kg where the case has none. A damping ratio that the case has not is 0 here. Each throws
/// MissingKeys.
Conductor<double> conductor_of(const Case& the_case);
StaticsFromRest<IrvinePointLoad<double>> irvine_statics_of(const Case& the_case);
StaticsFromRest<CatenaryPointLoad<double>> exact_statics_of(const Case& the_case);
ReadingRange reading_range_of(const Case& the_case);

/// Throws WrongInput, naming the key, for a range of the readings of k1 beyond what Eq. 1 is valid
/// for: upward as `require_force_within_statics`, downward by the sag.
void require_reading_range(const Case& the_case);

/// k1 (N/m) from Eq. 1 with the case's reading. Throws what require_reading_range() throws.
double conductor_stiffness_of(const Case& the_case);

/// Frequencies (Hz) that a reduction takes when none are given: of Irvine's modes that move the
/// absorber's place by a tenth of their largest displacement or more, the first and the sixth.
std::pair<double, double> default_frequencies(const Case& the_case);

/// Warning of a job about the cable where the case gives a plant alone: whose cable it is. Empty
/// otherwise.
std::string borrowed_cable_warning(const Case& the_case);

/// Throws WrongInput where a force (N) on the absorber's place lies outside what Eq. 1 and the
/// exact statics are valid for: it would lift the cable by half of its own weight.
void require_force_within_statics(const Case& the_case, double force);

}  // namespace holdfast::program
