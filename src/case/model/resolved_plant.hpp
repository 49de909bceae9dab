#pragma once

#include <string>

#include "case/case.hpp"
#include "holdfast/plant/reduction.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast::program {

/// Reduction that the case asks for: k1 as it is read, m2 and the two natural frequencies.
FrequencyReduction<double> reduction_options_of(const Case& the_case);

/// m1 and k2 from that k1, the absorber's mass and the two frequencies of [reduction].
ReductionResult reduction_of(const Case& the_case);

/// m1, k1, c1, m2, k2 reduced from the conductor; c2 is 0 here.
/// Throws NoAnswer where no real plant has the two frequencies, saying what would have one.
TwoMass<double> plant_without_absorber_damping(const Case& the_case);

/// Completes a case whose plant is not wholly given: reduces it from the conductor, sets the keys
/// of [plant] that are given over it, and fits c2 where that is not one of them.
/// @return what the user has to know of the plant, or an empty text: what of it is given and what
///         reduced, that the excitation is far from the frequencies that it was reduced for
/// Throws NoAnswer where there is no such plant, or a package is missing.
std::string settle_plant(Case& the_case);

/// Settles the absorber alone, which is all of [plant] that a conductor by its modes has: its mass
/// is absorber.mass unless plant.absorber_mass is given.
/// @return which of its values are built-in, or an empty text
std::string settle_absorber(Case& the_case);

}  // namespace holdfast::program
