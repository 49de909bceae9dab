#pragma once

#include <string>

#include "case/case.hpp"

namespace holdfast::program {

/// Completes a case whose plant is not wholly given: reduces it from the conductor, sets the keys
/// of [plant] that are given over it, and fits c2 where that is not one of them.
/// @return what the user has to know of the plant, or an empty text: what of it is given and what
///         reduced, that the excitation is far from the frequencies that it was reduced for
/// Throws NoAnswer where there is no such plant, or a package is missing.
std::string settle_plant(Case& the_case);

/// The same of the absorber alone, which is all of [plant] that a conductor by its modes has: its
/// mass is absorber.mass unless plant.absorber_mass is given.
/// @return which of its values are built-in, or an empty text
std::string settle_absorber(Case& the_case);

}  // namespace holdfast::program
