#pragma once

#include "process/job_context.hpp"

namespace holdfast::program {

/// Writes how each answer of the case moves with each parameter of its loop: one row for every
/// answer and parameter, ∂answer/∂parameter and ∂ ln|answer|/∂ ln|parameter|.
///
/// Answers that the case does not have (no stable gain, no largest period) have no rows.
/// @param tuned  P follows k₂ and m₂ by Eq. 6 instead of being held, as it does in any case whose
/// gain is "tuned"
/// Throws what Table throws.
void write_sensitivities(const JobContext& context, bool tuned);

}  // namespace holdfast::program
