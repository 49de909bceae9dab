#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"
#include "kernels/instruction_set.hpp"

namespace holdfast::program {

/// A question of whoever designs or judges a damper, and what holdfast says.
struct Answer {
  std::string question;
  std::string answer;                  ///< in a few words
  std::string detail;                  ///< what was computed, and how far it reaches
  std::vector<std::string> arguments;  ///< of the command that shows it, without the case's
};

/// Does control help, which D, how slow a computer, how much play, what motion: for the case as it
/// is, switching at samples. A question that the case does not let be answered says why. Throws
/// Interrupted.
/// @param set  on whose packs motions are computed
std::vector<Answer> answers_of(const Case& the_case, InstructionSet set);

/// The section of the page, each answer with the whole command line that shows it.
std::string html_of(const std::vector<Answer>& answers,
                    const std::vector<std::string>& case_arguments);

}  // namespace holdfast::program
