#pragma once

#include <string>
#include <vector>

#include "process/job_context.hpp"
#include "report/page/command_line.hpp"

namespace holdfast::program {

/// Writes the report of a case into the folder `context.output`: data/*.csv with metadata,
/// pictures/*.svg with their gnuplot scripts, and report.html with everything in it.
///
/// Every table but those of the part about switching is made by a command line of the program
/// itself, and the page shows it. The built-in case gets the paper's figures and the comparison
/// with its numbers, any other case its own figures; one on the conductor itself, or of a loop as
/// it is built, those that there are for it.
/// @param case_arguments  the `--case` and `--set` options that made the case
/// Throws WrongInput when the folder cannot be made. A figure whose motion has no answer says so in
/// the page.
void write_report(const JobContext& context, const std::vector<std::string>& case_arguments,
                  const CommandRunner& run);

}  // namespace holdfast::program
