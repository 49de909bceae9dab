#pragma once

#include <string>
#include <vector>

#include "case/job_context.hpp"
#include "report/figures/figure.hpp"
#include "text/text.hpp"

namespace holdfast::program {

/// Writes the report of a case into the folder `context.output`: data/*.csv with metadata,
/// pictures/*.svg with their gnuplot scripts, and report.html with everything in it.
///
/// Every table is made by a command line of the program, which the page shows. The built-in case
/// gets the paper's figures, any other case its own; one on the conductor itself, or of a loop as
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

/// A job whose table is to be drawn.
struct PictureRequest {
  JobContext context;                       ///< `output` names the picture
  std::vector<std::string> own;             ///< the job's command line, without --output
  Values options;                           ///< the text of each of its options, given or not
  std::vector<std::string> case_arguments;  ///< the options that made the case
};

/// Whether there is a figure for some table of the job.
bool has_picture(const std::string& job);

/// Draws the table of a job as the report draws such a table, with the case's name in its heading,
/// and beside it FILE-metadata.json: version, job, options and the full case. Both appear whole or
/// not at all; the same question gives the same bytes.
/// Throws WrongInput where these options make a table without a picture, or one of a single value
/// along an axis; NoAnswer where gnuplot is missing;
/// OutputError where it fails; and what the job throws.
void write_picture(const PictureRequest& request, const CommandRunner& run);

}  // namespace holdfast::program
