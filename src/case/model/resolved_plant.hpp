#pragma once

#include <string>

#include "case/case.hpp"
#include "holdfast/plant/reduction.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast::program {

/// Inputs of the reduction of a case: k1, m2 and the two natural frequencies.
FrequencyReduction<double> reduction_options_of(const Case& the_case);

/// The reduction of a case: m1 and k2 from k1, the absorber's mass and both frequencies.
ReductionResult reduction_of(const Case& the_case);

/// The plant m1, k1, c1, m2, k2 reduced from the conductor, with c2 = 0. Throws NoAnswer if no real
/// plant has the two frequencies, naming admissible values.
TwoMass<double> plant_without_absorber_damping(const Case& the_case);

/// Completes a case whose plant is not given in full: reduces the plant from the conductor, keeps
/// the given keys of [plant], and fits c2 unless it is given.
/// @return remarks for the user, or an empty text: given and reduced keys, a poor fit of c2, a
///         sensitive reduction, an excitation far from the plant's frequencies
/// Throws NoAnswer if no such plant exists or the program lacks an optional package.
std::string settle_plant(Case& the_case);

/// Completes the absorber of a conductor modelled by its modes, which uses no other part of
/// [plant]: its mass is absorber.mass unless plant.absorber_mass is given.
/// @return names of its keys with built-in values, as a remark, or an empty text
std::string settle_absorber(Case& the_case);

}  // namespace holdfast::program
