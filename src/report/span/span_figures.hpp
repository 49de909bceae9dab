#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"
#include "holdfast/core/axis.hpp"
#include "report/figures/figure.hpp"

namespace holdfast::program {

/// The same as the jobs read it: MIN:MAX:COUNT.
std::string frequencies_text(const Axis& axis);

/// What the texts leave open of the pictures of a span.
Values span_values(const Case& the_case);

/// What a line engineer draws of a span: its vibration and strain over frequency, what its devices
/// take at each end, the damping of its modes, and the damage over wind speed.
std::vector<Figure> span_figures(const Case& the_case);

}  // namespace holdfast::program
