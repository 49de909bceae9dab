#pragma once

#include <string>
#include <vector>

#include "case/job_context.hpp"
#include "report/figures/figure.hpp"

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

/// Writes the report of a case's span for a line or stay engineer into the folder
/// `context.output`, as write_report() does: what vibrates in the wind without the devices and with
/// them, how long the conductor lives, what to do. What the case does not let be told is left out,
/// with what to give.
/// @param case_arguments  the `--case` and `--set` options that made the case
/// Throws WrongInput when the folder cannot be made.
void write_span_report(const JobContext& context, const std::vector<std::string>& case_arguments,
                       const CommandRunner& run);

}  // namespace holdfast::program
