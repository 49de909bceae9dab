#pragma once

#include "case/case.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/stability/chart/operating_point.hpp"

namespace holdfast::program {

/// The exact discretisation of the case's loop, and what its stability depends on.
SampledLoop<double> loop_of(const Case& the_case);
OperatingPoint operating_point_of(const Case& the_case);

}  // namespace holdfast::program
