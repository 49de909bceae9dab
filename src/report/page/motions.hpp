#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"

namespace holdfast::program {

/// What one motion is, in the words of the page; a number that there is not is "–".
struct MotionRow {
  std::string place;             ///< of the motion in the paper, or whose it is
  std::string motion;            ///< sampling period, backlash and start
  std::string verdict;           ///< attractor_type_text()
  std::string period;            ///< s, samples, forcing periods
  std::string multiplier = "–";  ///< largest modulus, of one period
  std::string border = "–";      ///< nearest change of contact (mm; mm/s)
  std::string capture = "–";    ///< radius of the neighbourhoods from which motions tend to it (mm)
  std::string precision = "–";  ///< how the same orbit comes out in extended precision
  std::string rests_on = {};    ///< what the verdict rests on
  std::string neighbour = {};   ///< how it ends beside the motion from rest; "": not compared
  std::vector<std::string> arguments = {};  ///< of the command that shows it, without the case's
  bool diverges = false;                    ///< it leaves every bound
  bool stays_in_play = false;               ///< its certified orbit never leaves the play
};

/// "τ = 1 ms, r₀ = 0.5 mm".
std::string loop_text(const Case& the_case);

/// The motions of Kollár's Figs. 6–13 with their neighbours, and some beyond them.
/// @param the_case  the built-in one
std::vector<MotionRow> paper_motions(const Case& the_case);

/// The motion of a case from its own initial state.
MotionRow motion_of_the_case(const Case& the_case);

}  // namespace holdfast::program
