#pragma once

#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/excitation/harmonic_input.hpp"
#include "holdfast/plant/two_mass.hpp"

// The exponentials of a loop: compiled in sampled_loop.cpp for all files of the program.

namespace holdfast {

extern template SampledLoop<double> sampled_loop(const TwoDof<double>&, const Sampling<double>&);

}  // namespace holdfast

namespace holdfast::detail {

/// That of the harmonic force.
extern template Matrix<double, 6> balanced_exponential(const Matrix<double, 6>&);

}  // namespace holdfast::detail
