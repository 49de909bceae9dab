#pragma once

#include "holdfast/math/linalg/multipliers.hpp"
#include "holdfast/orbit/orbit_search.hpp"

// Several files of the program search for orbits; it is compiled in periodic_orbit.cpp for all.

namespace holdfast {

extern template std::vector<Multiplier> multipliers_of_product(
    const std::vector<Matrix<double, 5>>&);

extern template OrbitResult find_periodic_orbit(const ForcedLoop<double>&, const Vector<double, 4>&,
                                                const OrbitLimits&);

}  // namespace holdfast
