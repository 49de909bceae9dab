#pragma once

#include "holdfast/stability/boundary/boundary_point.hpp"

namespace holdfast::program {

/// The curve's name in tables: "plus_one", "minus_one", "complex_pair", "zero", "imaginary_pair".
const char* name_of(BoundaryCurve curve);

}  // namespace holdfast::program
