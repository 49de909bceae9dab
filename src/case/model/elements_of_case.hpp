#pragma once

#include "case/case.hpp"
#include "holdfast/cable/elements.hpp"

namespace holdfast::program {

/// The damping ratio of the conductor at the two frequencies of [reduction].
RayleighDamping rayleigh_damping_of(const Case& the_case);

/// The continuous cable; the spring and damper of `spring_mass` are those of [plant].
CableElements elements_of(const Case& the_case, int elements, AbsorberReading reading);

}  // namespace holdfast::program
