#pragma once

#include <string>
#include <vector>

#include "process/job_context.hpp"
#include "report/figures/figure.hpp"
#include "report/switching/switching_study.hpp"

namespace holdfast::program {

/// A law of the backlash, with its drive switching at samples and exactly, the force exact in both.
struct StudiedLaw {
  std::string words;
  StudiedMotion sampled, exact;
};

/// A figure whose tables are written, or the reason why it has none.
struct SwitchingFigure {
  Figure figure;
  std::string reason;
};

/// How much it matters for a case that its drive switches at samples alone.
struct SwitchingPage {
  std::vector<StudiedMotion> of_case;   ///< in the order of `readings`
  std::vector<StudiedMotion> of_paper;  ///< of each loop of the paper, in that order; may be empty
  std::vector<StudiedLaw> laws;
  std::vector<SwitchingFigure> figures;
};

/// The loops of Kollár's figures and two beside them, from rest: largest |z₁| in the second half of
/// 3 s, or the next whole number of samples.
/// @param the_case  the built-in one
std::vector<StudiedLoop> loops_of_paper(const Case& the_case);

/// The case's own loop in each reading, for 20 s or 200 periods of the excitation where these are
/// longer, but no more than 500 000 samples (fewer for a force of many harmonics), nor after the
/// end of a recorded force.
std::vector<StudiedLoop> loops_of_case(const Case& the_case);

/// Computes the page on many threads and writes its tables as FOLDER/data/switching-*.csv.
/// @param context  its output is the report's folder
/// @param builtin  the case is the paper's: its loops and its Fig. 8 are shown
/// Throws Interrupted, and what Table throws.
SwitchingPage make_switching_page(const JobContext& context, bool builtin);

}  // namespace holdfast::program
