#pragma once

#include <string>
#include <vector>

#include "process/job_context.hpp"

namespace holdfast::program {

/// A question of whoever designs or judges a damper, and what holdfast says.
struct Answer {
  std::string question;
  std::string answer;                  ///< in a few words
  std::string detail;                  ///< what was computed, and how far it reaches
  std::vector<std::string> arguments;  ///< of the command that shows it, without the case's
};

/// What is doubtful of the case, where something is; does control help, which D, how slow a
/// computer, how much play, what motion, does it hold on the conductor itself: for the case as it
/// is, switching at samples; of a span without an absorber span_answers(). A question that the case
/// does not let be answered says why. Throws Interrupted.
std::vector<Answer> answers_of(const JobContext& context);

}  // namespace holdfast::program
