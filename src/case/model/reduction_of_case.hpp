#pragma once

#include "case/case.hpp"
#include "holdfast/plant/reduction.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast::program {

/// What the case asks of a reduction: k1 as it is read, m2 and the two natural frequencies.
FrequencyReduction<double> reduction_options_of(const Case& the_case);

/// m1 and k2 from that k1, the absorber's mass and the two frequencies of [reduction].
ReductionResult reduction_of(const Case& the_case);

/// m1, k1, c1, m2, k2 reduced from the conductor; c2 is 0 here.
/// Throws NoAnswer where no real plant has the two frequencies, saying what would have one.
TwoMass<double> plant_without_absorber_damping(const Case& the_case);

}  // namespace holdfast::program
