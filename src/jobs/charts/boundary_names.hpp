#pragma once

#include "holdfast/stability/boundary/boundary_point.hpp"
#include "io/text/names.hpp"

namespace holdfast::program {

/// The curves' names in tables.
inline constexpr Named<BoundaryCurve> curve_names[] = {
    {BoundaryCurve::plus_one, "plus_one"},
    {BoundaryCurve::minus_one, "minus_one"},
    {BoundaryCurve::complex_pair, "complex_pair"},
    {BoundaryCurve::zero, "zero"},
    {BoundaryCurve::imaginary_pair, "imaginary_pair"}};

}  // namespace holdfast::program
