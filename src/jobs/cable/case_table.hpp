#pragma once

#include "process/job_context.hpp"

namespace holdfast::program {

/// Writes every key of the case with its value and where that comes from, and then what follows
/// from them: gains in force, frequencies, rates, stability.
///
/// Throws what Table throws.
void write_case_table(const JobContext& context);

}  // namespace holdfast::program
