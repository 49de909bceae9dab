#pragma once

#include <vector>

#include "case/case.hpp"
#include "holdfast/plant/enclosed_poles.hpp"

namespace holdfast::program {

/// Enclosures of the poles of a case's plant (two masses or conductor modes), each proved to decay.
/// Throws NoAnswer where two poles cannot be separated or one may not decay.
std::vector<EnclosedPole> proved_poles_of(const Case& the_case);

/// Enclosures of the poles as of proved_poles_of(); empty where nothing can be proved.
std::vector<EnclosedPole> poles_if_proved(const Case& the_case);

/// Whether --prove is possible: ideal computer, no user-defined part, device or endless string.
bool may_be_proved(const Case& the_case);

}  // namespace holdfast::program
