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

/// Whether the cable is the case's own. A case that gives [plant] alone has the built-in cable,
/// which is unrelated to that plant.
bool has_own_cable(const Case& the_case);

/// Whether the value of a key comes from the conductor library, by conductor.name.
bool is_from_library(const Case& the_case, std::string_view key);

/// Whether the value of a key comes from the user: given, from the named conductor, or a sag
/// computed from a given tension.
bool is_users(const Case& the_case, const std::string& key);

/// Whether one of these keys of [conductor] and [absorber] has a built-in value although the user
/// gives two or more of name, mass, span, tension and sag: such a mixture describes neither cable.
bool is_half_borrowed(const Case& the_case, const std::vector<std::string>& keys);

/// The parabolic tension H = mass_per_length gravity span²/(8 sag) (N); NaN if a value is missing.
double parabolic_tension_of(const Case& the_case);

/// The value of conductor.damping_ratio. Throws MissingKeys if the case has none.
double damping_ratio_of(const Case& the_case);

/// The conductor, its statics and the range in which k1 is read, for [conductor], [absorber] and
/// [reduction]. A missing absorber mass or damping ratio is 0. Each of these functions throws
/// MissingKeys for any other missing key.
Conductor<double> conductor_of(const Case& the_case);
StaticsFromRest<IrvinePointLoad<double>> irvine_statics_of(const Case& the_case);
StaticsFromRest<CatenaryPointLoad<double>> exact_statics_of(const Case& the_case);
ReadingRange reading_range_of(const Case& the_case);

/// Throws WrongInput, naming the key, if the displacements at which k1 is read exceed the limits of
/// Eq. 1 of Kollár 2022: upward that of require_force_within_statics(), downward the sag.
void require_reading_range(const Case& the_case);

/// The conductor stiffness k1 (N/m) from Eq. 1. Throws what require_reading_range() throws.
double conductor_stiffness_of(const Case& the_case);

/// Default frequencies (Hz) of a reduction: the first and sixth of Irvine's modes, of those that
/// move the absorber's place by a tenth of their largest displacement if these are six or more.
std::pair<double, double> default_frequencies(const Case& the_case);

/// A warning that a case that gives [plant] alone has the built-in cable. Empty otherwise.
std::string borrowed_cable_warning(const Case& the_case);

/// Throws WrongInput if a force (N) on the absorber's place would lift half of the cable's own
/// weight or more: Eq. 1 and the exact statics are not valid for it.
void require_force_within_statics(const Case& the_case, double force);

}  // namespace holdfast::program
