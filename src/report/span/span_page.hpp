#pragma once

#include <string>
#include <vector>

#include "process/job_context.hpp"
#include "report/page/command_line.hpp"

namespace holdfast::program {

/// Writes the report of a case's span for a line or stay engineer into the folder
/// `context.output`, as write_report() does: what vibrates in the wind without the devices and with
/// them, how long the conductor lives, what to do. What the case does not let be told is left out,
/// with what to give.
/// @param case_arguments  the `--case` and `--set` options that made the case
/// Throws WrongInput when the folder cannot be made.
void write_span_report(const JobContext& context, const std::vector<std::string>& case_arguments,
                       const CommandRunner& run);

}  // namespace holdfast::program
