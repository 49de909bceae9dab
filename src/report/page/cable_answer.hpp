#pragma once

#include "report/page/answers.hpp"

namespace holdfast::program {

/// Whether what two masses say of a case holds on its conductor as a hanging cable: whether its
/// gains are stable there, what of the absorber would have to move with the clamp if they are not,
/// and how much vibration is left. It is not asked where the conductor is not the plant's.
Answer does_it_hold_on_the_cable(const Case& the_case);

}  // namespace holdfast::program
