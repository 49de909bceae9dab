#pragma once

#include <string>
#include <vector>

#include "case/job_context.hpp"
#include "report/figures/figure.hpp"
#include "text/text.hpp"

namespace holdfast::program {

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
/// along an axis, and of several processes under MPI; NoAnswer where gnuplot is missing;
/// OutputError where it fails; and what the job throws.
void write_picture(const PictureRequest& request, const CommandRunner& run);

}  // namespace holdfast::program
