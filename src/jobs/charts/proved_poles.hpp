#pragma once

#include <vector>

#include "case/case.hpp"
#include "holdfast/plant/enclosed_poles.hpp"

namespace holdfast::program {

/// The poles of a case's plant, of two masses or of a conductor by its modes, each proved to
/// decay. Throws NoAnswer where they are not apart or one may lie on the boundary.
std::vector<EnclosedPole> proved_poles_of(const Case& the_case);

/// Proved poles of a modal case; none where nothing can be proved.
std::vector<EnclosedPole> poles_if_proved(const Case& the_case);

}  // namespace holdfast::program
