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
/// gets the paper's figures, any other case the figures that exist for its plant and loop.
/// @param case_arguments  the `--case` and `--set` options that made the case
/// Throws WrongInput when the folder cannot be made. For a figure without an answer the page gives
/// the reason.
void write_report(const JobContext& context, const std::vector<std::string>& case_arguments,
                  const CommandRunner& run);

/// Writes the report of a case's span for a line or stay engineer into the folder `context.output`,
/// in the form of write_report(): vibration in the wind without and with the devices, life of the
/// conductor, and advice. Where data are missing, the report names the keys to give.
/// @param case_arguments  the `--case` and `--set` options that made the case
/// Throws WrongInput when the folder cannot be made.
void write_span_report(const JobContext& context, const std::vector<std::string>& case_arguments,
                       const CommandRunner& run);

/// Request for a picture of a job's table.
struct PictureRequest {
  JobContext context;                       ///< context of the job; `output` names the picture
  std::vector<std::string> own;             ///< the job's command line, without --output
  Values options;                           ///< the text of each of its options, given or not
  std::vector<std::string> case_arguments;  ///< the options that made the case
};

/// Whether there is a figure for some table of the job.
bool has_picture(const std::string& job);

/// Draws the table of a job in the style of the report, with the case's name in its heading, and
/// writes FILE-metadata.json beside it: version, job, options and the full case. Both appear whole
/// or not at all; equal requests give equal bytes.
/// Throws WrongInput where the table with these options has no picture, or an axis has a single
/// value; NoAnswer where gnuplot is missing; OutputError where it fails; and what the job throws.
void write_picture(const PictureRequest& request, const CommandRunner& run);

}  // namespace holdfast::program
