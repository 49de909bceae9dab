#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "case/case.hpp"
#include "holdfast/cable/statics.hpp"

namespace holdfast::program {

/// Whether the plant is reduced from the conductor: a conductor is given, and [plant] does not give
/// every number of the two masses.
bool plant_is_reduced(const Case& the_case);

/// Whether the cable belongs to the plant of the case. It does not if the case gives [plant] alone:
/// the cable is then the built-in one.
bool has_own_cable(const Case& the_case);

/// Whether the value of a key comes from the conductor library, by conductor.name.
bool is_from_library(const Case& the_case, std::string_view key);

/// Whether the user determines the value of a key: gives it, names a conductor of the library that
/// has it, or gives the tension from which the sag is computed.
bool is_users(const Case& the_case, const std::string& key);

/// Whether one of `keys` in [conductor] or [absorber] has a built-in value although the user gives
/// two or more of name, mass, span, tension and sag. Such a mixture describes no real cable.
bool is_half_borrowed(const Case& the_case, const std::vector<std::string>& keys);

/// The parabolic tension H = mass_per_length gravity span²/(8 sag) (N); NaN if a value is missing.
double parabolic_tension_of(const Case& the_case);

/// The value of conductor.damping_ratio. Throws MissingKeys if the case has none.
double damping_ratio_of(const Case& the_case);

/// Conductor of a case; the next three give its statics with the absorber's weight, by Irvine and
/// exact, and the displacements at which the stiffness k1 is read. A missing absorber mass or
/// damping ratio is 0. Each of the four throws MissingKeys for any other missing key.
Conductor<double> conductor_of(const Case& the_case);
StaticsFromRest<IrvinePointLoad<double>> irvine_statics_of(const Case& the_case);
StaticsFromRest<CatenaryPointLoad<double>> exact_statics_of(const Case& the_case);
ReadingRange reading_range_of(const Case& the_case);

/// Throws WrongInput, naming the key, if the displacements at which k1 is read exceed the range of
/// Eq. 1 of Kollár 2022: upward the lift by half of the cable's weight, downward the sag.
void require_reading_range(const Case& the_case);

/// The conductor stiffness k1 (N/m) from Eq. 1. Throws what require_reading_range() throws.
double conductor_stiffness_of(const Case& the_case);

/// Default frequencies (Hz) of a reduction: first and sixth of Irvine's modes that move the
/// absorber's place by at least a tenth of their amplitude; modes 1 and 6 if fewer than six do.
std::pair<double, double> default_frequencies(const Case& the_case);

/// Warning that the cable is the built-in one because the case gives [plant] alone; else empty.
std::string borrowed_cable_warning(const Case& the_case);

/// Throws WrongInput if a force (N) on the absorber's place would lift half of the cable's own
/// weight or more: Eq. 1 and the exact statics are not valid for it.
void require_force_within_statics(const Case& the_case, double force);

}  // namespace holdfast::program
