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

}  // namespace holdfast::program
