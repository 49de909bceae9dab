#pragma once

#include <string>
#include <vector>

#include "case/job_context.hpp"
#include "report/page/html.hpp"
#include "report/switching/switching_study.hpp"

namespace holdfast::program {

/// How much it matters for a case that its drive switches at samples alone.
struct SwitchingPage {
  std::vector<StudiedMotion> of_case;   ///< in the order of `readings`
  std::vector<StudiedMotion> of_paper;  ///< of each loop of the paper, in that order; may be empty
  std::vector<StudiedMotion> laws;      ///< of each, switching at samples and exactly
  std::vector<DrawnFigure> figures;     ///< whose tables are written, but no pictures
};

/// Computes the page on many threads and writes its tables as FOLDER/data/switching-*.csv.
/// @param context  its output is the report's folder
/// @param builtin  the case is the paper's: its loops and its Fig. 8 are shown
/// Throws Interrupted, and what Table throws.
SwitchingPage make_switching_page(const JobContext& context, bool builtin);

/// The page in two sentences: by how much switching at samples changes the steady amplitude, and
/// what it does to the period; then the same with the force held over each sample.
/// @param of_case  in the order of `readings`
std::string switching_lead(const std::vector<StudiedMotion>& of_case);

/// How many of the motions have the shortest period that sampling and forcing allow, in each
/// reading, as a sentence.
/// @param motions  the readings of one loop after the other
std::string subharmonics_text(const std::vector<StudiedMotion>& motions);

/// The page "How much the sampled switching matters" as a part of the report's HTML.
std::string html_of(const SwitchingPage& page);

}  // namespace holdfast::program
