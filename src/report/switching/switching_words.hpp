#pragma once

#include <string>
#include <vector>

#include "report/page/html.hpp"
#include "report/switching/switching_page.hpp"

namespace holdfast::program {

/// The page in two sentences: by how much switching at samples changes the steady amplitude, and
/// what it does to the period; then the same with the force held over each sample.
/// @param of_case  in the order of `readings`
std::string switching_lead(const std::vector<StudiedMotion>& of_case);

/// How many of the motions have the shortest period that sampling and forcing allow, in each
/// reading, as a sentence.
/// @param motions  the readings of one loop after the other
std::string subharmonics_text(const std::vector<StudiedMotion>& motions);

/// The page "How much the sampled switching matters" as a part of the report's HTML.
/// @param drawn  its figures
std::string html_of(const SwitchingPage& page, const std::vector<DrawnFigure>& drawn);

}  // namespace holdfast::program
