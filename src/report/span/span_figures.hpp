#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"
#include "holdfast/core/axis.hpp"
#include "report/figures/figure.hpp"

namespace holdfast::program {

/// The frequencies (Hz) at which a span vibrates in the wind: of winds of 1 to 8 m/s, or those of
/// the jobs where the diameter is not known, and of them those at which its devices were measured.
Axis vibration_frequencies(const Case& the_case);

/// The same as the jobs read it: MIN:MAX:COUNT.
std::string frequencies_text(const Axis& axis);

/// What the texts leave open of the pictures of a span.
Values span_values(const Case& the_case);

/// What a line engineer draws of a span: its vibration and strain over frequency, what its devices
/// take at each end, the damping of its modes, and the damage over wind speed.
std::vector<Figure> span_figures(const Case& the_case);

}  // namespace holdfast::program
